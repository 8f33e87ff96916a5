//! Rates of convergence, one per strategy over all receivers.

use std::collections::BTreeMap;

use twoforms_comparison::result::{Rate, ReceiverResult};

use crate::number::NONE;
use crate::ranking::{estimators, full_name};

/// Header of the table of rates.
pub(crate) const HEADER: [&str; 4] = ["strategy", "slope", "95 % interval", "regime"];

/// Cells of the table of rates: strategy, slope, interval, regimes; nothing where no rate was fitted at all.
///
/// The slope is the mean over the K receivers that have one, and its interval has half the width `√(Σ s_k²)/K`, `s_k`
/// being half the width of the receiver's own interval: receivers are independent. The regimes are counted.
pub(crate) fn rows(receivers: &[ReceiverResult]) -> Vec<[String; 4]> {
    let estimators = estimators(receivers);
    let of = |&(strategy, sampler): &(&str, &str)| -> Vec<&Rate> {
        let rates = receivers.iter().flat_map(|receiver| &receiver.rates);
        rates.filter(|rate| rate.strategy == strategy && rate.sampler == sampler).collect()
    };
    let rated = estimators.iter().map(|estimator| (estimator, of(estimator)));
    let rated: Vec<_> = rated.filter(|(_, rates)| !rates.is_empty()).collect();
    if !rated.iter().any(|(_, rates)| rates.iter().any(|rate| rate.slope.is_some())) {
        return Vec::new();
    }
    rated.into_iter().map(|(estimator, rates)| row(full_name(&estimators, *estimator), &rates)).collect()
}

fn row(name: String, rates: &[&Rate]) -> [String; 4] {
    let slopes: Vec<f64> = rates.iter().filter_map(|rate| rate.slope).collect();
    if slopes.is_empty() {
        return [name, NONE.into(), NONE.into(), regimes(rates)];
    }
    let slope = slopes.iter().sum::<f64>() / slopes.len() as f64;
    let interval = half_width(rates).map_or(NONE.into(), |half| format!("[{:.3}, {:.3}]", slope - half, slope + half));
    [name, format!("{slope:.3}"), interval, regimes(rates)]
}

/// `√(Σ s_k²)/K` over the rates with a slope; none where one of them has no interval.
fn half_width(rates: &[&Rate]) -> Option<f64> {
    let fitted: Vec<_> = rates.iter().filter(|rate| rate.slope.is_some()).collect();
    let squares: Option<f64> = fitted.iter().map(|rate| rate.interval.map(|[lo, hi]| ((hi - lo) / 2.0).powi(2))).sum();
    squares.map(|sum| sum.sqrt() / fitted.len() as f64)
}

/// `1/N`, `1/N^1.5 or 1/N^2` where that is undecided; counted where there are several receivers: `1/N at 8 of 9 receivers`.
fn regimes(rates: &[&Rate]) -> String {
    let mut counts = BTreeMap::new();
    for candidates in rates.iter().map(|rate| rate.candidates.join(" or ")).filter(|names| !names.is_empty()) {
        *counts.entry(candidates).or_insert(0) += 1;
    }
    let named = |(regime, count): (String, i32)| match rates.len() {
        1 => regime,
        all => format!("{regime} at {count} of {all} receivers"),
    };
    let named: Vec<String> = counts.into_iter().map(named).collect();
    if named.is_empty() { NONE.into() } else { named.join(", ") }
}
