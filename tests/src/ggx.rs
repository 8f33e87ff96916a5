//! glTF's metals and dielectrics again, as books write them, in binary64: to hold the program's own formulas to.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use twoforms_estimator::glossy::Makeup;

/// α.
pub fn alpha(makeup: &Makeup) -> f64 {
    f64::from(makeup.roughness) * f64::from(makeup.roughness)
}

/// D of a normal m: α² / (π cos⁴θ (α² + tan²θ)²) (Walter et al. 2007, equation 33).
pub fn distribution(alpha: f64, m: DVec3) -> f64 {
    let (cos2, a2) = (m.z * m.z, alpha * alpha);
    let tan2 = (1.0 - cos2) / cos2;
    a2 / (PI * cos2 * cos2 * (a2 + tan2) * (a2 + tan2))
}

/// Λ = (√(1 + α² tan²θ) − 1)/2 (Heitz 2014, equation 72).
pub fn lambda(alpha: f64, v: DVec3) -> f64 {
    let tan2 = (1.0 - v.z * v.z) / (v.z * v.z);
    0.5 * ((1.0 + alpha * alpha * tan2).sqrt() - 1.0)
}

/// G of both directions: 1/(1 + Λ(Θ) + Λ(Ψ)).
pub fn masking(alpha: f64, theta: DVec3, psi: DVec3) -> f64 {
    1.0 / (1.0 + lambda(alpha, theta) + lambda(alpha, psi))
}

/// The density of normals m that Θ sees: D_Θ = G_1 max(0, Θ·m) D/cosθ_o (Heitz 2014, equation 16).
pub fn visible(alpha: f64, theta: DVec3, m: DVec3) -> f64 {
    theta.dot(m).max(0.0) * distribution(alpha, m) / ((1.0 + lambda(alpha, theta)) * theta.z)
}

/// f_r(Ψ↔Θ), RGB: glTF 2.0, appendix B, with `KHR_materials_specular`.
pub fn f_r(makeup: &Makeup, theta: DVec3, psi: DVec3) -> [f64; 3] {
    let alpha = alpha(makeup);
    let half = (theta + psi).normalize();
    let specular = distribution(alpha, half) * masking(alpha, theta, psi) / (4.0 * theta.z * psi.z);
    let fresnel = |f_0: f64| f_0 + (1.0 - f_0) * (1.0 - theta.dot(half)).powi(5);
    let (metallic, weight) = (f64::from(makeup.metallic), f64::from(makeup.specular));
    let f_0 = makeup.f_0.map(f64::from);
    let largest = f_0.into_iter().fold(0.0, f64::max);
    std::array::from_fn(|c| {
        let base = f64::from(makeup.base[c]);
        let dielectric = (1.0 - weight * fresnel(largest)) * base / PI + weight * fresnel(f_0[c]) * specular;
        (1.0 - metallic) * dielectric + metallic * fresnel(base) * specular
    })
}

/// A grid of n × n normals, each with its share of D cosθ: tanθ = α √(u/(1 − u)) (Walter et al. 2007, equation 35), denser where
/// u is near one, as normals that are seen at grazing angles need it: u = 1 − (1 − w)².
fn normals(alpha: f64, n: u32) -> impl Iterator<Item = (DVec3, f64)> {
    let middle = move |k: u32| (f64::from(k) + 0.5) / f64::from(n);
    (0..n * n).map(move |k| {
        let (w, turns) = (middle(k / n), middle(k % n));
        let tan = alpha * (w * (2.0 - w)).sqrt() / (1.0 - w);
        let (sin_phi, cos_phi) = libm::sincos(TAU * turns);
        (DVec3::new(tan * cos_phi, tan * sin_phi, 1.0).normalize(), 2.0 * (1.0 - w) / f64::from(n * n))
    })
}

/// ∫ g(m, Ψ) D_Θ dm over all normals that Θ sees, Ψ being Θ mirrored at m, by such a grid.
pub fn over_visible(alpha: f64, theta: DVec3, n: u32, g: impl Fn(DVec3, DVec3) -> f64) -> f64 {
    let each = |(m, share): (DVec3, f64)| {
        let share = share * visible(alpha, theta, m) / (distribution(alpha, m) * m.z);
        if share > 0.0 { share * g(m, m * (2.0 * theta.dot(m)) - theta) } else { 0.0 }
    };
    normals(alpha, n).map(each).sum()
}

/// How much a white metal reflects of light from everywhere toward Θ: ∫ G/G_1 D_Θ dm, with F = 1 and Ψ above the horizon.
pub fn white_metal_reflects(alpha: f64, theta: DVec3, n: u32) -> f64 {
    let g_1 = 1.0 / (1.0 + lambda(alpha, theta));
    over_visible(alpha, theta, n, |_, psi| if psi.z > 0.0 { masking(alpha, theta, psi) / g_1 } else { 0.0 })
}
