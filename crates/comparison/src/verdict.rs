//! Verdicts: what the samples say about an estimator's bias, and what they could have found.
//!
//! All N of one (receiver, strategy, sampler) are pooled. The interval of the bias stands against two lines: ±δ, what
//! binary32 arithmetic may add, and ±margin, the bias that still counts as none.
//!
//! - *biased*: the interval lies wholly outside ±δ;
//! - *unbiased*: it lies inside ±margin;
//! - *undecided*: neither, and then `samples_needed` says how many samples would do.
//!
//! Over a run of m verdicts the chance of any false *biased* is at most the familywise level (Holm 1979). The standard
//! deviation is that of the exact variance where there is one. Samples with skewness γ leave the normal law by
//! γ (z² − 1) / (6 √n) standard deviations (Cornish and Fisher 1938), and the interval is wider by that. Where fewer
//! than 30 samples were hits, samples of two values are judged by the binomial law and others not at all; nor are samples
//! that do not show the variance that they are known to have.

use twoforms_estimator::moments::Moments;

use crate::result::Verdict;
use crate::statistics::{binomial_p_value, clopper_pearson, normal_quantile, normal_tail};

/// δ: what binary32 arithmetic may add, as a share of E.
const ARITHMETIC: f64 = 3e-6;
/// Hits below which sums of samples are not taken for normal.
const FEW_HITS: u64 = 30;
/// The share of the exact variance that samples must show, lest a heavy tail has not come up yet.
const SHOWN: f64 = 0.5;
/// Probability at which a bias counts as detectable.
const POWER: f64 = 0.8;

/// When a bias is found, and which one matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Criteria {
    /// Familywise level: the chance of any false alarm in a run.
    pub level: f64,
    /// The bias that still counts as none, as a share of E.
    pub margin: f64,
}

impl Default for Criteria {
    fn default() -> Self {
        Self { level: 0.01, margin: 0.01 }
    }
}

/// All samples of one (receiver, strategy, sampler), against the value they should have.
#[derive(Clone, Debug)]
pub(crate) struct Evidence {
    pub(crate) receiver: usize,
    pub(crate) strategy: String,
    pub(crate) sampler: String,
    /// E, luminance, and the bound of its error.
    pub(crate) reference: (f64, f64),
    /// Exact variance of one sample.
    pub(crate) exact_variance: Option<f64>,
    /// Moments of single samples' luminances.
    pub(crate) samples: Moments,
    /// Samples that were not zero.
    pub(crate) hits: u64,
    /// The one value that samples have where they are not zero.
    pub(crate) one_value: Option<f64>,
}

/// Judges all of a run together; the verdicts come in the order of the evidence.
pub(crate) fn judge(evidence: &[Evidence], criteria: Criteria) -> Vec<Verdict> {
    let p_values: Vec<f64> = evidence.iter().map(Evidence::p_value).collect();
    let levels = holm_levels(&p_values, criteria.level);
    evidence.iter().zip(levels).map(|(evidence, level)| evidence.verdict(level, criteria)).collect()
}

/// The level at which each hypothesis is tested by Holm's step-down procedure: level / (m − rank) in ascending order of
/// p-values up to and with the first that is not rejected, and that one's level for all after it.
fn holm_levels(p_values: &[f64], level: f64) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p_values.len()).collect();
    order.sort_by(|&a, &b| p_values[a].total_cmp(&p_values[b]));
    let mut levels = vec![level; p_values.len()];
    let mut stopped = None;
    for (rank, &index) in order.iter().enumerate() {
        let own = level / (p_values.len() - rank) as f64;
        levels[index] = stopped.unwrap_or(own);
        if stopped.is_none() && p_values[index] > own {
            stopped = Some(own);
        }
    }
    levels
}

/// What can be said about the mean.
enum Law {
    /// All samples are E itself: no chance at all.
    Certain,
    /// Normal, with this standard deviation of the mean and skewness over 6√n.
    Normal { sigma: f64, skew: f64 },
    /// Zero or one value.
    TwoValues { value: f64 },
    /// Too little is known, and why.
    Unknown { note: String },
}

impl Evidence {
    fn difference(&self) -> f64 {
        self.samples.mean - self.reference.0
    }

    /// δ, with what is not known of the reference.
    fn budget(&self) -> f64 {
        let (value, bound) = self.reference;
        bound + if value == 0.0 { ARITHMETIC } else { ARITHMETIC * value }
    }

    fn margin(&self, criteria: Criteria) -> f64 {
        let (value, _) = self.reference;
        if value == 0.0 { criteria.margin } else { criteria.margin * value }
    }

    fn law(&self) -> Law {
        let shown = self.samples.variance().unwrap_or(0.0);
        let variance = self.exact_variance.unwrap_or(shown);
        if self.hits == 0 && self.reference.0 == 0.0
            || variance.sqrt() <= self.budget() && shown.sqrt() <= self.budget()
        {
            return Law::Certain;
        }
        if self.hits < FEW_HITS {
            return match self.one_value {
                Some(value) if self.hits > 0 => Law::TwoValues { value },
                _ => Law::Unknown { note: format!("only {} samples were not zero", self.hits) },
            };
        }
        if shown < SHOWN * variance {
            let note = "the samples are heavy-tailed: they show less than half of the exact variance".to_owned();
            return Law::Unknown { note };
        }
        let Moments { n, m2, m3, .. } = self.samples;
        let skewness = (m3 / n) / (m2 / n).powf(1.5);
        Law::Normal { sigma: (variance / n).sqrt(), skew: skewness.abs() / (6.0 * n.sqrt()) }
    }

    /// The probability of a difference this far beyond ±δ by chance.
    fn p_value(&self) -> f64 {
        let beyond = self.difference().abs() - self.budget();
        match self.law() {
            Law::Certain => f64::from(beyond <= 0.0),
            Law::Normal { .. } | Law::TwoValues { .. } if beyond <= 0.0 => 1.0,
            Law::Normal { sigma, skew } => 2.0 * normal_tail(without_skew(beyond / sigma, skew)),
            Law::TwoValues { value } => {
                let nearest = self.reference.0 + self.budget().copysign(self.difference());
                binomial_p_value(self.hits, self.samples.n as u64, nearest / value)
            }
            Law::Unknown { .. } => 1.0,
        }
    }

    /// The interval of the bias that fails with probability `level`.
    fn interval(&self, level: f64) -> Option<[f64; 2]> {
        let difference = self.difference();
        match self.law() {
            Law::Certain => Some([difference; 2]),
            Law::Normal { sigma, skew } => {
                let half = with_skew(normal_quantile(0.5 * level), skew) * sigma;
                Some([difference - half, difference + half])
            }
            Law::TwoValues { value } => {
                let ends = clopper_pearson(self.hits, self.samples.n as u64, level);
                Some(ends.map(|p| p * value - self.reference.0))
            }
            Law::Unknown { .. } => None,
        }
    }

    fn verdict(&self, level: f64, criteria: Criteria) -> Verdict {
        let (budget, margin) = (self.budget(), self.margin(criteria));
        let interval = self.interval(level);
        let biased = interval.is_some_and(|[lo, hi]| lo > budget || hi < -budget);
        let unbiased = interval.is_some_and(|[lo, hi]| lo >= -margin && hi <= margin);
        let verdict = if biased {
            "biased"
        } else if unbiased {
            "unbiased"
        } else {
            "undecided"
        };
        let undecided = verdict == "undecided";
        Verdict {
            strategy: self.strategy.clone(),
            sampler: self.sampler.clone(),
            difference: self.difference(),
            interval,
            level: criteria.level,
            margin: criteria.margin,
            arithmetic_budget: budget,
            detectable: self.detectable(level),
            samples_needed: undecided.then(|| self.samples_needed(level, margin)).flatten(),
            verdict,
            note: self.note(verdict, margin),
        }
    }

    /// The bias that this many samples find 80 times in 100: δ + (z_level + z_power) σ.
    fn detectable(&self, level: f64) -> Option<f64> {
        match self.law() {
            Law::Normal { sigma, skew } => {
                let z = with_skew(normal_quantile(0.5 * level), skew) + normal_quantile(1.0 - POWER);
                Some(self.budget() + z * sigma)
            }
            Law::Certain => Some(self.budget()),
            Law::TwoValues { .. } | Law::Unknown { .. } => None,
        }
    }

    /// Samples after which an unbiased estimator's interval lies inside ±margin 80 times in 100.
    fn samples_needed(&self, level: f64, margin: f64) -> Option<f64> {
        let one = self.exact_variance.or_else(|| self.samples.variance()).filter(|v| *v > 0.0)?.sqrt();
        let z = normal_quantile(0.5 * level) + normal_quantile(0.5 * (1.0 - POWER));
        Some((z * one / margin).powi(2).ceil())
    }

    fn note(&self, verdict: &str, margin: f64) -> String {
        match (verdict, self.law()) {
            (_, Law::Unknown { note }) => note,
            ("biased", _) if self.difference().abs() < margin => "there is a bias, below the margin".into(),
            ("biased", _) => "there is a bias, beyond the margin".into(),
            ("unbiased", Law::Certain) => "nothing varies".into(),
            ("unbiased", _) => "any bias is below the margin".into(),
            (_, Law::TwoValues { .. }) => format!("{} hits, judged by the binomial law", self.hits),
            _ => "the interval reaches beyond the margin: take more samples".into(),
        }
    }
}

/// z widened by the first Cornish–Fisher term, `skew` = |γ| / (6√n).
fn with_skew(z: f64, skew: f64) -> f64 {
    z + skew * (z * z - 1.0).max(0.0)
}

/// The z that [`with_skew`] widens to `wide`.
fn without_skew(wide: f64, skew: f64) -> f64 {
    if skew == 0.0 || wide <= 1.0 {
        return wide;
    }
    // skew z² + z − (skew + wide) = 0, written so that nothing cancels.
    let c = skew + wide;
    2.0 * c / (1.0 + (1.0 + 4.0 * skew * c).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn evidence(mean: f64, variance: f64, n: f64) -> Evidence {
        Evidence {
            receiver: 0,
            strategy: "s".into(),
            sampler: "independent".into(),
            reference: (1.0, 0.0),
            exact_variance: Some(variance),
            samples: Moments { n, mean, m2: variance * (n - 1.0), m3: 0.0, m4: 3.0 * variance * variance * n },
            hits: n as u64,
            one_value: None,
        }
    }

    fn verdict(evidence: &Evidence) -> &'static str {
        judge(std::slice::from_ref(evidence), Criteria::default())[0].verdict
    }

    #[test]
    fn the_interval_decides() {
        assert_eq!(verdict(&evidence(1.0, 1.0, 1e6)), "unbiased");
        assert_eq!(verdict(&evidence(1.1, 1.0, 1e6)), "biased");
        assert_eq!(verdict(&evidence(1.0, 1.0, 1e3)), "undecided");
        assert_eq!(verdict(&evidence(1.000_002, 1e-30, 1e6)), "unbiased");
        assert_eq!(verdict(&evidence(1.000_004, 1e-30, 1e6)), "biased");
    }

    #[test]
    fn a_bias_below_the_margin_is_found_and_named() {
        let judged = judge(&[evidence(1.005, 1.0, 1e8)], Criteria::default());
        assert_eq!((judged[0].verdict, judged[0].note.as_str()), ("biased", "there is a bias, below the margin"));
    }

    #[test]
    fn few_hits_are_judged_by_the_binomial_law_or_not_at_all() {
        let few = Evidence { hits: 5, one_value: None, ..evidence(1.0, 200.0, 1e3) };
        assert_eq!(verdict(&few), "undecided");
        // 5 hits of 1000 worth 200 each: mean 1, as expected; and against an expectation of 100 hits.
        let two = Evidence { one_value: Some(200.0), ..few };
        assert_eq!(verdict(&two), "undecided");
        assert_eq!(verdict(&Evidence { reference: (20.0, 0.0), ..two }), "biased");
    }

    #[test]
    fn a_tail_that_has_not_come_up_is_no_bias() {
        let mut tail = evidence(0.9, 1.0, 1e6);
        tail.samples.m2 *= 0.1;
        assert_eq!(verdict(&tail), "undecided");
    }

    #[test]
    fn holm_steps_down_and_stops() {
        assert_eq!(holm_levels(&[0.5, 1e-9, 0.004], 0.01), [0.01, 0.01 / 3.0, 0.005]);
        assert_eq!(holm_levels(&[0.5, 0.2, 0.004], 0.01), [0.01 / 3.0; 3]);
    }

    #[test]
    fn skew_widens_and_is_taken_back() {
        for (z, skew) in [(2.0, 0.1), (4.0, 0.0), (3.3, 0.02)] {
            assert!((without_skew(with_skew(z, skew), skew) - z).abs() < 1e-12);
        }
    }
}
