//! Many tests at one level.

/// Level of each of `tests` m independent tests at which all together hold the familywise `level` α:
/// 1 − (1 − α)^(1/m) (Šidák 1967). For m = 0 or 1, α itself.
pub fn sidak(level: f64, tests: usize) -> f64 {
    -libm::expm1(libm::log1p(-level) / tests.max(1) as f64)
}

/// Adjusted p-values of Holm 1979, "A simple sequentially rejective multiple test procedure", in the order given.
///
/// With p₍₁₎ ≤ … ≤ p₍ₘ₎: adjusted p₍ᵢ₎ = max over j ≤ i of min(1, (m − j + 1) p₍ⱼ₎). Rejecting where it is at most α
/// holds the familywise level α under any dependence of the tests.
pub fn holm(p_values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p_values.len()).collect();
    order.sort_by(|&i, &j| p_values[i].total_cmp(&p_values[j]));
    let mut adjusted = vec![0.0; p_values.len()];
    let mut largest = 0.0_f64;
    for (rank, &i) in order.iter().enumerate() {
        largest = largest.max(((p_values.len() - rank) as f64 * p_values[i]).min(1.0));
        adjusted[i] = largest;
    }
    adjusted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sidak_multiplies_back() {
        for tests in [1, 2, 10, 100_000] {
            let each = sidak(0.01, tests);
            let all = -libm::expm1(tests as f64 * libm::log1p(-each));
            assert!((all / 0.01 - 1.0).abs() < 1e-12, "{tests}: {all}");
        }
        assert!((sidak(0.05, 2) - 0.025_320_565_519_103_6).abs() < 1e-15);
        assert_eq!(sidak(0.01, 0), sidak(0.01, 1));
    }

    #[test]
    fn holm_steps_down() {
        let adjusted = holm(&[0.0625, 0.007_812_5, 0.03125, 0.007_812_5]);
        assert_eq!(adjusted, [0.0625, 0.03125, 0.0625, 0.03125]);
    }

    #[test]
    fn holm_is_monotone_and_ends_at_one() {
        assert_eq!(holm(&[0.75, 0.5]), [1.0, 1.0]);
        assert_eq!(holm(&[0.25]), [0.25]);
        assert!(holm(&[]).is_empty());
    }
}
