//! What a file of experiments says, key by key. A reproduction and a user's own experiment are the same file.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use toml::Spanned;
use twoforms_comparison::request::{Asked, Colour, Grid, Viewpoint};

use crate::either::{At, CameraName, Density};
use crate::limits;

/// A file of experiments.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct File {
    /// What it shows, in a line.
    pub title: Option<String>,
    /// Where what is printed beside our numbers comes from.
    pub source: Option<String>,
    /// How the values that are derived here come about.
    pub derivation: Option<String>,
    /// Seed of all that is random, 0 unless said.
    #[serde(default, deserialize_with = "limits::seed")]
    pub seed: u64,
    /// The relative change of a result that its rows must notice, 0.05 unless said.
    #[serde(default = "detects", deserialize_with = "limits::above_zero_always")]
    pub detects: f64,
    /// The experiments in order.
    #[serde(default)]
    pub experiment: Vec<Spanned<Experiment>>,
}

fn detects() -> f64 {
    0.05
}

/// One experiment: what is measured, how often, and what is expected. Its subject is a discrete variable (`values`), an
/// integral (`integrand`), or the light in a scene (`scene`).
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Experiment {
    /// What it is about.
    pub title: Option<String>,
    /// The formula that it tries.
    pub formula: Option<String>,
    /// The file in which that formula is code.
    pub code: Option<String>,

    /// Equally likely values of a discrete variable.
    pub values: Option<Vec<f64>>,

    /// f, in the names of the axes.
    pub integrand: Option<Spanned<String>>,
    /// The names of the axes; x, y, z unless said.
    pub axes: Option<Vec<String>>,
    /// [a, b] along each axis; [0, 1] unless said.
    #[serde(deserialize_with = "limits::domain")]
    pub domain: Option<Vec<[f64; 2]>>,
    /// p along each axis; uniform unless said.
    pub density: Option<Vec<Spanned<Density>>>,
    /// Numbers that have names in f and p.
    pub constants: BTreeMap<String, f64>,
    /// Sums f(x₁) + … + f(x_d) over so many axes, one after the other: f is a function of x.
    pub dimensions: Option<usize>,

    /// A glTF scene, beside this file or one of the program's own.
    pub scene: Option<Spanned<String>>,
    /// Receivers by name; all that the scene has unless said.
    pub receivers: Option<Vec<Spanned<String>>>,
    /// Receivers by place: x, y, z and a normal of any length, or `@FILE.csv` with one in each line.
    pub at: Option<Vec<Spanned<At>>>,
    /// What the centres of these pixels see.
    #[serde(deserialize_with = "limits::pixels")]
    pub pixels: Option<Spanned<Vec<[u32; 2]>>>,
    /// What the centres of so many cells across and down the camera's image see.
    pub grid: Option<Spanned<Grid>>,
    /// What is asked of the light; irradiance unless said.
    pub quantity: Option<Spanned<Asked>>,
    /// ρ for radiance where no surface lies under a receiver.
    pub albedo: Option<Spanned<Colour>>,
    /// Radiance without highlights.
    pub lambert: Option<Spanned<bool>>,
    /// Who looks: a camera of the scene by name or number, or `auto`.
    pub camera: Option<Spanned<CameraName>>,
    /// Who looks, by numbers: eye, target, and a vertical field of view in degrees.
    pub view: Option<Spanned<Viewpoint>>,
    /// Width of the image in pixels.
    #[serde(deserialize_with = "limits::side")]
    pub width: Option<Spanned<u32>>,
    /// Height of the image in pixels.
    #[serde(deserialize_with = "limits::side")]
    pub height: Option<Spanned<u32>>,
    /// Strategies to compare.
    #[serde(deserialize_with = "limits::names")]
    pub strategies: Option<Vec<Spanned<String>>>,
    /// What moves, as `PARAM=FROM:TO[:log]:STEPS`.
    pub sweep: Option<Spanned<String>>,
    /// Nested samples of light that was reflected once: [outer, inner].
    #[serde(deserialize_with = "limits::nested")]
    pub nested: Option<[u32; 2]>,
    /// The chance of any false alarm about a bias in `compare`.
    #[serde(deserialize_with = "limits::share")]
    pub level: Option<f64>,
    /// The bias that still counts as none, as a share of the exact value.
    #[serde(deserialize_with = "limits::share")]
    pub margin: Option<f64>,
    /// `compare` ends with exit code 3 where an estimator is biased.
    pub check: bool,

    /// Samplers; independent unless said.
    #[serde(deserialize_with = "limits::names")]
    pub samplers: Option<Vec<Spanned<String>>>,
    /// N: the sample counts.
    #[serde(deserialize_with = "limits::counts")]
    pub samples: Option<Vec<u32>>,
    /// R: how often each is repeated.
    #[serde(deserialize_with = "limits::replicates")]
    pub replicates: Option<u32>,
    /// Whether rows are measured by chance too, as they are unless said.
    pub chance: Option<bool>,
    /// The relative change that rows must notice, where it differs from the file's.
    #[serde(deserialize_with = "limits::above_zero")]
    pub detects: Option<f64>,
    /// What is drawn.
    pub figure: Option<Figure>,
    /// What is expected, in order.
    pub row: Vec<Expected>,
}

/// One row: a quantity, what is known of it from elsewhere, and what it depends on.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Expected {
    /// What is asked.
    pub quantity: Spanned<Quantity>,
    /// The number as the source prints it: its digits say how far it is rounded.
    pub published: Option<Spanned<String>>,
    /// The source cuts digits off instead of rounding.
    #[serde(default)]
    pub truncated: bool,
    /// The number as it follows from the derivation: a formula, or as many digits as are known.
    pub derived: Option<Spanned<String>>,
    /// How far the derivation says its number may be off.
    #[serde(default, deserialize_with = "limits::above_zero")]
    pub derived_error: Option<f64>,
    /// What the row says in words.
    pub note: Option<String>,
    /// N.
    #[serde(default, deserialize_with = "limits::count")]
    pub samples: Option<u32>,
    /// δ.
    #[serde(default, deserialize_with = "limits::share")]
    pub delta: Option<f64>,
    /// [a', b'].
    #[serde(default, deserialize_with = "limits::interval")]
    pub interval: Option<[f64; 2]>,
    /// Samples that are given.
    pub points: Option<Vec<f64>>,
    /// The rule.
    pub rule: Option<RuleName>,
    /// m: nodes along each axis; or the most evaluations in all, where dimensions grow.
    #[serde(default, deserialize_with = "limits::count")]
    pub nodes: Option<u32>,
    /// Receiver, by name; the experiment's only one unless said.
    pub receiver: Option<Spanned<String>>,
    /// Strategy, by name.
    pub strategy: Option<Spanned<String>>,
    /// The strategy that the first is held against.
    pub to: Option<Spanned<String>>,
    /// Sampler, by name.
    pub sampler: Option<Spanned<String>>,
    /// Which of several, from 1.
    #[serde(default, deserialize_with = "limits::count")]
    pub which: Option<u32>,
    /// The integral whose variance crosses this one's.
    pub against: Option<Against>,
    /// What moves until they do.
    pub parameter: Option<Parameter>,
    /// How far the source says its number may be off.
    #[serde(default, deserialize_with = "limits::above_zero")]
    pub published_error: Option<f64>,
    /// The relative change that the row must notice, where it differs from the experiment's.
    #[serde(default, deserialize_with = "limits::above_zero")]
    pub detects: Option<f64>,
}

/// Another integral over the same axes.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Against {
    /// f.
    pub integrand: Spanned<String>,
    /// p along each axis; uniform unless said.
    pub density: Option<Vec<Spanned<Density>>>,
}

/// A constant that runs through a range.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its first value.
    pub from: f64,
    /// Its last value.
    pub to: f64,
}

/// What can be asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// `E[w]`: expected value of the variable, the integral.
    Mean,
    /// `σ² = E[(w − E[w])²]` of one sample. In a scene, of a strategy at a receiver.
    Variance,
    /// σ.
    Deviation,
    /// `E[w²]`.
    SecondMoment,
    /// `E[w²] − E[w]²`: the variance by the identity.
    Identity,
    /// σ²/N of the mean of N samples.
    VarianceOfMean,
    /// σ/√N.
    DeviationOfMean,
    /// Pr(a' <= w <= b').
    Probability,
    /// F(b') − F(a') of the sampled point along the first axis.
    Drawn,
    /// The mean of the primary estimates of given points.
    RunningMean,
    /// Share of N-sample means farther than σ_N/√δ from `E[w]`; δ bounds it.
    Outside,
    /// Exponent of N in the root mean square error of means.
    ErrorRate,
    /// The deterministic rule's value.
    Rule,
    /// The dimension from which on independent samples have the smaller error.
    CrossingDimension,
    /// Irradiance at a receiver.
    Irradiance,
    /// Radiance from a receiver's surface.
    Radiance,
    /// σ² of a strategy over σ² of another.
    Ratio,
    /// Exponent of N in a strategy's variance.
    Rate,
    /// The parameter at which two strategies, or two integrals, have equal variance.
    Crossing,
    /// How often two strategies have equal variance along a sweep.
    Crossings,
    /// ∫ cosθ_y/r² dA over the targets that face a receiver: their solid angle.
    SolidAngle,
    /// L_e toward the eye.
    Emitted,
    /// Light that was reflected once, on its way from the lights to a receiver: one integral.
    Direct,
    /// Light that was reflected twice: two nested integrals.
    Nested,
}

/// A deterministic rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RuleName {
    /// The middle of each cell.
    Midpoint,
    /// Gauss and Legendre's nodes.
    Gauss,
}

/// What can be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Figure {
    /// Means of the first 1, 2, 3, … samples of some streams.
    RunningMeans,
    /// Root mean square error against N.
    Errors,
    /// Error of the rule and of Monte Carlo against the dimension.
    Dimensions,
    /// Variance against N, a line for each strategy and sampler.
    Variances,
    /// Exact variances along the sweep.
    Sweep,
}
