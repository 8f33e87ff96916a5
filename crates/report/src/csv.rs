//! Tidy CSV for notebooks: one line per receiver, strategy, sampler and sample count.
//!
//! UTF-8, a header always, `\n` at the end of lines. Numbers carry the shortest digits that read back to the same
//! bits. `NaN` means "no value": a document holds no other NaN. The columns:
//!
//! | column | meaning |
//! |---|---|
//! | `receiver` | name |
//! | `x`, `y`, `z`, `n_x`, `n_y`, `n_z` | position in metres and unit normal |
//! | `strategy`, `sampler`, `samples`, `replicates` | what was run: N samples, R replicates |
//! | `mean_r`, `mean_g`, `mean_b`, `mean_luminance` | mean over the replicates |
//! | `error` | mean less the exact value, luminance |
//! | `variance_of_mean`, `variance_lo`, `variance_hi` | variance of an N-sample estimate, its 95 % interval; luminance² |
//! | `variance_exact` | the exact variance of an N-sample estimate |
//! | `variance_ratio`, `variance_ratio_lo`, `variance_ratio_hi` | `variance_of_mean` / `variance_exact`, its 95 % interval |
//! | `variance_of_one` | variance of one sample |
//! | `chebyshev_delta`, `chebyshev_outside` | δ, and the share of replicates outside σ/√δ |
//! | `rays`, `seconds` | per N-sample estimate; CPU time |
//! | `efficiency` | 1 / (`variance_of_mean` × `seconds`) |
//! | `irradiance_known`, `irradiance_exact` | the scene's answer and the exact value, luminance |
//! | `setup_seconds` | CPU time to prepare the receiver, once for all its lines |
//! | `strategy_setup_rays`, `strategy_setup_seconds` | what the strategy works out at the receiver, once for all its replicates |

use std::io::{self, Write};

use ::csv::Writer;
use twoforms_comparison::result::{ReceiverResult, Row};

use crate::document::Document;
use crate::error::ReportError;

/// The header.
pub const COLUMNS: [&str; 34] = [
    "receiver",
    "x",
    "y",
    "z",
    "n_x",
    "n_y",
    "n_z",
    "strategy",
    "sampler",
    "samples",
    "replicates",
    "mean_r",
    "mean_g",
    "mean_b",
    "mean_luminance",
    "error",
    "variance_of_mean",
    "variance_lo",
    "variance_hi",
    "variance_exact",
    "variance_ratio",
    "variance_ratio_lo",
    "variance_ratio_hi",
    "variance_of_one",
    "chebyshev_delta",
    "chebyshev_outside",
    "rays",
    "seconds",
    "efficiency",
    "irradiance_known",
    "irradiance_exact",
    "setup_seconds",
    "strategy_setup_rays",
    "strategy_setup_seconds",
];

/// Writes `document` as CSV.
///
/// # Errors
/// [`ReportError::Stream`] where `out` takes no more.
pub fn write(document: &Document, out: impl Write) -> Result<(), ReportError> {
    let mut csv = Writer::from_writer(out);
    csv.write_record(COLUMNS).map_err(io_error)?;
    for receiver in document.receivers() {
        for row in &receiver.rows {
            csv.write_record(record(receiver, row)).map_err(io_error)?;
        }
    }
    Ok(csv.flush()?)
}

/// The operating system's error, with its kind.
fn io_error(error: ::csv::Error) -> io::Error {
    match error.into_kind() {
        ::csv::ErrorKind::Io(cause) => cause,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// The cells of one line, in the order of [`COLUMNS`].
fn record(receiver: &ReceiverResult, row: &Row) -> Vec<String> {
    let mut cells = vec![receiver.name.clone()];
    cells.extend(receiver.position.into_iter().chain(receiver.normal).map(number));
    cells.extend([row.strategy.clone(), row.sampler.clone(), row.samples.to_string(), row.replicates.to_string()]);
    cells.extend(row.mean.rgb.into_iter().map(number));
    cells.extend(figures(receiver, row).into_iter().map(number));
    cells
}

/// The numbers from `mean_luminance` on; NaN where there is no value.
fn figures(receiver: &ReceiverResult, row: &Row) -> [f64; 20] {
    let or_nan = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let [variance_lo, variance_hi] = row.variance_interval.unwrap_or([f64::NAN; 2]);
    let [ratio_lo, ratio_hi] = row.variance_ratio_interval.unwrap_or([f64::NAN; 2]);
    [
        row.mean.luminance,
        or_nan(row.error),
        or_nan(row.variance_of_mean),
        variance_lo,
        variance_hi,
        or_nan(row.variance_exact),
        or_nan(row.variance_ratio),
        ratio_lo,
        ratio_hi,
        or_nan(row.variance_of_one),
        or_nan(row.chebyshev.map(|chebyshev| chebyshev.delta)),
        or_nan(row.chebyshev.map(|chebyshev| chebyshev.outside)),
        row.rays,
        row.seconds,
        or_nan(row.efficiency),
        or_nan(receiver.known.as_ref().map(|known| known.irradiance.luminance)),
        or_nan(receiver.exact.map(|exact| exact.irradiance.luminance)),
        receiver.setup_seconds,
        row.setup_rays as f64,
        row.setup_seconds,
    ]
}

/// Shortest digits that read back to the same bits.
fn number(value: f64) -> String {
    format!("{value:?}")
}
