//! The laws by which variance falls with the number of samples.

use std::fmt;

/// Slopes of log variance against log N that theory knows, with their names.
///
/// −1: independent samples. −3/2: jittered samples across a discontinuity in two dimensions (Mitchell 1996).
/// −2: jittered samples of a smooth function in two dimensions, or stratified ones across a jump in one.
/// −3: stratified samples of a smooth function in one dimension, and scrambled nets in two up to a logarithm (Owen 1997).
/// A net of N = 2^k points fills k + 1 shapes of intervals, so that any slope from that of N⁻³ to that of
/// (1 + log₂ N) N⁻³, fitted to the same N, is of that regime.
pub const REGIMES: [(f64, &str); 4] = [(-1.0, "1/N"), (-1.5, "1/N^1.5"), (-2.0, "1/N^2"), (-3.0, "1/N^3")];

/// The slope that scrambled nets have up to a logarithm.
const NET: f64 = -3.0;

/// Some of the [`REGIMES`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Candidates([bool; REGIMES.len()]);

impl Candidates {
    /// Those whose slopes lie in the interval; `logarithm` is what a factor 1 + log₂ N adds to a slope.
    pub(super) fn within([lo, hi]: [f64; 2], logarithm: f64) -> Self {
        let most = |slope: f64| if slope == NET { slope + logarithm } else { slope };
        Self(REGIMES.map(|(slope, _)| lo <= most(slope) && slope <= hi))
    }

    /// Their names.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        REGIMES.into_iter().zip(self.0).filter(|(_, inside)| *inside).map(|((_, name), _)| name)
    }
}

/// `1/N^1.5 or 1/N^2`.
impl fmt::Display for Candidates {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.names().collect::<Vec<_>>().join(" or "))
    }
}
