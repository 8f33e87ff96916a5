//! Why a figure has no value.

use thiserror::Error;

use super::enough::{MIN_EFFECTIVE, MIN_NON_ZERO};
use super::regime::Candidates;

/// Why a statistic is not given. Its text is a complete sentence for the reader of a result.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum Reason {
    /// A variance needs two replicates.
    #[error("a variance needs at least 2 replicates, there are {replicates}: take more replicates")]
    FewReplicates {
        /// R.
        replicates: usize,
    },
    /// Nothing varies, so nothing says how well the variance is known.
    #[error("every replicate gave the same value, so the data do not say how well a variance of 0 is known")]
    AllEqual,
    /// Estimates, or their moments, are not finite.
    #[error("the replicates' estimates or their moments are not finite")]
    NotFinite,
    /// Too few replicates saw any light.
    #[error(
        "only {found} replicates are not zero, an interval needs {MIN_NON_ZERO}: take more replicates or more samples"
    )]
    FewNonZero {
        /// Number of replicates that are not zero.
        found: usize,
    },
    /// A few replicates make up the whole variance.
    #[error(
        "the variance rests on a few replicates, as many as {effective:.1} hits would, an interval needs \
         {MIN_EFFECTIVE}: take more replicates or more samples"
    )]
    FewEffective {
        /// 1 / (relative standard error of the variance)².
        effective: f64,
    },
    /// Counts that contradict each other.
    #[error("{hits} hits in {samples} samples is not a count of hits")]
    NotACount {
        /// Samples that took the value.
        hits: u64,
        /// All samples.
        samples: u64,
    },
    /// A line needs two points.
    #[error(
        "a rate needs the variance's spread at 2 sample counts or more, there are {points}: take more replicates \
         or other sample counts"
    )]
    FewPoints {
        /// Number of distinct sample counts.
        points: usize,
    },
    /// No regime's slope lies in the interval.
    #[error("no known rate lies in the interval of the slope")]
    NoRegime,
    /// More than one does.
    #[error(
        "undecided between {found}, which all lie in the interval of the slope: take more replicates or a wider range of \
         sample counts"
    )]
    SeveralRegimes {
        /// Which.
        found: Candidates,
    },
}
