//! The cells of a table: one line per row of a result.

use twoforms_comparison::result::{ReceiverResult, Row};

use crate::layout::elided;
use crate::number::{NONE, count, duration, percent, rounded, significant};

/// Columns of a row: strategy, sampler and figures.
pub(crate) const HEADER: [&str; 11] =
    ["strategy", "sampler", "N", "mean", "error", "variance", "exact", "ratio", "outside", "rays", "time"];

/// The rows' cells; a line that goes on with the strategy and sampler of the line above leaves them out. Names longer than
/// `longest` are shortened.
pub(crate) fn named_once(receiver: &ReceiverResult, rows: &[&Row], longest: usize) -> Vec<Vec<String>> {
    let above = std::iter::once(None).chain(rows.iter().map(Some));
    let goes_on = |row: &Row, above: &Row| row.strategy == above.strategy && row.sampler == above.sampler;
    let cells = |(row, above): (&&Row, Option<&&Row>)| {
        let name = match above {
            Some(above) if goes_on(row, above) => [String::new(), String::new()],
            _ => [elided(&row.strategy, longest), row.sampler.clone()],
        };
        name.into_iter().chain(figures(receiver, row)).collect()
    };
    rows.iter().zip(above).map(cells).collect()
}

/// The figures of a row, from N on.
fn figures(receiver: &ReceiverResult, row: &Row) -> [String; 9] {
    let or_none = |figure: Option<String>| figure.unwrap_or_else(|| NONE.to_owned());
    [
        row.samples.to_string(),
        significant(row.mean.luminance),
        or_none(row.error.filter(|_| row.replicates == 1).map(significant)),
        or_none(row.variance_of_mean.map(significant)),
        or_none(row.variance_exact.or_else(|| known_variance(receiver, row)).map(significant)),
        or_none(ratio(row).or_else(|| longer_arm(row).map(|share| format!("± {}", percent(share))))),
        or_none(row.chebyshev.map(|chebyshev| against(chebyshev.outside, chebyshev.delta))),
        count(row.rays),
        duration(row.seconds),
    ]
}

/// Measured over exact variance, with its interval where there is one: `1.02 [0.94, 1.11]`.
fn ratio(row: &Row) -> Option<String> {
    let ratio = rounded(row.variance_ratio?, 3);
    let interval = row.variance_ratio_interval.map(|ends| ends.map(|end| rounded(end, 3)));
    Some(interval.map_or(ratio.clone(), |[lo, hi]| format!("{ratio} [{lo}, {hi}]")))
}

/// The longer arm of the variance's interval, as a share of the variance.
fn longer_arm(row: &Row) -> Option<f64> {
    let (variance, [lo, hi]) = (row.variance_of_mean?, row.variance_interval?);
    (variance > 0.0).then(|| (hi - variance).max(variance - lo) / variance)
}

/// The variance of an N-sample estimate that the scene's answer implies for independent samples: σ²/N.
///
/// The answer gives σ² per channel, from which luminance follows where all lights have one colour: then all channels,
/// and luminance, share one relative variance σ²/E².
fn known_variance(receiver: &ReceiverResult, row: &Row) -> Option<f64> {
    let known = receiver.known.as_ref().filter(|_| row.sampler == "independent")?;
    let variance = known.variance.get(&row.strategy)?;
    let lit = variance.iter().zip(known.irradiance.rgb).filter(|(_, irradiance)| *irradiance != 0.0);
    let relative: Vec<f64> = lit.map(|(variance, irradiance)| variance / irradiance.powi(2)).collect();
    let first = *relative.first()?;
    let is_one = relative.iter().all(|other| (other - first).abs() <= 1e-6 * first);
    is_one.then(|| first * known.irradiance.luminance.powi(2) / row.samples as f64)
}

/// A share, and the bound where it is not kept: `1.2 %`, `12 % > 10 %`.
fn against(share: f64, bound: f64) -> String {
    if share <= bound { percent(share) } else { format!("{} > {}", percent(share), percent(bound)) }
}
