//! Strategies in the order of their variance, pooled over receivers.
//!
//! Compared is the variance of the estimate at the largest N that all strategies share, by its geometric mean over
//! the receivers, `exp(1/K Σ ln σ²_k)`. So each receiver counts the same, however bright it is, and a ratio of two
//! strategies is the geometric mean of its K ratios. The uncertainty is carried on the log scale, from the rows' 95 %
//! intervals `[lo_k, hi_k]` of half-width `s_k = ln(hi_k/lo_k)/2`, receivers and strategies taken as independent:
//! `s = √(Σ s_k²)/K` for one strategy, `√(s_a² + s_b²)` for a ratio.
//!
//! A variance of zero has no logarithm, and one that is all rounding has one that says nothing. Receivers that no strategy
//! finds any light at are left out. A strategy that is constant somewhere (right without chance, but for the rounding of
//! binary32) is set apart, and so is one whose samples all missed the lights; the others are pooled over the receivers
//! where all of them have a variance.

use twoforms_comparison::result::{ReceiverResult, Row};

/// All strategies of a comparison in order.
pub(crate) struct Ranking<'a> {
    /// N of the compared estimates.
    pub samples: u64,
    /// Names of the K receivers pooled over.
    pub receivers: Vec<&'a str>,
    /// Receivers in the comparison.
    pub of: usize,
    /// Those with a variance, lowest first.
    pub ranked: Vec<Pooled>,
    /// Those with light and no variance at some receiver, and at how many.
    pub constant: Vec<(String, usize)>,
    /// Those whose samples never met a light.
    pub missed: Vec<String>,
}

/// One strategy, pooled over K receivers.
pub(crate) struct Pooled {
    /// Strategy, with its sampler where the comparison has several.
    pub name: String,
    /// `1/K Σ ln σ²_k`.
    pub log_variance: f64,
    /// Half of the 95 % interval of `log_variance`; none where a row has no interval.
    pub half_width: Option<f64>,
    /// Rays of an estimate, mean over the receivers.
    pub rays: f64,
    /// CPU seconds of an estimate, mean over the receivers.
    pub seconds: f64,
}

/// Why there is no ranking.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unranked {
    /// No N at which every strategy has a row at every receiver.
    Counts,
    /// All means are zero.
    Dark,
    /// No receiver at which all strategies show a variance.
    Constant,
}

/// A strategy's rows at the common N, one per receiver.
struct Candidate<'a> {
    name: String,
    rows: Vec<&'a Row>,
}

/// What a row's samples say about its strategy.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Standing {
    /// No sample met a light.
    Missed,
    /// All estimates are equal but for rounding, and not zero.
    Constant,
    /// The estimates differ.
    Spread,
    /// A single replicate.
    Unknown,
}

impl<'a> Ranking<'a> {
    /// Ranks what `receivers` measured.
    pub fn new(receivers: &'a [ReceiverResult]) -> Result<Self, Unranked> {
        let samples = largest_common_count(receivers).ok_or(Unranked::Counts)?;
        let candidates = candidates(receivers, samples);
        let is_lit = |r: &usize| candidates.iter().any(|candidate| standing(candidate.rows[*r]) != Standing::Missed);
        let lit: Vec<usize> = (0..receivers.len()).filter(is_lit).collect();
        if lit.is_empty() {
            return Err(Unranked::Dark);
        }
        let count = |candidate: &Candidate, standing_so: Standing| {
            lit.iter().filter(|&&r| standing(candidate.rows[r]) == standing_so).count()
        };
        let (constant, others): (Vec<_>, Vec<_>) =
            candidates.into_iter().partition(|candidate| count(candidate, Standing::Constant) > 0);
        let constant = constant.into_iter().map(|one| (one.name.clone(), count(&one, Standing::Constant))).collect();
        let (missed, contenders): (Vec<_>, Vec<_>) =
            others.into_iter().partition(|candidate| count(candidate, Standing::Missed) == lit.len());
        let missed = missed.into_iter().map(|candidate| candidate.name).collect();
        let has_spread =
            |r: &usize| contenders.iter().all(|candidate| standing(candidate.rows[*r]) == Standing::Spread);
        let pooled: Vec<usize> = lit.into_iter().filter(has_spread).collect();
        if pooled.is_empty() {
            return Err(Unranked::Constant);
        }
        let mut ranked: Vec<Pooled> = contenders.iter().map(|candidate| Pooled::new(candidate, &pooled)).collect();
        ranked.sort_by(|a, b| a.log_variance.total_cmp(&b.log_variance));
        let names = pooled.iter().map(|&r| receivers[r].name.as_str()).collect();
        Ok(Self { samples, receivers: names, of: receivers.len(), ranked, constant, missed })
    }

    /// How many of `ranked`, from the first, are not told apart from the lowest.
    pub fn tied(&self) -> usize {
        self.ranked.iter().take_while(|pooled| self.ranked[0].ties_with(pooled)).count()
    }
}

impl Pooled {
    fn new(candidate: &Candidate, receivers: &[usize]) -> Self {
        let mean = |figure: &dyn Fn(&Row) -> f64| {
            receivers.iter().map(|&r| figure(candidate.rows[r])).sum::<f64>() / receivers.len() as f64
        };
        let squares: Option<f64> = receivers.iter().map(|&r| Some(log_half_width(candidate.rows[r])?.powi(2))).sum();
        Self {
            name: candidate.name.clone(),
            log_variance: mean(&|row| row.variance_of_mean.map_or(0.0, f64::ln)),
            half_width: squares.map(|sum| sum.sqrt() / receivers.len() as f64),
            rays: mean(&|row| row.rays),
            seconds: mean(&|row| row.seconds),
        }
    }

    /// ln of how many times lower this variance is than another's, and half of its 95 % interval.
    pub fn log_factor(&self, than: &Self) -> (f64, Option<f64>) {
        let half_width = self.half_width.zip(than.half_width).map(|(a, b)| a.hypot(b));
        (than.log_variance - self.log_variance, half_width)
    }

    /// Whether the interval of the ratio holds 1; without an interval, whether the ratio is 1 to six digits.
    fn ties_with(&self, other: &Self) -> bool {
        let (log_factor, half_width) = self.log_factor(other);
        log_factor.abs() <= half_width.unwrap_or(1e-6).max(1e-6)
    }
}

/// The largest N at which every strategy of the comparison has a row at every receiver.
fn largest_common_count(receivers: &[ReceiverResult]) -> Option<u64> {
    let estimators = estimators(receivers);
    let has_all = |n: &u64| {
        receivers.iter().all(|receiver| estimators.iter().all(|estimator| find(receiver, *estimator, *n).is_some()))
    };
    receivers.first()?.rows.iter().map(|row| row.samples).filter(has_all).max()
}

/// The distinct pairs of strategy and sampler, in order of appearance.
pub(crate) fn estimators(receivers: &[ReceiverResult]) -> Vec<(&str, &str)> {
    let mut found = Vec::new();
    for row in receivers.iter().flat_map(|receiver| &receiver.rows) {
        let estimator = (row.strategy.as_str(), row.sampler.as_str());
        if !found.contains(&estimator) {
            found.push(estimator);
        }
    }
    found
}

/// A strategy's name, with its sampler where the comparison has several.
pub(crate) fn full_name(estimators: &[(&str, &str)], (strategy, sampler): (&str, &str)) -> String {
    let one_sampler = estimators.iter().all(|(_, other)| *other == sampler);
    if one_sampler { strategy.to_owned() } else { format!("{strategy} ({sampler})") }
}

fn candidates(receivers: &[ReceiverResult], samples: u64) -> Vec<Candidate<'_>> {
    let estimators = estimators(receivers);
    let rows = |estimator| receivers.iter().filter_map(move |receiver| find(receiver, estimator, samples)).collect();
    let candidate = |&estimator: &_| Candidate { name: full_name(&estimators, estimator), rows: rows(estimator) };
    estimators.iter().map(candidate).collect()
}

fn find<'a>(receiver: &'a ReceiverResult, (strategy, sampler): (&str, &str), samples: u64) -> Option<&'a Row> {
    receiver.rows.iter().find(|row| row.samples == samples && row.strategy == strategy && row.sampler == sampler)
}

/// Standard deviation of one sample, as a share of its mean, that rounding to binary32 can make.
const ROUNDING: f64 = 1e-6;

fn standing(row: &Row) -> Standing {
    let mean = row.mean.luminance;
    match row.variance_of_mean {
        _ if mean == 0.0 => Standing::Missed,
        Some(variance) if variance * row.samples as f64 <= (ROUNDING * mean).powi(2) => Standing::Constant,
        Some(_) => Standing::Spread,
        None => Standing::Unknown,
    }
}

/// `s = ln(hi/lo)/2` of the 95 % interval of a row's variance.
fn log_half_width(row: &Row) -> Option<f64> {
    let [lo, hi] = row.variance_interval?;
    (lo > 0.0).then(|| (hi / lo).ln() / 2.0)
}
