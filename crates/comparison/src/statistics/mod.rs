//! The statistics of a comparison: pure functions of the replicates' estimates.
//!
//! An experiment repeats an N-sample estimate R times. From those R numbers come the variance of the estimate
//! ([`sample_variance`]), its 95 % interval ([`variance_interval`]), how often Chebyshev's bound was kept
//! ([`chebyshev`]), the rate at which the variance falls with N ([`fit_rate`]), the efficiency ([`efficiency`]), and
//! by what factor one strategy's variance is below another's ([`variance_ratio`]).
//!
//! The spread of a variance is read from the replicates alone, so all of it stays valid for samplers whose samples
//! depend on each other. What cannot be given is refused with a [`Reason`], never replaced by a guess.

mod clopper_pearson;
mod efficiency;
mod enough;
mod familywise;
mod log_variance;
mod normal;
mod rate;
mod ratio;
mod reason;
mod regime;
mod student;
mod variance;
mod variance_interval;

pub use clopper_pearson::{binomial_p_value, clopper_pearson};
pub use efficiency::efficiency;
pub use enough::{MIN_EFFECTIVE, MIN_NON_ZERO};
pub use familywise::{holm, sidak};
pub use log_variance::LogVariance;
pub use normal::{normal_quantile, normal_tail};
pub use rate::{RateFit, fit_rate};
pub use ratio::{VarianceRatio, variance_ratio};
pub use reason::Reason;
pub use regime::{Candidates, REGIMES};
pub use student::{Z_95, student_quantile};
pub use twoforms_integration::chebyshev::{Band, chebyshev};
pub use variance::{sample_mean, sample_variance};
pub use variance_interval::{TwoValued, variance_interval};
