//! What samples add up to.

use crate::moments::Moments;

/// An estimate: what N samples add up to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// ⟨I⟩_sec = (1/N) Σ f(x_i)/p(x_i), RGB.
    pub value: [f64; 3],
    /// Moments of the single samples' luminances.
    pub luminance: Moments,
    /// Rays asked for.
    pub rays: u64,
    /// Samples that were not zero.
    pub hits: u64,
    /// Smallest and largest luminance among the samples that were not zero; (∞, −∞) without any.
    pub range: Range,
}

/// The smallest and the largest of some values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The smallest, +∞ without values.
    pub low: f64,
    /// The largest, −∞ without values.
    pub high: f64,
}

impl Default for Range {
    fn default() -> Self {
        Self { low: f64::INFINITY, high: f64::NEG_INFINITY }
    }
}

impl Range {
    /// The range of both.
    pub fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Whether all values are the same but for the rounding of binary32 arithmetic (some ten roundings).
    pub fn is_one_value(&self) -> bool {
        self.low <= self.high && self.high - self.low <= 1e-6 * self.high.abs()
    }
}

/// A sample that came out infinite or not a number.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("sample {index} is worth {value:?}, which is not finite; its random words are {words:?}")]
pub struct NotFinite {
    /// Which sample of the estimate.
    pub index: u32,
    /// Its value, RGB.
    pub value: [f32; 3],
    /// ξ: two words for each pair of numbers that it takes.
    pub words: Vec<[u32; 2]>,
}
