//! Many independent means of N samples.

use twoforms_estimator::moments::Moments;

/// R independent estimates, each the mean of N samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Replicates {
    /// The estimates.
    pub estimates: Vec<f64>,
    /// Moments of all R·N samples.
    pub samples: Moments,
}

impl Replicates {
    /// Adds an estimate, given by the moments of its samples.
    pub fn add(&mut self, estimate: Moments) {
        self.estimates.push(estimate.mean);
        self.samples = self.samples + estimate;
    }

    /// The mean of the estimates.
    pub fn mean(&self) -> f64 {
        Moments::of(&self.estimates).mean
    }

    /// Σ(⟨I⟩ − mean)²/(R − 1): how far an estimate scatters, whatever the sampler. `None` for fewer than two estimates.
    pub fn variance_of_mean(&self) -> Option<f64> {
        Moments::of(&self.estimates).variance()
    }

    /// Σ(w − w̄)²/(RN − 1): how far a single sample scatters. `None` for fewer than two samples.
    pub fn variance_of_one(&self) -> Option<f64> {
        self.samples.variance()
    }

    /// √(Σ(⟨I⟩ − I)²/R): the root mean square error about a known I. NaN without estimates.
    pub fn rms_error(&self, i: f64) -> f64 {
        let squares = self.estimates.iter().map(|estimate| (estimate - i) * (estimate - i));
        (squares.sum::<f64>() / self.estimates.len() as f64).sqrt()
    }
}
