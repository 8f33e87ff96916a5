//! Densities on the line, which have a cumulative distribution function.

use crate::density::{Density, Uniform};
use crate::domain::Interval;

/// A density p on the line with its cumulative distribution function F(x) = ∫_{−∞}^x p. Its points are drawn by inversion:
/// `sample(&[ξ])` is F⁻¹(ξ).
pub trait Line: Density<Domain = Interval> {
    /// F(x) = Pr(X <= x): 0 before the first point that can be drawn, 1 beyond the last.
    fn cdf(&self, x: f64) -> f64;

    /// F⁻¹(ξ) for ξ in (0, 1).
    fn invert(&self, xi: f64) -> f64 {
        self.sample(&[xi])
    }

    /// Pr(a' <= X <= b') = F(b') − F(a').
    ///
    /// ```
    /// use twoforms_integration::{Interval, Line, Linear, Uniform};
    ///
    /// let interval = Interval::new(0.0, 4.0)?;
    /// assert_eq!(Uniform(interval).probability(1.0, 2.0), 0.25);
    /// assert_eq!(Linear::new(interval, [0.0, 1.0])?.probability(1.0, 2.0), 3.0 / 16.0);
    /// # Ok::<(), twoforms_integration::Error>(())
    /// ```
    fn probability(&self, a: f64, b: f64) -> f64 {
        self.cdf(b) - self.cdf(a)
    }
}

/// F(x) = (x − a)/(b − a).
impl Line for Uniform<Interval> {
    fn cdf(&self, x: f64) -> f64 {
        self.0.share(x)
    }
}
