//! Densities that are powers of x.

use libm::pow;

use crate::density::Density;
use crate::domain::{Domain, Interval};
use crate::error::Error;
use crate::line::Line;

/// p(x) = k xⁿ on [a, b], 0 <= a, n > −1, with k = (n + 1)/(bⁿ⁺¹ − aⁿ⁺¹).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Power {
    interval: Interval,
    n: f64,
    /// aⁿ⁺¹ and bⁿ⁺¹.
    ends: [f64; 2],
}

impl Power {
    /// The density proportional to xⁿ.
    ///
    /// # Errors
    /// [`Error::BadParameter`] for n not above −1, for a negative a, and where bⁿ⁺¹ − aⁿ⁺¹ is zero or infinite.
    pub fn new(interval: Interval, n: f64) -> Result<Self, Error> {
        if n.is_nan() || n <= -1.0 {
            return Err(Error::BadParameter { name: "the exponent n", value: n, must: "above −1" });
        }
        if interval.a() < 0.0 {
            return Err(Error::BadParameter { name: "a", value: interval.a(), must: "zero or positive" });
        }
        let ends = [interval.a(), interval.b()].map(|x| pow(x, n + 1.0));
        let value = ends[1] - ends[0];
        let power = Self { interval, n, ends };
        let must = "positive and finite";
        if value > 0.0 && value.is_finite() {
            Ok(power)
        } else {
            Err(Error::BadParameter { name: "bⁿ⁺¹ − aⁿ⁺¹", value, must })
        }
    }

    /// k.
    pub fn k(&self) -> f64 {
        (self.n + 1.0) / (self.ends[1] - self.ends[0])
    }
}

impl Density for Power {
    type Domain = Interval;

    fn dimension(&self) -> usize {
        1
    }

    /// x = (aⁿ⁺¹ + ξ (bⁿ⁺¹ − aⁿ⁺¹))^(1/(n + 1)).
    fn sample(&self, xi: &[f64]) -> f64 {
        let [a, b] = self.ends;
        self.interval.nearest(pow(a + xi[0] * (b - a), 1.0 / (self.n + 1.0)))
    }

    fn pdf(&self, x: &f64) -> f64 {
        if self.interval.contains(x) { self.k() * pow(*x, self.n) } else { 0.0 }
    }
}

impl Line for Power {
    /// F(x) = (xⁿ⁺¹ − aⁿ⁺¹)/(bⁿ⁺¹ − aⁿ⁺¹).
    fn cdf(&self, x: f64) -> f64 {
        let [a, b] = self.ends;
        (pow(self.interval.nearest(x), self.n + 1.0) - a) / (b - a)
    }
}
