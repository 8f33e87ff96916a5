//! The answer without chance at one receiver, as rows and verdicts ask for it.

use twoforms_estimator::strategy::{Known, Strategy};

use crate::exactly::{ExactResult, at};
use crate::place::Place;
use crate::result::Exact;
use crate::world::World;

/// Exact light at a receiver and the exact variances of one sample, or the reasons why there are none.
pub(crate) struct Answer(ExactResult);

impl Answer {
    /// Works out the answer for these strategies.
    pub(crate) fn new(world: &World, place: &Place, strategies: &[Strategy]) -> Self {
        Self(at(world, place, strategies))
    }

    /// What is known beforehand for strategies that use it.
    pub(crate) fn known(&self) -> Known {
        self.0.known()
    }

    /// The exact value, or why there is none.
    pub(crate) fn irradiance(&self) -> Result<Exact, &str> {
        let exact = self.0.light.irradiance.map(|e| Exact { irradiance: e.rgb.into(), error_bound: e.error_bound });
        exact.ok_or_else(|| self.0.light.why.get("irradiance").map_or("there is none", String::as_str))
    }

    /// The exact variance of one sample, luminance, or why there is none.
    pub(crate) fn variance_of_one(&self, strategy: Strategy) -> Result<f64, String> {
        self.irradiance()?;
        let name = strategy.to_string();
        let found = self.0.light.strategies.iter().find(|variance| variance.strategy == name);
        let reason =
            || found.and_then(|variance| variance.why.clone()).unwrap_or_else(|| "it was not asked for".into());
        found.and_then(|variance| variance.variance_of_one).map(|value| value.luminance).ok_or_else(reason)
    }
}
