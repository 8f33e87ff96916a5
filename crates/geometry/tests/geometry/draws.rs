//! Random numbers that stay the same on every machine, and what is drawn from them.

use glam::DVec3;
use rand_philox::{Philox, u32_to_unit_f32, u32_to_unit_f64};

/// A stream of draws, a function of its seed alone.
pub struct Draws(Philox);

impl Draws {
    pub fn new(seed: u64) -> Self {
        Self(Philox::from_u64_seed(seed))
    }

    /// Uniform on (0, 1).
    pub fn unit(&mut self) -> f64 {
        u32_to_unit_f64(self.0.next_u32())
    }

    /// Uniform on (0, 1), binary32.
    pub fn unit_f32(&mut self) -> f32 {
        u32_to_unit_f32(self.0.next_u32())
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n - 1)
    }

    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// Uniform in the cube [-1, 1]³.
    pub fn in_cube(&mut self) -> DVec3 {
        DVec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0))
    }

    /// Uniform on the sphere of directions.
    pub fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let (sin, cos) = (std::f64::consts::TAU * self.unit()).sin_cos();
        let s = (1.0 - z * z).sqrt();
        DVec3::new(s * cos, s * sin, z)
    }

    /// Uniform on the hemisphere around `n`, no nearer to the horizon than `least` in cosθ.
    pub fn direction_above(&mut self, n: DVec3, least: f64) -> DVec3 {
        loop {
            let direction = self.direction();
            if direction.dot(n).abs() > least {
                return direction * direction.dot(n).signum();
            }
        }
    }

    /// Weights of three vertices, uniform over the triangle.
    pub fn barycentric(&mut self) -> [f64; 3] {
        let (s, v) = (self.unit().sqrt(), self.unit());
        [1.0 - s, s * (1.0 - v), s * v]
    }

    /// One of the axis directions or their diagonals, with components −1, 0, 1.
    pub fn aligned(&mut self) -> DVec3 {
        loop {
            let mut component = || self.below(3) as f64 - 1.0;
            let direction = DVec3::new(component(), component(), component());
            if direction != DVec3::ZERO {
                return direction;
            }
        }
    }
}
