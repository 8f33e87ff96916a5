//! Verdicts: what the samples say about an estimator's bias, and what they could have found.
//!
//! All N of one (receiver, strategy, sampler) are pooled. The interval of the bias stands against two lines: ±δ, what
//! binary32 arithmetic may add, and ±margin, the bias that still counts as none.
//!
//! - *biased*: the interval lies wholly outside ±δ;
//! - *unbiased*: it lies inside ±margin;
//! - *undecided*: neither, and then `samples_needed` says how many samples would do.
//!
//! Over a run of m verdicts the chance of any false *biased* is at most the familywise level (Holm 1979).
//!
//! How the interval is found depends on what is known:
//!
//! - Samples worth zero or one value follow the binomial law exactly. A few equal samples do not prove that there is one
//!   value; but with the variance known, that value can only be E\[w²\]/E.
//! - With fewer than 30 samples expected not to be zero (at least n E²/E\[w²\] are, by Cauchy and Schwarz), others are not
//!   judged.
//! - Otherwise the mean is normal, with the standard deviation of the exact variance where there is one, or of the
//!   samples where they vary more; wider by the skewness that the samples show (Cornish and Fisher 1938), and by
//!   Student's t where the variance is measured. Where fewer than 30 samples carry that, a tail may be to come of which
//!   nothing is known, and there is no verdict.
//! - Samples that show less than half of their exact variance have a tail that has not come up. No normal law holds
//!   there; inequalities do, with a shorter arm toward the bias that would hide in the tail.

mod law;

use twoforms_estimator::moments::Moments;

use crate::result::Verdict;
use crate::statistics::normal_quantile;
use law::{Law, POWER};

/// δ: what binary32 arithmetic may add, as a share of E.
const ARITHMETIC: f64 = 3e-6;
/// Hits below which sums of samples are not taken for normal.
const FEW_HITS: f64 = 30.0;
/// The share of the exact variance that samples must show, lest a heavy tail has not come up yet.
const SHOWN: f64 = 0.5;
/// How near samples must be to the one value that they can have: binary32 and its arithmetic.
const SAME: f64 = 1e-5;

/// Replicates below which their mean is not taken for normal, where the samples of each depend on each other.
const FEW_REPLICATES: f64 = 300.0;
const TOO_FEW_REPLICATES: &str = "fewer than 300 replicates of samples that depend on each other: too few to judge by";
const TOO_FEW: &str = "fewer than 30 samples that are not zero: too few to judge by";
const STRAY_LIGHT: &str = "light where there should be none, in too few samples to judge by";
const FEW_CARRY: &str =
    "heavy-tailed: fewer than 30 samples carry the variance that is seen, and more may not be: too few to judge by";
const HEAVY_TAIL: &str = "heavy-tailed: the samples show less than half of their exact variance";

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
    /// Exact variance of one unit.
    pub(crate) exact_variance: Option<f64>,
    /// Moments of the luminances of independent units, none of them negative unless they are signed: single samples, or replicates where the
    /// samples of one depend on each other.
    pub(crate) units: Moments,
    /// Samples in a unit.
    pub(crate) samples_per_unit: f64,
    /// Units that were not zero.
    pub(crate) hits: u64,
    /// The one value that units have where they are not zero.
    pub(crate) one_value: Option<f64>,
    /// Whether units can be negative, so that what holds for values from zero up does not.
    pub(crate) signed: bool,
    /// Whether the estimator is biased by design.
    pub(crate) biased: bool,
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

impl Evidence {
    /// The same with `estimates` of so many samples each as the independent units.
    pub(crate) fn of_replicates(self, (estimates, samples): &(Vec<f64>, f64)) -> Self {
        let hits = estimates.iter().filter(|estimate| **estimate != 0.0).count() as u64;
        let units = Moments::of(estimates);
        Self { exact_variance: None, units, samples_per_unit: *samples, hits, one_value: None, ..self }
    }

    fn expected(&self) -> f64 {
        self.reference.0
    }

    fn difference(&self) -> f64 {
        self.units.mean - self.expected()
    }

    /// δ, with what is not known of the reference.
    fn budget(&self) -> f64 {
        let (value, bound) = self.reference;
        bound + if value == 0.0 { ARITHMETIC } else { ARITHMETIC * value }
    }

    fn margin(&self, criteria: Criteria) -> f64 {
        if self.expected() == 0.0 { criteria.margin } else { criteria.margin * self.expected() }
    }

    fn law(&self) -> Law {
        if self.expected() == 0.0 && self.hits == 0 {
            return Law::Certain;
        }
        match self.exact_variance {
            Some(variance) => self.law_of(variance),
            None => self.measured_law(),
        }
    }

    /// The law where the variance of a unit is known.
    fn law_of(&self, variance: f64) -> Law {
        let (e, n, shown) = (self.expected(), self.units.n, self.units.variance().unwrap_or(0.0));
        if variance.max(shown).sqrt() <= self.budget() {
            return Law::Certain;
        }
        if let Some(value) = self.two_values(variance) {
            return Law::TwoValues { value, hits: self.hits, n: n as u64 };
        }
        let second = if self.signed { f64::INFINITY } else { variance + e * e };
        let hits = (self.hits as f64).max(if e == 0.0 { 0.0 } else { n * e * e / second });
        match () {
            () if hits < FEW_HITS => Law::Unknown { note: if e == 0.0 { STRAY_LIGHT } else { TOO_FEW } },
            () if shown < SHOWN * variance => Law::Bounded { variance, second, n },
            () => self.normal(variance.max(shown), f64::INFINITY),
        }
    }

    /// The value of samples that are zero or one value: E\[w²\]/E, and all that are not zero are near it. Where none is,
    /// the law of fewest hits: by Cauchy and Schwarz Pr(w ≠ 0) ≥ E²/E\[w²\].
    fn two_values(&self, variance: f64) -> Option<f64> {
        let e = self.expected();
        if self.signed {
            return None;
        }
        if e == 0.0 {
            return self.one_value.filter(|_| (self.hits as f64) < FEW_HITS);
        }
        let value = e + variance / e;
        let all_near = || self.one_value.is_some_and(|one| (one - value).abs() <= SAME * value);
        (self.hits == 0 || all_near()).then_some(value)
    }

    /// The law where the units alone must tell.
    fn measured_law(&self) -> Law {
        let shown = self.units.variance().unwrap_or(0.0);
        match () {
            () if (self.hits as f64) < FEW_HITS => Law::Unknown { note: TOO_FEW },
            () if self.samples_per_unit > 1.0 && self.units.n < FEW_REPLICATES => {
                Law::Unknown { note: TOO_FEW_REPLICATES }
            }
            () if shown.sqrt() <= self.budget() => Law::Certain,
            () if self.carriers() < FEW_HITS => Law::Unknown { note: FEW_CARRY },
            () => self.normal(shown, self.units.n - 1.0),
        }
    }

    /// Of how many units the variance comes, (Σ d²)²/Σ d⁴ of their distances d from the mean; of all, where those that are far out
    /// lie on the side on which there is an end.
    fn carriers(&self) -> f64 {
        let Moments { n, m2, m3, m4, .. } = self.units;
        if m3 > 0.0 || self.signed { m2 * m2 / m4 } else { n }
    }

    fn normal(&self, variance: f64, freedom: f64) -> Law {
        let Moments { n, m2, m3, .. } = self.units;
        let skewness = (m3 / n) / (m2 / n).powf(1.5);
        Law::Normal { sigma: (variance / n).sqrt(), skew: skewness.abs() / (6.0 * n.sqrt()), freedom }
    }

    /// The probability of a difference this far beyond ±δ by chance.
    fn p_value(&self) -> f64 {
        self.law().p_value(self.expected(), self.difference(), self.budget())
    }

    fn verdict(&self, level: f64, criteria: Criteria) -> Verdict {
        let (budget, margin, law) = (self.budget(), self.margin(criteria), self.law());
        let interval = law.interval(self.expected(), self.difference(), level);
        let biased = interval.is_some_and(|[lo, hi]| lo > budget || hi < -budget);
        let unbiased = interval.is_some_and(|[lo, hi]| lo >= -margin && hi <= margin);
        let verdict = if self.biased {
            "expected_bias"
        } else if biased {
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
            reference: self.expected(),
            difference: self.difference(),
            interval,
            level: criteria.level,
            margin: criteria.margin,
            arithmetic_budget: budget,
            detectable: law.detectable(self.expected(), budget, level),
            samples_needed: undecided.then(|| self.samples_needed(level, margin)).flatten(),
            verdict,
            note: self.note(verdict, law, margin),
        }
    }

    /// Samples after which an unbiased estimator's interval lies inside ±margin 80 times in 100, by the normal law.
    fn samples_needed(&self, level: f64, margin: f64) -> Option<f64> {
        let one = self.exact_variance.or_else(|| self.units.variance()).filter(|v| *v > 0.0)?.sqrt();
        let z = normal_quantile(0.5 * level) + normal_quantile(0.5 * (1.0 - POWER));
        Some(((z * one / margin).powi(2) * self.samples_per_unit).ceil())
    }

    fn note(&self, verdict: &str, law: Law, margin: f64) -> String {
        let by_size = if self.difference().abs() < margin { "below" } else { "beyond" };
        match (verdict, law) {
            ("expected_bias", _) => "biased by design, less the more samples are taken".into(),
            (_, Law::Unknown { note }) => note.into(),
            ("biased", _) => format!("there is a bias, {by_size} the margin"),
            ("unbiased", Law::Certain) => "nothing varies".into(),
            ("unbiased", _) => "any bias is below the margin".into(),
            (_, Law::Bounded { .. }) => HEAVY_TAIL.into(),
            _ => "the interval reaches beyond the margin: take more samples".into(),
        }
    }
}

#[cfg(test)]
mod tests;
