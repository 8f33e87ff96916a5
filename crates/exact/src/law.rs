//! How an estimator's value is distributed, as far as its mean and variance need it.

use crate::value::{EPSILON, Value};

/// What an estimator does on one facet at unit radiance: the probability of landing on its visible
/// part, and the mean and spread of the value there. On a facet that emits by a texture there is a
/// part for each channel, with the radiance in the value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Part {
    /// Which facet of the sight.
    pub seen: usize,
    /// The one channel that it holds for: red, green, blue or luminance.
    pub channel: Option<usize>,
    /// P = ∫ p over the visible part.
    pub mass: f64,
    /// u = ∫ w p / P, w the sample's value at unit radiance.
    pub mean: f64,
    /// S = ∫ (w − u)² p.
    pub spread: f64,
    /// Bound of the error of P.
    pub mass_error: f64,
    /// Bound of the error of u.
    pub mean_error: f64,
    /// Bound of the error of S.
    pub spread_error: f64,
}

/// An estimator's parts, and the probability of a sample worth zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Law {
    /// One for each facet of which x sees something.
    pub parts: Vec<Part>,
    /// H = 1 − Σ P, computed without that subtraction where it is small: exactly zero when nothing
    /// is hidden.
    pub hidden: f64,
    /// Bound of the error of H.
    pub hidden_error: f64,
}

/// Mean and variance of one sample, in one channel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// E\[w\].
    pub mean: f64,
    /// Bound of the mean's error.
    pub mean_error: f64,
    /// V\[w\].
    pub variance: f64,
    /// Bound of the variance's error.
    pub error: f64,
}

impl Law {
    /// The law of total variance, with x_i = L_i u_i:
    ///
    /// V = Σ [ (x_i − E)² P_i + L_i² S_i ] + H E².
    ///
    /// No term is negative, so that V keeps its digits however small against E².
    pub fn outcome(&self, colours: &Colours, channel: usize) -> Outcome {
        let parts: Vec<(&Part, f64)> =
            self.parts.iter().filter_map(|part| Some((part, colours.of(part, channel)?))).collect();
        let mean = self.mean(&parts);
        let mut outcome = Outcome {
            mean,
            variance: mean * mean * self.hidden,
            error: mean * mean * self.hidden_error,
            mean_error: 0.0,
        };
        for (part, radiance) in parts {
            outcome.add(part, radiance);
        }
        outcome.error += 16.0 * EPSILON * (outcome.variance + mean.abs() * outcome.variance.abs().sqrt());
        outcome.mean_error += 16.0 * EPSILON * mean.abs();
        outcome
    }

    /// E = Σ x_i P_i. Where nothing is hidden, Σ P_i = 1 and the sum is taken about the likeliest
    /// x_i, so that equal x_i give
    /// V = 0 and not rounding.
    fn mean(&self, parts: &[(&Part, f64)]) -> f64 {
        let value = |(part, radiance): &(&Part, f64)| radiance * part.mean;
        let likeliest = parts.iter().max_by(|(a, _), (b, _)| a.mass.total_cmp(&b.mass));
        let about = likeliest.filter(|_| self.hidden == 0.0).map_or(0.0, value);
        about + parts.iter().map(|part| (value(part) - about) * part.0.mass).sum::<f64>()
    }

    /// The variance of one sample in every channel and in luminance.
    pub fn variance(&self, colours: &Colours) -> Value {
        Value::of_outcomes(|channel| self.outcome(colours, channel))
    }
}

impl Outcome {
    fn add(&mut self, part: &Part, radiance: f64) {
        let deviation = radiance * part.mean - self.mean;
        self.variance += deviation * deviation * part.mass + radiance * radiance * part.spread;
        self.error += radiance * radiance * part.spread_error
            + 2.0 * deviation.abs() * part.mass * radiance * part.mean_error
            + deviation * deviation * part.mass_error;
        self.mean_error += radiance * (part.mean * part.mass_error + part.mass * part.mean_error);
    }
}

/// Radiance of every facet: red, green, blue and luminance.
#[derive(Clone, Debug)]
pub struct Colours(pub Vec<[f64; 4]>);

impl Colours {
    /// What scales the values of a part in one channel; none where it does not hold for that channel.
    fn of(&self, part: &Part, channel: usize) -> Option<f64> {
        match part.channel {
            None => Some(self.0[part.seen][channel]),
            Some(own) => (own == channel).then_some(1.0),
        }
    }
}

impl Value {
    /// A value from its four channels: red, green, blue, luminance.
    pub(crate) fn of_outcomes(outcome: impl Fn(usize) -> Outcome) -> Self {
        let luminance = outcome(3);
        Self {
            rgb: [0, 1, 2].map(|channel| outcome(channel).variance),
            luminance: luminance.variance,
            error_bound: luminance.error,
        }
    }
}
