//! Shares of a whole, picked by inversion of their running sums.

use crate::error::Error;

/// Weights w_0 … w_{n−1} and their running sums: share k is w_k / Σ w.
#[derive(Clone, Debug, PartialEq)]
pub struct Shares {
    /// w_0 + … + w_k.
    sums: Vec<f64>,
}

impl Shares {
    /// The shares of these weights.
    ///
    /// # Errors
    /// [`Error::BadWeight`] where a weight is negative or not finite, or none is positive.
    pub fn new(weights: impl IntoIterator<Item = f64>) -> Result<Self, Error> {
        let (mut sums, mut sum) = (Vec::new(), 0.0);
        for (index, weight) in weights.into_iter().enumerate() {
            sum += weight;
            if !(weight >= 0.0 && sum.is_finite()) {
                return Err(Error::BadWeight { index, weight });
            }
            sums.push(sum);
        }
        if sum > 0.0 { Ok(Self { sums }) } else { Err(Error::BadWeight { index: sums.len(), weight: sum }) }
    }

    /// Σ w.
    pub fn total(&self) -> f64 {
        self.sums[self.sums.len() - 1]
    }

    /// (w_0 + … + w_{k−1}) / Σ w.
    pub fn before(&self, k: usize) -> f64 {
        self.sum_before(k) / self.total()
    }

    /// w_k / Σ w.
    pub fn share(&self, k: usize) -> f64 {
        (self.sums[k] - self.sum_before(k)) / self.total()
    }

    /// The k that ξ in (0, 1) falls to, which has the probability `share(k)`, and where in its share ξ lies, from 0 to 1: a random
    /// number that can be used again.
    pub fn invert(&self, xi: f64) -> (usize, f64) {
        // Nothing has a share beyond the whole, so that ξ = 1 belongs to the last that has one.
        let sum = (xi * self.total()).min(self.total().next_down());
        let k = self.sums.partition_point(|&until| until <= sum);
        let before = self.sum_before(k);
        (k, (sum - before) / (self.sums[k] - before))
    }

    fn sum_before(&self, k: usize) -> f64 {
        if k == 0 { 0.0 } else { self.sums[k - 1] }
    }
}
