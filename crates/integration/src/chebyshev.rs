//! Chebyshev's bound against what happened.

/// The band that Chebyshev's inequality draws around I, and the share of estimates outside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// σ_N/√δ: half the band's width, in the estimates' unit.
    pub bound: f64,
    /// Share of the estimates with |⟨I⟩ − I| ≥ σ_N/√δ.
    pub outside: f64,
}

/// How often Pr(|⟨I⟩ − I| ≥ σ_N/√δ) ≤ δ was kept (Chebyshev 1867): estimates around their expected value I, with σ_N the standard
/// deviation of each, and 0 < δ ≤ 1. `None` for other δ, without estimates, and where σ_N is not positive and finite.
///
/// With the estimates' own mean and sample standard deviation the share never exceeds δ, whatever the data:
/// share · σ_N²/δ ≤ Σ(⟨I⟩ − mean)²/R < σ_N². With a reference from elsewhere it may, by chance or by bias.
///
/// ```
/// use twoforms_integration::{Discrete, Source, Variable, chebyshev};
///
/// // Means of nine throws of the average die: at most a quarter of them lie 2 σ_N or more away, and far fewer do.
/// let die = Discrete::equally_likely([2.0, 3.0, 3.0, 4.0, 4.0, 5.0])?;
/// let means = die.replicates(&Source::independent(0), 9, 1000)?;
/// let sigma_n = (die.variance() / 9.0).sqrt();
/// let band = chebyshev(&means.estimates, die.mean(), sigma_n, 0.25);
/// assert!(band.is_some_and(|band| band.outside < 0.1));
/// # Ok::<(), twoforms_integration::Error>(())
/// ```
pub fn chebyshev(estimates: &[f64], i: f64, sigma_n: f64, delta: f64) -> Option<Band> {
    let stated = sigma_n > 0.0 && sigma_n.is_finite() && 0.0 < delta && delta <= 1.0;
    let bound = sigma_n / delta.sqrt();
    let count = estimates.iter().filter(|&estimate| (estimate - i).abs() >= bound).count();
    (stated && !estimates.is_empty()).then(|| Band { bound, outside: count as f64 / estimates.len() as f64 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Moments;

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
            let moments = Moments::of(&data);
            let (mean, sigma) = (moments.mean, moments.variance().unwrap_or(f64::NAN).sqrt());
            for delta in [0.01, 0.05, 0.1, 0.5, 1.0] {
                let outside = chebyshev(&data, mean, sigma, delta).map(|band| band.outside);
                assert!(outside.is_some_and(|share| share <= delta), "{rare} {delta} {outside:?}");
            }
        }
    }
}
