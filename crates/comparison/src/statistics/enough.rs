//! How many replicates are enough to say how well a variance is known.

/// Least number of replicates that are not zero for the spread of a variance to be read from them.
pub const MIN_NON_ZERO: usize = 30;

/// Least effective number of replicates, 1 / (relative standard error of s²)², for the same.
pub const MIN_EFFECTIVE: f64 = 5.0;
