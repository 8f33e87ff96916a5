//! The answer without chance at one receiver.

use twoforms_estimator::strategy::Strategy;
use twoforms_exact::{Value, receiver};

use crate::exactly::{Bounded, seen};
use crate::place::Place;
use crate::result::Exact;
use crate::world::World;

/// Exact light at a receiver and the exact variances of one sample, or the reasons why there are none.
pub(crate) struct Answer {
    irradiance: Result<Exact, String>,
    variances: Vec<(Strategy, Result<f64, String>)>,
}

impl Answer {
    /// Works out the answer for these strategies.
    pub(crate) fn new(world: &World, place: &Place, strategies: &[Strategy]) -> Self {
        match receiver::look(&world.geometry, &world.lights, &place.frame(), place.f_r()) {
            Err(reason) => Self { irradiance: Err(reason.to_string()), variances: Vec::new() },
            Ok(sight) => {
                let variance = |strategy| match sight.variance(strategy) {
                    Ok(Value { luminance, .. }) => Ok(luminance),
                    Err(reason) => Err(reason.to_string()),
                };
                Self {
                    irradiance: Ok(exact(seen(sight.irradiance(), place.emission()))),
                    variances: strategies.iter().map(|&strategy| (strategy, variance(strategy))).collect(),
                }
            }
        }
    }

    /// The exact value, or why there is none.
    pub(crate) fn irradiance(&self) -> Result<Exact, &str> {
        self.irradiance.as_ref().copied().map_err(String::as_str)
    }

    /// The exact variance of one sample, luminance, or why there is none.
    pub(crate) fn variance_of_one(&self, strategy: Strategy) -> Result<f64, String> {
        let found = self.variances.iter().find(|(other, _)| *other == strategy);
        match (found, &self.irradiance) {
            (Some((_, variance)), _) => variance.clone(),
            (None, Err(reason)) => Err(reason.clone()),
            (None, Ok(_)) => Err("no exact variance is worked out for this strategy".into()),
        }
    }
}

fn exact(Bounded { rgb, error_bound, .. }: Bounded) -> Exact {
    Exact { irradiance: rgb.into(), error_bound }
}
