//! Densities that are straight lines.

use crate::density::Density;
use crate::domain::{Domain, Interval};
use crate::error::Error;
use crate::line::Line;

/// p proportional to a straight line, from one value at a to another at b: `[0, 1]` on [0, 4] is p = x/8, `[2, 6]` is
/// p = (x + 2)/16.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    interval: Interval,
    /// The line's values at a and b, which sum to 2: p (b − a).
    ends: [f64; 2],
}

impl Linear {
    /// The density proportional to the line that has these values at a and b.
    ///
    /// # Errors
    /// [`Error::BadWeight`] where a value is negative or not finite, or both are zero.
    pub fn new(interval: Interval, ends: [f64; 2]) -> Result<Self, Error> {
        let bad = |index: usize| !(ends[index] >= 0.0 && ends[index].is_finite());
        if let Some(index) = (0..2).find(|&index| bad(index)) {
            return Err(Error::BadWeight { index, weight: ends[index] });
        }
        let mean = 0.5 * ends[0] + 0.5 * ends[1];
        if mean == 0.0 {
            return Err(Error::BadWeight { index: 2, weight: mean });
        }
        Ok(Self { interval, ends: ends.map(|end| end / mean) })
    }
}

impl Density for Linear {
    type Domain = Interval;

    fn dimension(&self) -> usize {
        1
    }

    /// With p_a, p_b at the ends and t = (x − a)/(b − a), F = t (2 p_a + t (p_b − p_a))/2, and F = ξ is solved by
    /// t = 2ξ/(p_a + √(p_a² + ξ (p_b² − p_a²))), in which nothing cancels.
    fn sample(&self, xi: &[f64]) -> f64 {
        let ([p_a, p_b], xi) = (self.ends, xi[0]);
        let root = ((1.0 - xi) * (p_a * p_a) + xi * (p_b * p_b)).sqrt();
        let t = if xi == 0.0 { 0.0 } else { 2.0 * xi / (p_a + root) };
        self.interval.at(&[t])
    }

    fn pdf(&self, x: &f64) -> f64 {
        let ([p_a, p_b], t) = (self.ends, self.interval.share(*x));
        let inside = self.interval.contains(x);
        if inside { ((1.0 - t) * p_a + t * p_b) / self.interval.length() } else { 0.0 }
    }
}

impl Line for Linear {
    fn cdf(&self, x: f64) -> f64 {
        let ([p_a, p_b], t) = (self.ends, self.interval.share(x));
        0.5 * t * (2.0 * p_a + t * (p_b - p_a))
    }
}
