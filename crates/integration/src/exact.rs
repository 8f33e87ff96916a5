//! Expected values and variances without chance.

use std::ops::{Add, Mul};

/// The expected value and the variance of a random variable, with estimates of their absolute errors.
///
/// Sums and products are those of independent variables, so that integrals of products over many dimensions need no cubature
/// there:
///
/// ```
/// use twoforms_integration::{Estimator, Interval, Uniform, Variable};
///
/// // ∫ 5x⁴ 5y⁴ over the unit square: σ² = (1 + 16/9)² − 1 = 544/81.
/// let f = |x: f64| 5.0 * x.powi(4);
/// let one = Estimator::new(f, Uniform(Interval::UNIT)).exact(1e-12)?;
/// let both = Estimator::new(|[x, y]: [f64; 2]| f(x) * f(y), Uniform([Interval::UNIT; 2])).exact(1e-12)?;
/// assert!(((one * one).variance - 544.0 / 81.0).abs() < 1e-11);
/// assert!((both.variance - 544.0 / 81.0).abs() < 1e-11);
/// # Ok::<(), twoforms_integration::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exact {
    /// The expected value `E[w]`.
    pub mean: f64,
    /// `σ² = E[(w − E[w])²]`.
    pub variance: f64,
    /// Estimate of the absolute error of the mean.
    pub mean_error: f64,
    /// Estimate of the absolute error of the variance.
    pub variance_error: f64,
}

impl Exact {
    /// A known mean and variance.
    pub fn known(mean: f64, variance: f64) -> Self {
        Self { mean, variance, mean_error: 0.0, variance_error: 0.0 }
    }

    /// σ.
    pub fn sigma(&self) -> f64 {
        self.variance.sqrt()
    }

    /// The mean of N independent samples: its variance is σ²/N, its standard deviation σ/√N.
    pub fn of_mean(self, n: u32) -> Self {
        let n = f64::from(n);
        Self { variance: self.variance / n, variance_error: self.variance_error / n, ..self }
    }
}

/// `E[v + w] = E[v] + E[w]`, and for independent variables σ²(v + w) = σ²(v) + σ²(w).
impl Add for Exact {
    type Output = Self;

    fn add(self, w: Self) -> Self {
        Self {
            mean: self.mean + w.mean,
            variance: self.variance + w.variance,
            mean_error: self.mean_error + w.mean_error,
            variance_error: self.variance_error + w.variance_error,
        }
    }
}

/// For independent variables `E[v w] = E[v] E[w]` and `σ²(v w) = σ²(v) σ²(w) + σ²(v) E[w]² + E[v]² σ²(w)`.
impl Mul for Exact {
    type Output = Self;

    fn mul(self, w: Self) -> Self {
        let v = self;
        let second = |of: Self| of.variance + of.mean * of.mean;
        let by_mean = |of: Self, other: Self| 2.0 * of.mean.abs() * of.mean_error * other.variance;
        Self {
            mean: v.mean * w.mean,
            variance: v.variance * second(w) + v.mean * v.mean * w.variance,
            mean_error: v.mean_error * w.mean.abs() + v.mean.abs() * w.mean_error,
            variance_error: v.variance_error * second(w) + w.variance_error * second(v) + by_mean(v, w) + by_mean(w, v),
        }
    }
}
