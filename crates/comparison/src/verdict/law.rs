//! What is known about how a mean is distributed, and what follows: p-values, intervals, power.

use crate::statistics::{binomial_p_value, clopper_pearson, normal_quantile, normal_tail, student_quantile};

/// Probability at which a bias counts as detectable.
pub(super) const POWER: f64 = 0.8;
/// Beyond so many standard deviations the normal tail is zero in binary64.
const FAR: f64 = 40.0;

/// The law of the mean of n independent samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Law {
    /// Nothing varies: there is no chance at all.
    Certain,
    /// Normal, with this standard deviation of the mean, |γ| / (6 √n) for the samples' skewness γ, and the degrees of
    /// freedom behind the standard deviation (infinite where it is exact).
    Normal { sigma: f64, skew: f64, freedom: f64 },
    /// Samples are worth zero or `value`: k = `hits` of n were not zero.
    TwoValues { value: f64, hits: u64, n: u64 },
    /// Samples with known variance whose tail has not come up: inequalities in place of a law. E\[w²\] of samples w ≥ 0; infinite where
    /// they can be negative.
    Bounded { variance: f64, second: f64, n: f64 },
    /// Too little is known, and why.
    Unknown { note: &'static str },
}

impl Law {
    /// The probability of a mean that differs from the reference by `difference` or more, if the bias is within
    /// ±`budget`. At most a level exactly where [`Law::interval`] at that level lies outside ±`budget`.
    pub(super) fn p_value(self, reference: f64, difference: f64, budget: f64) -> f64 {
        let beyond = difference.abs() - budget;
        match self {
            Self::Certain if beyond > 0.0 => 0.0,
            Self::Certain | Self::Unknown { .. } => 1.0,
            _ if beyond <= 0.0 => 1.0,
            Self::Normal { sigma, skew, freedom } => 2.0 * normal_tail(narrowed(beyond / sigma, skew, freedom)),
            Self::TwoValues { value, hits, n } => {
                let p = (reference + budget.copysign(difference)) / value;
                if 0.0 < p && p < 1.0 { binomial_p_value(hits, n, p) } else { 1.0 }
            }
            Self::Bounded { variance, second, n } => {
                let above = 2.0 * variance / (variance + n * beyond * beyond);
                let below = 2.0 * libm::exp(-0.5 * n * beyond * beyond / second);
                above.min(if difference < 0.0 { below } else { 1.0 }).min(1.0)
            }
        }
    }

    /// The interval of the bias that leaves out the true one with probability `level` at most.
    pub(super) fn interval(self, reference: f64, difference: f64, level: f64) -> Option<[f64; 2]> {
        match self {
            Self::Certain => Some([difference; 2]),
            Self::Normal { sigma, skew, freedom } => {
                let half = widened(normal_quantile(0.5 * level), skew, freedom) * sigma;
                Some([difference - half, difference + half])
            }
            Self::TwoValues { value, hits, n } => Some(clopper_pearson(hits, n, level).map(|p| p * value - reference)),
            Self::Bounded { variance, second, n } => {
                let above = (variance / n).sqrt() * cantelli(0.5 * level);
                let below = (2.0 * second / n * -libm::log(0.5 * level)).sqrt();
                Some([difference - above, difference + below.min(above)])
            }
            Self::Unknown { .. } => None,
        }
    }

    /// The bias that is found 80 times in 100, absolute: its interval then lies outside ±`budget`.
    pub(super) fn detectable(self, reference: f64, budget: f64, level: f64) -> Option<f64> {
        match self {
            Self::Certain => Some(budget),
            Self::Normal { sigma, skew, freedom } => {
                let z = widened(normal_quantile(0.5 * level), skew, freedom) + normal_quantile(1.0 - POWER);
                Some(budget + z * sigma)
            }
            Self::TwoValues { value, n, .. } => {
                let least = least_hits((reference + budget) / value, n, level)?;
                // The p at which Pr(K ≥ least) is the power: the upper end of an interval for one hit less.
                let [_, p] = clopper_pearson(least - 1, n, 2.0 * (1.0 - POWER));
                Some(p * value - reference)
            }
            Self::Bounded { variance, n, .. } => {
                Some(budget + (variance / n).sqrt() * (cantelli(0.5 * level) + cantelli(1.0 - POWER)))
            }
            Self::Unknown { .. } => None,
        }
    }
}

/// √(1/tail − 1): Pr(mean ≥ μ + c σ) ≤ 1/(1 + c²) = tail, whatever the law, and below the mean alike (Cantelli 1928).
///
/// Below it samples w ≥ 0 mostly do better: Pr(mean ≤ μ − t) ≤ exp(−n t² / (2 E\[w²\])), from E\[exp(−λ w)\] ≤
/// exp(−λ μ + λ² E\[w²\]/2).
fn cantelli(tail: f64) -> f64 {
    (1.0 / tail - 1.0).sqrt()
}

/// The fewest hits of n that are too many for the probability p at `level`; none where even n are not.
fn least_hits(p: f64, n: u64, level: f64) -> Option<u64> {
    let too_many = |hits: u64| binomial_p_value(hits, n, p) <= level;
    let expected = (n as f64 * p).ceil() as u64;
    if !(0.0 < p && p < 1.0) || expected > n || !too_many(n) {
        return None;
    }
    let (mut low, mut high) = (expected, n);
    while low < high {
        let middle = low + (high - low) / 2;
        if too_many(middle) { high = middle } else { low = middle + 1 }
    }
    Some(high.max(1))
}

/// The normal quantile z as the quantile of a mean of skewed samples (the first term of Cornish and Fisher 1938: z +
/// γ (z² − 1) / (6 √n), for the side on which it is the longer), and of Student's t.
fn widened(z: f64, skew: f64, freedom: f64) -> f64 {
    let skewed = z + skew * (z * z - 1.0).max(0.0);
    if freedom.is_finite() { student_quantile(skewed, freedom) } else { skewed }
}

/// The z that [`widened`] takes to `wide`, by bisection: it rises with z, and is nowhere below z.
fn narrowed(wide: f64, skew: f64, freedom: f64) -> f64 {
    let (mut low, mut high) = (0.0, wide.min(FAR));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if widened(middle, skew, freedom) < wide { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAWS: [Law; 6] = [
        Law::Normal { sigma: 0.01, skew: 0.02, freedom: f64::INFINITY },
        Law::Normal { sigma: 0.01, skew: 0.0, freedom: 40.0 },
        Law::Bounded { variance: 1.0, second: 2.0, n: 1e4 },
        Law::Bounded { variance: 1.0, second: f64::INFINITY, n: 1e4 },
        Law::TwoValues { value: 2.0, hits: 5300, n: 10_000 },
        Law::TwoValues { value: 2.0, hits: 4600, n: 10_000 },
    ];

    fn difference(law: Law) -> Vec<f64> {
        match law {
            Law::TwoValues { value, hits, n } => vec![value * hits as f64 / n as f64 - 1.0],
            _ => [-1.0, 1.0].iter().flat_map(|sign| [0.03, 0.06, 0.4].map(|d| sign * d)).collect(),
        }
    }

    /// The interval at the level of the p-value ends on the line.
    #[test]
    fn the_p_value_is_the_level_at_which_the_interval_reaches_the_budget() {
        let budget = 1e-3;
        for law in LAWS {
            for d in difference(law) {
                let p = law.p_value(1.0, d, budget);
                if p > 1e-12 && p < 0.3 {
                    let [lo, hi] = law.interval(1.0, d, p).expect("an interval");
                    let end = if d > 0.0 { lo } else { -hi };
                    assert!((end - budget).abs() < 1e-6, "{law:?} {d}: {p:e}, [{lo}, {hi}]");
                }
            }
        }
    }

    /// Summed over the hits of a binomial law: the detectable bias is found 80 times in 100, one a bit below less often.
    #[test]
    fn a_detectable_bias_of_two_values_is_found_80_times_in_100() {
        let (n, value, level) = (200_u64, 4.0, 1e-3);
        let law = |hits| Law::TwoValues { value, hits, n };
        let detectable = law(50).detectable(1.0, 0.0, level).expect("one");
        let probability = |k: u64, p: f64| {
            let (k, n) = (k as f64, n as f64);
            let choose = libm::lgamma(n + 1.0) - libm::lgamma(k + 1.0) - libm::lgamma(n - k + 1.0);
            libm::exp(choose + k * libm::log(p) + (n - k) * libm::log1p(-p))
        };
        let p = (1.0 + detectable) / value;
        let is_found = |k: &u64| law(*k).interval(1.0, 0.0, level).is_some_and(|[lo, _]| lo > 0.0);
        let power: f64 = (0..=n).filter(is_found).map(|k| probability(k, p)).sum();
        assert!((power - POWER).abs() < 1e-9, "{power}");
    }

    #[test]
    fn widening_is_taken_back() {
        for (z, skew, freedom) in [(2.0, 0.1, f64::INFINITY), (4.0, 0.0, 30.0), (0.5, 0.2, 8.0), (3.3, 0.02, 1e3)] {
            assert!((narrowed(widened(z, skew, freedom), skew, freedom) - z).abs() < 1e-9);
        }
        assert_eq!(normal_tail(narrowed(f64::INFINITY, 0.0, f64::INFINITY)), 0.0);
    }
}
