//! Chebyshev's bound against what happened.

/// The band that Chebyshev's inequality draws around I, and the share of replicates outside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// σ_N/√δ: half the band's width, in the estimates' unit.
    pub bound: f64,
    /// Share of the estimates with |⟨I⟩ − I| ≥ σ_N/√δ; Chebyshev says at most δ in the long run.
    pub outside: f64,
}

/// How often Pr(|⟨I⟩ − I| ≥ σ_N/√δ) ≤ δ was kept (Chebyshev 1867): `estimates` ⟨I⟩ around `centre` I, with standard
/// deviation `sigma_n` σ_N of an N-sample estimate, and 0 < `delta` δ ≤ 1.
///
/// With the estimates' own mean and sample standard deviation the share never exceeds δ, whatever the data:
/// share · σ_N²/δ ≤ Σ(⟨I⟩ − mean)²/R < σ_N². With a reference from elsewhere it may, by chance or by bias.
///
/// `None` without estimates, where σ_N is not positive (the inequality speaks of a positive width), or for other δ.
pub fn chebyshev(estimates: &[f64], centre: f64, sigma_n: f64, delta: f64) -> Option<Band> {
    let stated = sigma_n > 0.0 && sigma_n.is_finite() && 0.0 < delta && delta <= 1.0;
    let bound = sigma_n / delta.sqrt();
    let count = estimates.iter().filter(|&estimate| (estimate - centre).abs() >= bound).count();
    (stated && !estimates.is_empty()).then(|| Band { bound, outside: count as f64 / estimates.len() as f64 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::{sample_mean, sample_variance};

    #[test]
    fn counts_the_edge_as_outside() {
        let band = chebyshev(&[-2.0, -1.0, 0.0, 1.0, 2.0], 0.0, 1.0, 0.25);
        assert_eq!(band, Some(Band { bound: 2.0, outside: 0.4 }));
    }

    #[test]
    fn needs_a_positive_width() {
        assert_eq!(chebyshev(&[1.0], 1.0, 0.0, 0.1), None);
        assert_eq!(chebyshev(&[1.0], 1.0, f64::NAN, 0.1), None);
        assert_eq!(chebyshev(&[1.0], 1.0, 1.0, 0.0), None);
        assert_eq!(chebyshev(&[1.0], 1.0, 1.0, 1.5), None);
        assert_eq!(chebyshev(&[], 1.0, 1.0, 0.1), None);
    }

    /// Two-point data reach the bound: with one estimate in ten far away, the share is δ's largest possible value.
    #[test]
    fn own_moments_never_exceed_delta() {
        for rare in 1..50 {
            let data: Vec<f64> = (0..100).map(|k| if k < rare { 1e6 } else { f64::from(k % 3) }).collect();
            let mean = sample_mean(&data).unwrap_or(f64::NAN);
            let sigma = sample_variance(&data).unwrap_or(f64::NAN).sqrt();
            for delta in [0.01, 0.05, 0.1, 0.5, 1.0] {
                let outside = chebyshev(&data, mean, sigma, delta).map(|band| band.outside);
                assert!(outside.is_some_and(|share| share <= delta), "{rare} {delta} {outside:?}");
            }
        }
    }
}
