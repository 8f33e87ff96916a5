//! What exact light comes to.
//!
//! The serialised field names are the public contract (`twoforms.exact/1`).

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};
use twoforms_estimator::rgb::luminance;
use twoforms_estimator::strategy::{Known, Strategy, Team};
use twoforms_exact::{Error, Sight, Value};

use crate::place::Place;
use crate::result::Why;
use crate::sweep::{Parameter, Spacing};

/// What is known at one receiver without chance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExactResult {
    /// The receiver's name.
    pub name: String,
    /// World position in metres.
    pub position: [f64; 3],
    /// World unit normal.
    pub normal: [f64; 3],
    /// The light there.
    #[serde(flatten)]
    pub light: ExactLight,
    /// α of teams with optimal weights, RGB, where strategies use them and they can be had.
    #[serde(skip)]
    pub(crate) alpha: Vec<(Team, Vec<[f64; 3]>)>,
    /// The radiance with V = 1, RGB, of a surface with a highlight.
    #[serde(skip)]
    pub(crate) unoccluded: Option<[f64; 3]>,
    /// The light along a sweep, where one was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sweep: Option<Swept>,
}

/// Exact light: what arrives, and how much each strategy's samples of it vary.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExactLight {
    /// The irradiance (or radiance); `null` where there is none.
    pub irradiance: Option<Bounded>,
    /// The same with V = 1: what the lights would give if nothing stood before them.
    pub irradiance_unoccluded: Option<Bounded>,
    /// Each strategy's variance.
    #[serde(serialize_with = "by_name")]
    pub strategies: Vec<ExactVariance>,
    /// Reasons for missing values.
    #[serde(skip_serializing_if = "Why::is_empty")]
    pub why: Why,
}

/// A value with a bound of its error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bounded {
    /// Linear RGB; a variance is that of each channel.
    pub rgb: [f64; 3],
    /// Luminance; a variance is that of the samples' luminance.
    pub luminance: f64,
    /// Absolute bound of the luminance's error.
    pub error_bound: f64,
}

/// The exact variance of one strategy.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExactVariance {
    /// Canonical name.
    #[serde(skip)]
    pub strategy: String,
    /// The variance of one sample; `null` where it can't be had.
    pub variance_of_one: Option<Bounded>,
    /// Why it can't.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

fn by_name<S: Serializer>(strategies: &[ExactVariance], serializer: S) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(Some(strategies.len()))?;
    for variance in strategies {
        map.serialize_entry(&variance.strategy, variance)?;
    }
    map.end()
}

impl From<Value> for Bounded {
    fn from(Value { rgb, luminance, error_bound }: Value) -> Self {
        Self { rgb, luminance, error_bound }
    }
}

/// What one receiver meets along a sweep.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Swept {
    /// What moves.
    pub parameter: Parameter,
    /// Its first value.
    pub from: f64,
    /// Its last value.
    pub to: f64,
    /// How steps are spaced.
    pub scale: Spacing,
    /// The values in order, and the light at each.
    pub steps: Vec<Step>,
    /// Where two variances are equal, in the order of the sweep.
    pub crossings: Vec<Crossing>,
}

/// One value of the parameter, and the light there.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// The value.
    pub at: f64,
    /// The light.
    #[serde(flatten)]
    pub light: ExactLight,
}

/// A value of the parameter at which two variances (of the luminance) are equal, one below the other on either side.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Crossing {
    /// The two strategies' canonical names.
    pub strategies: [String; 2],
    /// The value.
    pub at: f64,
    /// How far the error bounds of the two variances may move it.
    pub error_bound: f64,
}

impl ExactResult {
    /// What is known beforehand for strategies that use it, as far as those that were asked about do.
    pub fn known(&self) -> Known {
        Known { alpha: self.alpha.clone(), unoccluded: self.unoccluded, ..Known::default() }
    }

    /// What is known at a place.
    pub(crate) fn new(place: &Place, light: ExactLight, sweep: Option<Swept>) -> Self {
        let (name, position, normal) = (place.name.clone(), place.position.to_array(), place.normal.to_array());
        Self { name, position, normal, light, alpha: Vec::new(), unoccluded: None, sweep }
    }
}

impl ExactLight {
    /// The light of what a place sees, or why there is none.
    pub(crate) fn of(place: &Place, sight: Result<Sight, Error>, strategies: &[Strategy]) -> Self {
        let mut light = Self { irradiance: None, irradiance_unoccluded: None, strategies: Vec::new(), why: Why::new() };
        match sight {
            Err(reason) => {
                light.why.insert("irradiance", reason.to_string());
            }
            Ok(sight) => {
                light.irradiance = Some(seen(sight.irradiance(), place.emission()));
                light.irradiance_unoccluded = Some(seen(sight.irradiance_unoccluded(), place.emission()));
                light.strategies = strategies.iter().map(|&strategy| variance(&sight, strategy)).collect();
            }
        }
        light
    }
}

/// What arrives and is reflected, plus what the surface itself emits.
fn seen(arriving: Value, emission: [f64; 3]) -> Bounded {
    let rgb: [f64; 3] = std::array::from_fn(|c| arriving.rgb[c] + emission[c]);
    let emitted = luminance(emission);
    let rounding = if emitted == 0.0 { 0.0 } else { f64::EPSILON * (arriving.luminance + emitted) };
    Bounded { rgb, luminance: arriving.luminance + emitted, error_bound: arriving.error_bound + rounding }
}

fn variance(sight: &Sight, strategy: Strategy) -> ExactVariance {
    let (variance_of_one, why) = match sight.variance(strategy) {
        Ok(value) => (Some(value.into()), None),
        Err(reason) => (None, Some(reason.to_string())),
    };
    ExactVariance { strategy: strategy.to_string(), variance_of_one, why }
}
