//! The answer without chance at one receiver, as rows and verdicts ask for it.

use twoforms_estimator::strategy::{Known, Strategy};

use crate::exactly::{ExactResult, KnownSeconds, timed_at};
use crate::place::Place;
use crate::result::Exact;
use crate::world::World;

/// Exact light at a receiver and the exact variances of one sample, or the reasons why there are none.
pub(crate) struct Answer {
    result: ExactResult,
    seconds: KnownSeconds,
    /// Whether the radiance is that of a surface with a highlight.
    glossy: bool,
}

impl Answer {
    /// Works out the answer for these strategies.
    pub(crate) fn new(world: &World, place: &Place, strategies: &[Strategy]) -> Self {
        let (result, seconds) = timed_at(world, place, strategies);
        Self { result, seconds, glossy: place.is_glossy() }
    }

    /// What is known beforehand for strategies that use it.
    pub(crate) fn known(&self) -> Known {
        self.result.known()
    }

    /// CPU seconds that it took to know what a strategy must know beforehand.
    pub(crate) fn known_seconds(&self, strategy: Strategy) -> f64 {
        if let Some(team) = strategy.needs_alpha() {
            let alpha = self.seconds.alpha.iter().find(|(known, _)| *known == team);
            return self.seconds.sight + alpha.map_or(0.0, |(_, seconds)| *seconds);
        }
        if strategy.needs_unoccluded() && self.glossy { self.seconds.sight } else { 0.0 }
    }

    /// The exact value, or why there is none.
    pub(crate) fn irradiance(&self) -> Result<Exact, &str> {
        let exact =
            self.result.light.irradiance.map(|e| Exact { irradiance: e.rgb.into(), error_bound: e.error_bound });
        exact.ok_or_else(|| self.result.light.why.get("irradiance").map_or("there is none", String::as_str))
    }

    /// The exact variance of one sample, luminance, or why there is none.
    pub(crate) fn variance_of_one(&self, strategy: Strategy) -> Result<f64, String> {
        self.irradiance()?;
        let name = strategy.to_string();
        let found = self.result.light.strategies.iter().find(|variance| variance.strategy == name);
        let reason =
            || found.and_then(|variance| variance.why.clone()).unwrap_or_else(|| "it was not asked for".into());
        found.and_then(|variance| variance.variance_of_one).map(|value| value.luminance).ok_or_else(reason)
    }
}
