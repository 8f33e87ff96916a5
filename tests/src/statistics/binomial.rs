//! Is a probability what it should be? Exact for any number of trials and hits.

use std::fmt;

/// k hits in n independent trials of probability `probability`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BinomialTest {
    /// k.
    pub hits: u64,
    /// n.
    pub trials: u64,
    /// The probability of a hit.
    pub probability: f64,
}

impl BinomialTest {
    /// Twice the smaller of Pr(K ≥ k) and Pr(K ≤ k), at most 1.
    pub fn p(&self) -> f64 {
        let Self { hits, trials, probability } = *self;
        if probability <= 0.0 {
            return if hits == 0 { 1.0 } else { 0.0 };
        }
        if probability >= 1.0 {
            return if hits == trials { 1.0 } else { 0.0 };
        }
        let above = hits as f64 > trials as f64 * probability;
        let tail = if above {
            at_least(hits, trials, probability)
        } else {
            at_least(trials - hits, trials, 1.0 - probability)
        };
        (2.0 * tail).min(1.0)
    }
}

impl fmt::Display for BinomialTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { hits, trials, probability } = self;
        let (mean, p) = (*trials as f64 * probability, self.p());
        write!(f, "{hits} hits of {trials}, expected {mean:.2}: p = {p:.2e}")
    }
}

/// Pr(K ≥ k) for k at or above the mean: Pr(K = k) times the sum of the ratios of what follows to it.
fn at_least(k: u64, n: u64, p: f64) -> f64 {
    let (k, n) = (k as f64, n as f64);
    let ln_choose = libm::lgamma(n + 1.0) - libm::lgamma(k + 1.0) - libm::lgamma(n - k + 1.0);
    let first = libm::exp(ln_choose + k * libm::log(p) + (n - k) * libm::log1p(-p));
    let (mut sum, mut term, mut j) = (1.0, 1.0, k);
    while j < n && term > 1e-17 * sum {
        term *= (n - j) / (j + 1.0) * (p / (1.0 - p));
        sum += term;
        j += 1.0;
    }
    first * sum
}

#[cfg(test)]
mod tests {
    use super::BinomialTest;

    fn p(hits: u64, trials: u64, probability: f64) -> f64 {
        BinomialTest { hits, trials, probability }.p()
    }

    /// Ten tosses of a fair coin: Pr(K ≥ 9) = 11/1024.
    #[test]
    fn tails_by_hand() {
        assert!((p(9, 10, 0.5) - 22.0 / 1024.0).abs() < 1e-14);
        assert!((p(1, 10, 0.5) - 22.0 / 1024.0).abs() < 1e-14);
        assert_eq!(p(5, 10, 0.5), 1.0);
        assert!((p(0, 100, 0.25) - 2.0 * libm::pow(0.75, 100.0)).abs() < 1e-24);
    }

    /// Far from the ends it is the normal one: k = mean + 3σ with the continuity correction.
    #[test]
    fn many_trials() {
        let normal = libm::erfc((3.0 - 0.5 / 500.0) / std::f64::consts::SQRT_2);
        assert!((p(501_500, 1_000_000, 0.5) / normal - 1.0).abs() < 1e-3);
        assert!((p(498_500, 1_000_000, 0.5) / normal - 1.0).abs() < 1e-3);
    }

    #[test]
    fn what_is_certain_must_happen() {
        assert_eq!([p(7, 7, 1.0), p(6, 7, 1.0), p(0, 7, 0.0), p(1, 7, 0.0)], [1.0, 0.0, 1.0, 0.0]);
    }
}
