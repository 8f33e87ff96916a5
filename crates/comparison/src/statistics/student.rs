//! Quantiles of Student's t.

/// The normal quantile of 97.5 %: half the width of a 95 % interval, in standard deviations.
pub const Z_95: f64 = 1.959_963_984_540_054;

/// Quantile of Student's t with `freedom` ν degrees of freedom that corresponds to the normal quantile `z`.
///
/// t = z + g₁/ν + g₂/ν² + g₃/ν³ + g₄/ν⁴, Cornish and Fisher's expansion (Abramowitz and Stegun 1964, 26.7.5). At the
/// 97.5 % point it is within 1 % for ν ≥ 2, the least that occurs here, and within 0.02 % for ν ≥ 5. Infinite ν gives
/// z.
pub fn student_quantile(z: f64, freedom: f64) -> f64 {
    let z2 = z * z;
    let g1 = (z2 + 1.0) * z / 4.0;
    let g2 = ((5.0 * z2 + 16.0) * z2 + 3.0) * z / 96.0;
    let g3 = (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) * z / 384.0;
    let g4 = ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) * z / 92_160.0;
    let v = 1.0 / freedom;
    z + v * (g1 + v * (g2 + v * (g3 + v * g4)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_table() {
        let table = [(5.0, 2.570_582), (10.0, 2.228_139), (30.0, 2.042_272), (120.0, 1.979_930)];
        for (freedom, t) in table {
            assert!((student_quantile(Z_95, freedom) / t - 1.0).abs() < 2e-4, "{freedom}");
            assert!((student_quantile(-Z_95, freedom) / -t - 1.0).abs() < 2e-4, "{freedom}");
        }
        assert!((student_quantile(Z_95, 2.0) / 4.302_653 - 1.0).abs() < 0.01);
        assert_eq!(student_quantile(Z_95, f64::INFINITY), Z_95);
    }
}
