//! Weighted strategies next to a light, against one-purpose quadrature.

use std::f64::consts::PI;

use glam::DVec3;
use twoforms_exact::Sight;
use twoforms_exact::gauss::legendre;

use crate::support::{Scene, ceiling, lamp, parallelogram};

/// Σ over nodes of ρ = p_h/p_a with weight dA/A, unit radiance, everything visible: the
/// definitions, as they stand.
fn definitions(nodes: &[(f64, f64)]) -> Vec<(&'static str, f64)> {
    let integral = |f: &dyn Fn(f64) -> f64| nodes.iter().map(|&(rho, weight)| weight * f(rho)).sum::<f64>();
    let e = integral(&|r| PI * r);
    let squares = |f: &dyn Fn(f64) -> f64| f64::powi(integral(f), 2);
    let mixture = |a: f64| integral(&|r| (PI * r).powi(2) / (1.0 - a + a * r)) - e * e;
    let balance = integral(&|r| (PI * r).powi(2) / (1.0 + r))
        - squares(&|r| PI * r / (1.0 + r))
        - squares(&|r| PI * r * r / (1.0 + r));
    let power = integral(&|r| (PI * r).powi(2) * (1.0 + r.powi(3)) / (1.0 + r * r).powi(2))
        - squares(&|r| PI * r / (1.0 + r * r))
        - squares(&|r| PI * r.powi(3) / (1.0 + r * r));
    // A α = b with what misses the light in A_hh
    let aa = integral(&|r| 1.0 / (1.0 + r));
    let ah = integral(&|r| r / (1.0 + r));
    let hh = integral(&|r| r * r / (1.0 + r)) + 1.0 - e / PI;
    let (b_a, b_h) = (integral(&|r| PI * r / (1.0 + r)), integral(&|r| PI * r * r / (1.0 + r)));
    let determinant = aa * hh - ah * ah;
    let (alpha_a, alpha_h) = ((b_a * hh - b_h * ah) / determinant, (b_h * aa - b_a * ah) / determinant);
    let optimal = integral(&|r| (PI * r).powi(2) / (1.0 + r)) - alpha_a * b_a - alpha_h * b_h;
    vec![
        ("mis/balance", balance),
        ("mis/power", power),
        ("mis/optimal", optimal),
        ("mixture/0.1", mixture(0.1)),
        ("mixture/0.5", mixture(0.5)),
    ]
}

fn compare(sight: &Sight, nodes: &[(f64, f64)], what: &str) {
    let e2 = sight.irradiance().luminance.powi(2);
    for (name, known) in definitions(nodes) {
        let value = sight.variance(name.parse().unwrap()).unwrap();
        let error = (value.luminance - known).abs();
        assert!(error <= 1e-8 * known + 1e-11 * e2, "{what}: {name}: {} known {known}", value.luminance);
        assert!(
            error <= value.error_bound + 1e-11 * e2,
            "{what}: {name}: error {error:e} bound {:e}",
            value.error_bound
        );
    }
}

/// Composite rule on [0, 1].
fn composite(panels: usize, n: usize) -> Vec<(f64, f64)> {
    let width = 1.0 / panels as f64;
    let rule = legendre(n);
    (0..panels)
        .flat_map(|k| rule.iter().map(move |&(x, w)| ((k as f64 + x) * width, w * width)).collect::<Vec<_>>())
        .collect()
}

/// Below the centre of a unit square at height h: polar coordinates, r = h sinh τ, an eighth of the
/// square.
#[test]
fn under_a_light() {
    for h in [0.1_f64, 1e-2, 1e-4] {
        let mut nodes = Vec::new();
        for (phi, w_phi) in legendre(24) {
            let phi = 0.25 * PI * phi;
            let end = (0.5 / phi.cos() / h).asinh();
            for (tau, w_tau) in composite(40, 12) {
                let (r, dr) = (h * (end * tau).sinh(), h * (end * tau).cosh() * end * w_tau);
                let rho = h * h / (PI * (h * h + r * r).powi(2));
                nodes.push((rho, 8.0 * 0.25 * PI * w_phi * r * dr));
            }
        }
        let scene = Scene::of(vec![lamp(ceiling(DVec3::new(0.0, 0.0, h), 1.0, 1.0), 1.0)]);
        compare(&scene.sight(DVec3::ZERO, DVec3::Z), &nodes, &format!("height {h}"));
    }
}

/// Before a wall light that touches the floor, at distance s: both coordinates graded toward the
/// receiver's foot, heights down to e^−45.
#[test]
fn before_a_wall_light() {
    for s in [0.1_f64, 1e-2, 1e-3] {
        let mut nodes = Vec::new();
        let end = (0.5 / s).asinh();
        for (tau, w_tau) in composite(24, 10) {
            let (y, dy) = (s * (end * tau).sinh(), s * (end * tau).cosh() * end * w_tau);
            for (zeta, w_zeta) in composite(120, 10) {
                let z = (-45.0 * zeta).exp();
                let r2 = s * s + y * y + z * z;
                nodes.push((z * s / (PI * r2 * r2), 2.0 * dy * 45.0 * z * w_zeta));
            }
        }
        let scene = Scene::of(vec![lamp(parallelogram(DVec3::ZERO, DVec3::Y, DVec3::Z), 1.0)]);
        compare(&scene.sight(DVec3::new(s, 0.5, 0.0), DVec3::Z), &nodes, &format!("distance {s}"));
    }
}
