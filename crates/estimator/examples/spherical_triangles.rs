//! Holds the draw over spherical triangles against itself undone in binary64: `spherical_triangles COUNT [SEED]`.
//!
//! Triangles are log-uniform in solid angle from 10⁻⁸ sr to 2π, up to 10⁴ times as long as wide. Each is drawn at some (u, v);
//! what comes out is turned back into (u, v) by other formulas in binary64.

use std::env::args;
use std::f64::consts::{PI, TAU};

use glam::DVec3;
use rand_philox::splitmix64;
use twoforms_estimator::density::{Piece, SphericalTriangle, each_piece};

fn main() {
    let number = |k: usize, default: u64| args().nth(k).and_then(|text| text.parse().ok()).unwrap_or(default);
    let (count, mut random) = (number(1, 100_000), Random(number(2, 0)));
    let (mut worst, mut drawn) = ([0.0_f64; 2], 0_u64);
    let mut by_size = [[0.0_f64; 2]; 10];
    for _ in 0..count {
        let corners = random.triangle();
        let mut pieces = Vec::new();
        each_piece(&corners, |piece| pieces.push(piece));
        for piece in pieces {
            let Piece::Triangle(triangle) = piece else { continue };
            let uv = [random.uniform() as f32, random.uniform().max(1.0 / 64.0) as f32];
            let off = error(&triangle, uv);
            assert!(off.iter().all(|e| e.is_finite()), "not a number: {corners:?} at {uv:?}");
            let decade = ((triangle.solid_angle().log10() + 9.0).max(0.0) as usize).min(9);
            for k in 0..2 {
                if off[k] > worst[k] && off[k] > 2e-5 {
                    println!("{k} {:e} Ω {:e} at {uv:?}: {:?}", off[k], triangle.solid_angle(), triangle.corners());
                }
                worst[k] = worst[k].max(off[k]);
                by_size[decade][k] = by_size[decade][k].max(off[k]);
            }
            drawn += 1;
        }
    }
    println!("{drawn} drawn; worst |Δu| {:e}, |Δv| {:e}", worst[0], worst[1]);
    by_size.iter().enumerate().for_each(|(k, [u, v])| println!("from 1e{} sr: {u:e} {v:e}", k as i32 - 9));
}

/// |Δu| and |Δv| of what is drawn at (u, v).
fn error(triangle: &SphericalTriangle, [u, v]: [f32; 2]) -> [f64; 2] {
    let [a, b, c] = triangle.corners().map(DVec3::normalize);
    let psi = triangle.turned(triangle.direction([u, v]).map(f64::from)).normalize();
    let normal = a.cross(c - a).normalize();
    let edge = {
        // In a sliver both planes are nearly one, and what their cross product loses shows across them.
        let toward = b.cross(psi - b).cross(normal).normalize();
        let toward = (toward - normal * normal.dot(toward)).normalize();
        toward * 1.0_f64.copysign(toward.dot(a + c))
    };
    let share = solid_angle(a, b, edge) / solid_angle(a, b, c);
    let along = (psi - b).length_squared() / (edge - b).length_squared();
    [(share - f64::from(u)).abs(), (along - f64::from(v)).abs()]
}

fn solid_angle(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    2.0 * libm::atan2(a.dot((b - a).cross(c - a)).abs(), 1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}

struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        ((splitmix64(self.0) >> 12) as f64 + 0.5) / 4_503_599_627_370_496.0
    }

    fn log(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.uniform())
    }

    /// Seen through a plane at distance one: a triangle of random shape, squeezed and turned, somewhere near the middle.
    fn triangle(&mut self) -> [DVec3; 3] {
        loop {
            let squeeze = if self.uniform() < 0.5 { 1.0 } else { self.log(1e-4, 1.0) };
            let omega = self.log(1e-8, TAU);
            let size = (2.0 * omega / squeeze / (1.0 - omega / TAU)).sqrt();
            let (sin, cos) = (TAU * self.uniform()).sin_cos();
            let shift = [self.uniform() - 0.5, self.uniform() - 0.5];
            let corners = [0; 3].map(|_| {
                let [s, t] = [0, 1].map(|k| size * (self.uniform() - 0.5 + shift[k] * 0.5));
                let t = t * squeeze;
                DVec3::new(s * cos - t * sin, s * sin + t * cos, 1.0)
            });
            let [a, b, c] = corners.map(DVec3::normalize);
            let lengths = [0; 3].map(|_| self.log(0.1, 10.0));
            if (1e-8..=2.0 * PI).contains(&solid_angle(a, b, c)) {
                return [a * lengths[0], b * lengths[1], c * lengths[2]];
            }
        }
    }
}
