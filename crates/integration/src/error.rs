//! What can keep a number from being had.

use thiserror::Error;
use twoforms_estimator::sampler::TooManyPairs;

/// Why something cannot be integrated or sampled as asked.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Error {
    /// The ends of an interval.
    #[error("[{a}, {b}] is no interval: its ends must be finite numbers, the first below the second")]
    BadInterval {
        /// The lower end.
        a: f64,
        /// The upper end.
        b: f64,
    },
    /// Weights that make no probabilities.
    #[error("weight {index} is {weight}: weights must be finite and not negative, and at least one must be positive")]
    BadWeight {
        /// Which of them; the number of weights where none is positive.
        index: usize,
        /// Its value, or the sum of all.
        weight: f64,
    },
    /// A number that a density depends on.
    #[error("{name} is {value}, but must be {must}")]
    BadParameter {
        /// What it is.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What would do.
        must: &'static str,
    },
    /// A table whose columns do not belong together.
    #[error("{places} places with {values} values: there must be {must}")]
    BadTable {
        /// Places on the axis.
        places: usize,
        /// Values given for them.
        values: usize,
        /// What would do.
        must: &'static str,
    },
    /// A pdf, cdf and inverse that do not belong together.
    #[error(
        "at ξ = {xi}, F⁻¹(ξ) = {x}, F there is {cdf} and p {pdf}: F must rise from 0 to 1, F⁻¹ undo it, and p not be negative"
    )]
    NotADensity {
        /// ξ.
        xi: f64,
        /// F⁻¹(ξ).
        x: f64,
        /// F at that x.
        cdf: f64,
        /// p at that x.
        pdf: f64,
    },
    /// A sample that is not a number, or infinite.
    #[error("sample {index} is worth {value}, which is not finite; its random numbers are {xi:?}")]
    NotFinite {
        /// Which sample.
        index: u32,
        /// Its worth.
        value: f64,
        /// ξ.
        xi: Vec<f64>,
    },
    /// A mean of no samples.
    #[error("the mean of no samples is asked for: N must be at least 1")]
    NoSamples,
    /// A deterministic sampler where a sample takes more than two numbers.
    #[error(transparent)]
    Sampler(#[from] TooManyPairs),
    /// Cubature stopped at its limit of work with too large an error left.
    #[error(
        "cubature reached {value} ± {error:.1e} after {evaluations} evaluations and stopped: allow a larger error, or the integral may be infinite"
    )]
    NotConverged {
        /// The integral so far.
        value: f64,
        /// Estimate of its absolute error.
        error: f64,
        /// How often the function was evaluated.
        evaluations: usize,
    },
    /// A cube of too many axes for cubature.
    #[error(
        "cubature over {dimension} axes takes {evaluations} evaluations for a first cell alone: find mean and variance as sums or products of those of fewer axes"
    )]
    TooManyDimensions {
        /// Axes.
        dimension: usize,
        /// How often the function would have to be evaluated.
        evaluations: usize,
    },
    /// A budget that is too small for a product rule.
    #[error("{budget} evaluations are no two along each of {dimension} axes: allow at least 2^{dimension}")]
    SmallBudget {
        /// Evaluations allowed.
        budget: u32,
        /// Axes.
        dimension: usize,
    },
}
