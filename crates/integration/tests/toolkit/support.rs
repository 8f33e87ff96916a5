//! What several tests share.

use twoforms_integration::{Error, Replicates};

/// What a test answers with.
pub type Outcome = Result<(), Error>;

/// Standard errors that a statistic may lie from its expected value: normal statistics do twice in 10⁹.
pub const SIX: f64 = 6.0;

/// Fails where two numbers differ by more than an absolute tolerance.
#[track_caller]
pub fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a} is not {b} within {tolerance:e}");
}

/// Fails where the mean of estimates with this variance lies more than six standard errors from I.
#[track_caller]
pub fn unbiased(replicates: &Replicates, i: f64, variance_of_mean: f64) {
    let (mean, r) = (replicates.mean(), replicates.estimates.len() as f64);
    let z = (mean - i) / (variance_of_mean / r).sqrt();
    assert!(z.abs() < SIX, "mean {mean} of {r} estimates of {i}: {z} standard errors");
}
