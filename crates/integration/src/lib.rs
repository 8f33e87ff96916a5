//! Monte Carlo integration of any function: the lecture's words, without a scene.
//!
//! Everything random is one thing here, a [`Variable`]: a function of random numbers ξ in the unit cube. A die is one, and so is
//! the primary estimator f(x)/p(x) of an integral, [`Estimator`], over an interval, a box of any dimension or any other measured
//! [`Domain`], with any [`Density`]. What can be asked of one can be asked of all: its expected value and variance
//! without chance, the mean of N samples by any sampler, many replicates of that mean, a quadrature rule in its place.
//!
//! ```
//! use twoforms_integration::{Estimator, Interval, Linear, Source, Uniform, Variable};
//!
//! // ∫₀⁴ x dx = 8, with samples spread evenly and with p = (x + 2)/16.
//! let interval = Interval::new(0.0, 4.0)?;
//! let evenly = Estimator::new(|x| x, Uniform(interval));
//! let by_importance = Estimator::new(|x| x, Linear::new(interval, [2.0, 6.0])?);
//!
//! // Without chance: σ² = 64/3 and 64 ln 3 − 64.
//! assert_eq!(format!("{:.1}", evenly.exact(1e-12)?.variance), "21.3");
//! assert_eq!(format!("{:.1}", by_importance.exact(1e-12)?.variance), "6.3");
//!
//! // By chance: one secondary estimate of 10 000 samples, six standard deviations wide.
//! let source = Source::independent(0);
//! let estimate = by_importance.secondary(&source.stream(10_000, 0))?;
//! assert!((estimate.mean - 8.0).abs() < 6.0 * (6.3_f64 / 10_000.0).sqrt());
//! # Ok::<(), twoforms_integration::Error>(())
//! ```
//!
//! A density belongs to the measure of its domain, and an integrand is per unit of that measure: in (φ, θ) the light that arrives
//! is L cosθ sinθ, per solid angle it is L cosθ. See [`Hemisphere`] for both.

pub mod chebyshev;
pub mod cubature;
pub mod density;
pub mod discrete;
pub mod domain;
pub mod error;
pub mod estimator;
pub mod exact;
pub mod exponential;
pub mod given;
pub mod hemisphere;
pub mod line;
pub mod linear;
pub mod piecewise;
pub mod power;
pub mod product;
pub mod replicates;
pub mod rule;
pub mod series;
pub mod shares;
pub mod source;
pub mod variable;
pub mod versus;

pub use chebyshev::chebyshev;
pub use cubature::integrate;
pub use density::{Density, Uniform};
pub use discrete::Discrete;
pub use domain::{Domain, Interval};
pub use error::Error;
pub use estimator::{Estimator, Transformed};
pub use exact::Exact;
pub use exponential::Exponential;
pub use given::Given;
pub use hemisphere::{CosineHemisphere, Hemisphere};
pub use line::Line;
pub use linear::Linear;
pub use piecewise::Piecewise;
pub use power::Power;
pub use replicates::Replicates;
pub use rule::Rule;
pub use series::{exponent, running_means};
pub use source::Source;
pub use twoforms_estimator::moments::Moments;
pub use twoforms_estimator::sampler::{Sampler, Stream};
pub use variable::Variable;
pub use versus::{Versus, crossing};
