//! What a comparison yields: one record per receiver, with rows, verdicts and rates.
//!
//! The serialised field names are the public contract (`twoforms.compare/1`). A field without a value is `null`, and
//! the record's `why` says why, under the field's name.

use std::collections::BTreeMap;

use serde::Serialize;
use twoforms_estimator::rgb::luminance;

/// Reasons for missing values, by field name.
pub type Why = BTreeMap<&'static str, String>;

/// A colour and its luminance, in the quantity's unit (irradiance: W/m² or lm/m²).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Colour {
    /// Linear RGB.
    pub rgb: [f64; 3],
    /// 0.2126 R + 0.7152 G + 0.0722 B.
    pub luminance: f64,
}

impl From<[f64; 3]> for Colour {
    fn from(rgb: [f64; 3]) -> Self {
        Self { rgb, luminance: luminance(rgb) }
    }
}

/// All that was measured at one receiver.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReceiverResult {
    /// The receiver's name.
    pub name: String,
    /// World position in metres.
    pub position: [f64; 3],
    /// World unit normal.
    pub normal: [f64; 3],
    /// The value computed without chance; `null` where there is none.
    pub exact: Option<Exact>,
    /// The scene's own answer, where it carries one.
    pub known: Option<Known>,
    /// CPU seconds to prepare this receiver (its view), once for all rows.
    pub setup_seconds: f64,
    /// One row per strategy, sampler and sample count.
    pub rows: Vec<Row>,
    /// One verdict per strategy and sampler.
    pub verdicts: Vec<Verdict>,
    /// One fitted rate per strategy and sampler.
    pub rates: Vec<Rate>,
    /// Reasons for missing values.
    #[serde(skip_serializing_if = "Why::is_empty")]
    pub why: Why,
}

/// Irradiance (or radiance) computed without chance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Exact {
    /// The value.
    pub irradiance: Colour,
    /// Absolute bound of the luminance's error.
    pub error_bound: f64,
}

/// An answer that the scene file carries.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Known {
    /// The cited value.
    pub irradiance: Colour,
    /// Variance of one sample (RGB), by strategy name, where cited.
    pub variance: BTreeMap<String, [f64; 3]>,
    /// Where the value comes from.
    pub derivation: String,
}

/// One strategy at one sample count: R independent replicates of an N-sample estimate.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Canonical name, for example `area/uniform`.
    pub strategy: String,
    /// Canonical sampler name.
    pub sampler: String,
    /// N: samples per estimate.
    pub samples: u64,
    /// R: independent replicates.
    pub replicates: u64,
    /// Mean over all replicates.
    pub mean: Colour,
    /// The mean less the exact value, luminance; `null` where there is no exact value. All that can be said of a
    /// deterministic rule.
    pub error: Option<f64>,
    /// Sample variance (n − 1) of the R estimates' luminances: the variance of an N-sample estimate. `null` at R = 1 and for
    /// deterministic rules.
    pub variance_of_mean: Option<f64>,
    /// 95 % interval of `variance_of_mean`.
    pub variance_interval: Option<[f64; 2]>,
    /// The exact variance of an N-sample estimate, luminance.
    pub variance_exact: Option<f64>,
    /// `variance_of_mean` / `variance_exact`: near 1 where samples and theory agree.
    pub variance_ratio: Option<f64>,
    /// 95 % interval of that ratio: `variance_interval` / `variance_exact`.
    pub variance_ratio_interval: Option<[f64; 2]>,
    /// Sample variance (n − 1) of single samples' luminances over all R·N samples. `null` for a single sample.
    pub variance_of_one: Option<f64>,
    /// Chebyshev's bound against what happened.
    pub chebyshev: Option<Chebyshev>,
    /// Rays (visibility questions) per N-sample estimate.
    pub rays: f64,
    /// CPU seconds per N-sample estimate.
    pub seconds: f64,
    /// Rays of what the strategy works out once at the receiver: those of pilot samples.
    pub setup_rays: u64,
    /// CPU seconds of what it works out once at the receiver: its densities there, pilot samples, α.
    pub setup_seconds: f64,
    /// 1 / (`variance_of_mean` × seconds).
    pub efficiency: Option<f64>,
    /// Reasons for missing values.
    #[serde(skip_serializing_if = "Why::is_empty")]
    pub why: Why,
}

/// Chebyshev's bound Pr(|⟨I⟩ − I| ≥ σ_N/√δ) ≤ δ, and the share of replicates outside it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Chebyshev {
    /// δ of the bound.
    pub delta: f64,
    /// σ_N/√δ: the half-width of the band, luminance.
    pub bound: f64,
    /// Share of replicates whose estimate lies outside the band around the reference value.
    pub outside: f64,
    /// What the band is centred on: `known`, `exact` or `mean` (of the replicates).
    pub about: &'static str,
}

/// What the data say about an estimator's bias; see the documentation of the verdicts module.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// Canonical name.
    pub strategy: String,
    /// Canonical sampler name.
    pub sampler: String,
    /// E: the luminance that samples should have on average, without what the surface itself emits.
    pub reference: f64,
    /// Mean over all N minus the reference, luminance.
    pub difference: f64,
    /// Interval of the bias at the familywise level.
    pub interval: Option<[f64; 2]>,
    /// Familywise level.
    pub level: f64,
    /// Margin: the bias that still counts as none, as a share of the reference.
    pub margin: f64,
    /// δ: what binary32 arithmetic may add, absolute.
    pub arithmetic_budget: f64,
    /// The bias that would be found 80 times in 100.
    pub detectable: Option<f64>,
    /// Samples needed for a decision, where there is none yet.
    pub samples_needed: Option<f64>,
    /// `unbiased`, `biased`, `undecided` or `expected_bias`.
    pub verdict: &'static str,
    /// One sentence.
    pub note: String,
}

/// The slope of log variance against log N: −1 for independent samples.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rate {
    /// Canonical name.
    pub strategy: String,
    /// Canonical sampler name.
    pub sampler: String,
    /// Fitted slope; `null` where fewer than two rows have a positive variance.
    pub slope: Option<f64>,
    /// 95 % interval of the slope.
    pub interval: Option<[f64; 2]>,
    /// Name of the one regime whose slope lies in the interval, for example `1/N`.
    pub regime: Option<String>,
    /// Names of all regimes whose slopes lie in the interval.
    pub candidates: Vec<String>,
    /// Reasons for missing values.
    #[serde(skip_serializing_if = "Why::is_empty")]
    pub why: Why,
}
