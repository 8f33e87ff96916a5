//! Discrete random variables.

use crate::error::Error;
use crate::shares::Shares;
use crate::variable::Variable;

/// A random variable that takes the values x_k with probabilities p_k.
///
/// The average die has the faces 2, 3, 3, 4, 4, 5:
///
/// ```
/// use twoforms_integration::Discrete;
///
/// let die = Discrete::equally_likely([2.0, 3.0, 3.0, 4.0, 4.0, 5.0])?;
/// assert_eq!(die.mean(), 3.5);
/// assert_eq!(die.variance(), 11.0 / 12.0);
/// assert_eq!(die.probability(|x| x == 3.0), 1.0 / 3.0);
///
/// // σ² = E[x²] − E[x]².
/// let identity = die.expected(|x| x * x) - die.mean() * die.mean();
/// assert!((identity - die.variance()).abs() < 1e-14);
/// # Ok::<(), twoforms_integration::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Discrete {
    values: Vec<f64>,
    weights: Vec<f64>,
    shares: Shares,
}

impl Discrete {
    /// Values with weights, to which their probabilities are proportional.
    ///
    /// # Errors
    /// [`Error::BadWeight`] where a weight is negative or not finite, or none is positive.
    pub fn new(outcomes: impl IntoIterator<Item = (f64, f64)>) -> Result<Self, Error> {
        let (values, weights): (Vec<_>, Vec<_>) = outcomes.into_iter().unzip();
        Ok(Self { shares: Shares::new(weights.iter().copied())?, values, weights })
    }

    /// Values that are equally likely, like the faces of a die; one that occurs twice is twice as likely.
    ///
    /// # Errors
    /// [`Error::BadWeight`] without values.
    pub fn equally_likely(values: impl IntoIterator<Item = f64>) -> Result<Self, Error> {
        Self::new(values.into_iter().map(|value| (value, 1.0)))
    }

    /// `E[g(x)] = Σ p_k g(x_k)`.
    pub fn expected(&self, g: impl Fn(f64) -> f64) -> f64 {
        self.values.iter().zip(&self.weights).map(|(&x, w)| w * g(x)).sum::<f64>() / self.shares.total()
    }

    /// The expected value `E[x]`.
    pub fn mean(&self) -> f64 {
        self.expected(|x| x)
    }

    /// `σ² = E[(x − E[x])²]`.
    pub fn variance(&self) -> f64 {
        let mean = self.mean();
        self.expected(|x| (x - mean) * (x - mean))
    }

    /// Pr(x is such a value).
    pub fn probability(&self, such: impl Fn(f64) -> bool) -> f64 {
        self.expected(|x| if such(x) { 1.0 } else { 0.0 })
    }

    /// F(x) = Pr(X <= x).
    pub fn cdf(&self, x: f64) -> f64 {
        self.probability(|value| value <= x)
    }

    /// The value that ξ in (0, 1) falls to: x_k where p_0 + … + p_{k−1} <= ξ < p_0 + … + p_k.
    pub fn invert(&self, xi: f64) -> f64 {
        self.values[self.shares.invert(xi).0]
    }
}

impl Variable for Discrete {
    fn dimension(&self) -> usize {
        1
    }

    fn at(&self, xi: &[f64]) -> f64 {
        self.invert(xi[0])
    }
}
