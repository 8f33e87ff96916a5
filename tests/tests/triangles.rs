//! Spherical triangles of any size and shape: their solid angle, and what is drawn over them.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use rand_philox::splitmix64;
use rayon::prelude::*;
use twoforms_estimator::density::{Piece, each_piece};

/// What solid angles and draws may be off by, as a share of what they are of.
const PROMISED: f64 = 1e-5;
/// How many triangles are tried, unless `TWOFORMS_TRIANGLES` says otherwise.
const TRIANGLES: u64 = 1_000_000;
const SEED: u64 = 20_261_123;

struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        ((splitmix64(self.0) >> 12) as f64 + 0.5) / 4_503_599_627_370_496.0
    }

    fn log(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.uniform())
    }

    /// Log-uniform in solid angle from 10⁻⁸ sr to 2π sr, and half of them slivers, up to 10⁴ times as long as wide on top of their
    /// random shape: seen through a plane at distance one, somewhere near the middle, each corner at a distance of its own.
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
            if (1e-8..=2.0 * PI).contains(&solid_angle([a, b, c])) {
                return corners.map(|corner| corner * self.log(0.1, 10.0));
            }
        }
    }
}

/// Of three unit vectors, by Eriksson's formula with the sides of the triangle, which do not cancel.
fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    2.0 * libm::atan2(a.dot((b - a).cross(c - a)).abs(), 1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}

/// How far off a triangle is: its solid angle, as a share of it; of what is drawn in one of its parts at (u, v), the solid angle
/// that is put on the wrong side of the arc at u, and of the one at v, as shares of the part's.
type Off = [f64; 3];

/// The largest error of the triangle's solid angle and of one draw in each of its parts.
fn off(random: &mut Random) -> Off {
    let corners = random.triangle();
    let whole = solid_angle(corners.map(DVec3::normalize));
    let (mut sum, mut most) = (0.0, [0.0; 3]);
    each_piece(&corners, |piece| {
        sum += piece.solid_angle();
        let uv = [random.uniform() as f32, random.uniform() as f32];
        let [u, v] = drawn(&piece, uv);
        most = worse(most, [0.0, u, v]);
    });
    // The density is its inverse in binary32.
    let told = 1.0 / f64::from((1.0 / sum) as f32);
    worse(most, [told / whole - 1.0, 0.0, 0.0])
}

/// The larger of each; what is not a number is larger than any.
fn worse(one: Off, other: Off) -> Off {
    let size = |off: f64| if off.is_nan() { f64::INFINITY } else { off.abs() };
    std::array::from_fn(|k| size(one[k]).max(size(other[k])))
}

/// How far apart (u, v) and the two numbers of what they draw are, found from its direction by other formulas in binary64. Between
/// B and the arc at v lies the share v, so that u parts no more than that of what is drawn there.
fn drawn(piece: &Piece, [u, v]: [f32; 2]) -> [f64; 2] {
    let Piece::Triangle(triangle) = piece else { panic!("three corners are no rectangle") };
    let [a, b, c] = triangle.corners().map(DVec3::normalize);
    let psi = triangle.turned(triangle.direction([u, v]).map(f64::from)).normalize();
    let normal = a.cross(c - a).normalize();
    // C′; in a sliver both planes are nearly one, and what their cross product loses shows across them.
    let toward = b.cross(psi - b).cross(normal).normalize();
    let toward = (toward - normal * normal.dot(toward)).normalize();
    let edge = toward * 1.0_f64.copysign(toward.dot(a + c));
    let before = solid_angle([a, b, edge]) / solid_angle([a, b, c]);
    let along = (psi - b).length_squared() / (edge - b).length_squared();
    [(before - f64::from(u)) * f64::from(v), along - f64::from(v)]
}

/// With ten million: `TWOFORMS_TRIANGLES=10000000 cargo test --release -p twoforms-tests --test triangles -- --nocapture`.
#[test]
fn draws_are_uniform_over_triangles_of_any_size_and_shape() {
    let asked = std::env::var("TWOFORMS_TRIANGLES").ok();
    let count = asked.map_or(TRIANGLES, |count| count.parse().expect("a number of triangles"));
    let each = |k: u64| off(&mut Random(splitmix64(SEED ^ splitmix64(k))));
    let most = (0..count).into_par_iter().map(each).reduce(|| [0.0; 3], worse);
    println!("{count} triangles: solid angle off by {:.1e}, u by {:.1e}, v by {:.1e}", most[0], most[1], most[2]);
    assert!(most.iter().all(|&off| off < PROMISED), "{most:?}");
}
