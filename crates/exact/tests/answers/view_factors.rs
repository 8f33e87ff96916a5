//! The catalogue of view factors: E = π L F.

use std::f64::consts::PI;

use glam::DVec3;
use twoforms_estimator::strategy::Strategy;
use twoforms_exact::gauss::legendre;
use twoforms_exact::{Facing, Light, Sight};

use crate::support::{Lamp, Scene, ceiling, lamp, parallelogram};

fn close(value: f64, known: f64, tolerance: f64, what: &str) {
    assert!((value - known).abs() <= tolerance * known.abs(), "{what}: {value:.16e}, known {known:.16e}");
}

fn irradiance(lamp: Lamp, x: DVec3, n: DVec3) -> f64 {
    Scene::of(vec![lamp]).sight(x, n).irradiance().luminance
}

/// Element parallel to a rectangle a × b at height c, below its corner (B-3 of the catalogue):
/// F = [A/√(1+A²) atan(B/√(1+A²)) + B/√(1+B²) atan(A/√(1+B²))]/2π, A = a/c, B = b/c.
#[test]
fn element_and_parallel_rectangle() {
    for (a, b, c) in [(1.0, 1.0, 1.0), (2.0, 0.5, 0.25), (0.125, 3.0, 4.0), (10.0, 8.0, 0.0625)] {
        let (p, q): (f64, f64) = (a / c, b / c);
        let (u, v) = ((1.0 + p * p).sqrt(), (1.0 + q * q).sqrt());
        let known = 0.5 * (p / u * (q / u).atan() + q / v * (p / v).atan());
        let light = lamp(ceiling(DVec3::new(0.5 * a, 0.5 * b, c), a, b), 1.0);
        close(irradiance(light, DVec3::ZERO, DVec3::Z), known, 1e-14, "parallel");
    }
}

/// Element perpendicular to a rectangle a (away from the element's plane) × b at distance c, at its
/// corner (B-4): F = [atan(b/c) − c/√(a²+c²) atan(b/√(a²+c²))]/2π.
#[test]
fn element_and_perpendicular_rectangle() {
    for (a, b, c) in [(1.0, 1.0, 1.0), (2.0, 0.5, 0.25), (0.125, 3.0, 4.0)] {
        let r = f64::hypot(a, c);
        let known = 0.5 * ((b / c).atan() - c / r * (b / r).atan());
        let wall = parallelogram(DVec3::new(c, 0.0, 0.0), DVec3::Z * a, DVec3::Y * b);
        close(irradiance(lamp(wall, 1.0), DVec3::ZERO, DVec3::Z), known, 1e-13, "perpendicular");
    }
}

/// Before a wall that stands on the horizon, where both densities are 0: samples of A cosθ/π + (1 − A) cosθ/Ω, with Ω = E/L, are
/// E/q with probability q = A Ω/π + 1 − A.
#[test]
fn a_mixture_before_a_light_that_stands_on_the_horizon() {
    let wall = parallelogram(DVec3::new(1.0, -0.5, 0.0), DVec3::Z, DVec3::Y);
    let sight = Scene::of(vec![lamp(wall, 1.0)]).sight(DVec3::ZERO, DVec3::Z);
    let e = sight.irradiance().luminance;
    for share in [0.1, 0.5] {
        let name = format!("mixture/{share}(hemisphere/cosine,area/projected-solid-angle)");
        let variance = sight.variance(name.parse().expect("a strategy")).expect("a variance");
        let q = share * e / PI + 1.0 - share;
        close(variance.luminance, e * e * (1.0 / q - 1.0), 1e-9, &name);
    }
}

/// Two unit squares face to face at distance 1: F = 0.19982489569838…, the mean of the element's F.
#[test]
fn parallel_squares() {
    let line = legendre(16);
    let light = lamp(ceiling(DVec3::new(0.5, 0.5, 1.0), 1.0, 1.0), 1.0);
    let mut sum = 0.0;
    for &(x, wx) in &line {
        for &(y, wy) in &line {
            sum += wx * wy * irradiance(light.clone(), DVec3::new(x, y, 0.0), DVec3::Z) / PI;
        }
    }
    close(sum, 0.199_824_895_698_38, 1e-12, "squares");
}

/// A regular polygon of n corners about a point at height h, as one outline.
pub fn polygon(radius: f64, h: f64, n: usize) -> Sight {
    let step = std::f64::consts::TAU / n as f64;
    let rim = |k: usize| DVec3::new(radius * (step * k as f64).cos(), -radius * (step * k as f64).sin(), h);
    let area = 0.5 * n as f64 * step.sin() * radius * radius;
    let facing = Facing {
        target: 0,
        light: 0,
        corners: (0..n).map(rim).collect(),
        faces: true,
        area,
        radiance: [1.0; 3],
        emitted: 1.0,
        glow: None,
        blockers: Vec::new(),
    };
    Sight::new(&[facing], &[Light { area, power: area }]).unwrap()
}

/// Coaxial disk of radius R at height h, t = R²/h², c = 1/√(1+t): E = π t/(1+t) and all variances
/// are elementary. Polygons of n and 2n corners, extrapolated in 1/n².
#[test]
fn coaxial_disk() {
    for (radius, h) in [(1.0_f64, 1.0_f64), (0.25, 1.0), (3.0, 0.5)] {
        let t = (radius / h).powi(2);
        let c = 1.0 / (1.0 + t).sqrt();
        let pi2 = PI * PI;
        let answers = [
            ("area/uniform", pi2 * (t / 3.0 * (1.0 - (1.0 + t).powi(-3)) - (t / (1.0 + t)).powi(2))),
            ("area/solid-angle", pi2 * (1.0 - c).powi(4) / 3.0),
            ("hemisphere/cosine", pi2 * c * c * (1.0 - c * c)),
            ("hemisphere/uniform", pi2 * (4.0 * (1.0 - c.powi(3)) / 3.0 - (1.0 - c * c).powi(2))),
        ];
        let (coarse, fine) = (polygon(radius, h, 1000), polygon(radius, h, 2000));
        let extrapolated = |value: &dyn Fn(&Sight) -> f64| (4.0 * value(&fine) - value(&coarse)) / 3.0;
        close(extrapolated(&|sight| sight.irradiance().luminance), PI * t / (1.0 + t), 1e-10, "disk");
        for (name, known) in answers {
            let strategy: Strategy = name.parse().unwrap();
            close(extrapolated(&|sight| sight.variance(strategy).unwrap().luminance), known, 1e-9, name);
        }
    }
}

/// A wall light that touches the floor, 1 m × 1 m, seen from distance s: s² E[w²] → π/24.
#[test]
fn wall_light_near_the_corner() {
    for s in [1e-3, 1e-4] {
        let wall = parallelogram(DVec3::ZERO, DVec3::Y, DVec3::Z);
        let sight = Scene::of(vec![lamp(wall, 1.0)]).sight(DVec3::new(s, 0.5, 0.0), DVec3::Z);
        let e = sight.irradiance().luminance;
        let v = sight.variance("area/uniform".parse().unwrap()).unwrap().luminance;
        close(s * s * (v + e * e), PI / 24.0, 10.0 * s, "wall");
    }
}
