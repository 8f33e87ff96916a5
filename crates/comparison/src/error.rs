//! Why a run stops.

use twoforms_estimator::estimate::NotFinite;
use twoforms_estimator::strategy::Strategy;

/// Why a comparison or an image stops.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ComparisonError {
    /// A strategy cannot be sampled.
    #[error("{0}")]
    Impossible(String),
    /// A sample of a comparison is not finite.
    #[error(transparent)]
    Broken(#[from] Broken),
    /// A sample of an image is not finite.
    #[error(transparent)]
    BrokenPixel(#[from] BrokenPixel),
}

/// A sample that came out infinite or not a number, and where: the run stops there.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "{strategy} at receiver \"{receiver}\" (N = {samples}, replicate {replicate}): {source}; please report this with the scene"
)]
pub struct Broken {
    /// The receiver.
    pub receiver: String,
    /// The strategy.
    pub strategy: Strategy,
    /// N.
    pub samples: u32,
    /// Which replicate.
    pub replicate: u32,
    /// The sample.
    pub source: NotFinite,
}

/// A sample of an image that came out infinite or not a number.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{strategy} at pixel {x},{y}, camera sample {sample}: {source}; please report this with the scene")]
pub struct BrokenPixel {
    /// The strategy.
    pub strategy: Strategy,
    /// Column.
    pub x: u32,
    /// Row.
    pub y: u32,
    /// Camera sample.
    pub sample: u32,
    /// The sample.
    pub source: NotFinite,
}
