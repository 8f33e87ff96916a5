//! Exponential densities.

use libm::{exp, expm1, log1p};

use crate::density::Density;
use crate::domain::Interval;
use crate::error::Error;
use crate::line::Line;

/// p(x) = λ e^(−λ(x − a))/(1 − e^(−λ(b − a))) on [a, b], where b may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponential {
    rate: f64,
    a: f64,
    b: f64,
}

impl Exponential {
    /// On [a, ∞), with rate λ: the mean is a + 1/λ.
    ///
    /// # Errors
    /// [`Error::BadParameter`] where λ is not positive and finite, or a is not finite.
    pub fn new(rate: f64, a: f64) -> Result<Self, Error> {
        if !(rate > 0.0 && rate.is_finite()) {
            return Err(Error::BadParameter { name: "the rate λ", value: rate, must: "positive and finite" });
        }
        let whole = Self { rate, a, b: f64::INFINITY };
        if a.is_finite() { Ok(whole) } else { Err(Error::BadParameter { name: "a", value: a, must: "finite" }) }
    }

    /// On [a, b] alone, with rate λ.
    ///
    /// # Errors
    /// [`Error::BadParameter`] where λ is not positive and finite.
    pub fn truncated(rate: f64, interval: Interval) -> Result<Self, Error> {
        Ok(Self { b: interval.b(), ..Self::new(rate, interval.a())? })
    }

    /// 1 − e^(−λ(x − a)).
    fn before(&self, x: f64) -> f64 {
        -expm1(-self.rate * (x - self.a))
    }
}

impl Density for Exponential {
    type Domain = Interval;

    fn dimension(&self) -> usize {
        1
    }

    /// x = a − ln(1 − ξ (1 − e^(−λ(b − a))))/λ.
    fn sample(&self, xi: &[f64]) -> f64 {
        (self.a - log1p(-xi[0] * self.before(self.b)) / self.rate).min(self.b)
    }

    fn pdf(&self, x: &f64) -> f64 {
        let inside = self.a <= *x && *x <= self.b;
        if inside { self.rate * exp(-self.rate * (x - self.a)) / self.before(self.b) } else { 0.0 }
    }
}

impl Line for Exponential {
    fn cdf(&self, x: f64) -> f64 {
        self.before(x.clamp(self.a, self.b)) / self.before(self.b)
    }
}
