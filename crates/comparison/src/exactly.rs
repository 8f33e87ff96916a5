//! Exact light at receivers: irradiance and the variance of one sample of each strategy, with no chance in them.

use rayon::prelude::*;
use twoforms_estimator::strategy::{Strategy, Team};
use twoforms_exact::{Sight, receiver};

pub use crate::exact_result::{Bounded, ExactLight, ExactResult, ExactVariance};
pub use twoforms_exact::with_formula;

use crate::clock::timed;
use crate::place::Place;
use crate::world::World;

/// Works out every receiver, in parallel on rayon's threads; `progress` is told of each that is done.
pub fn exactly(
    world: &World,
    places: &[Place],
    strategies: &[Strategy],
    progress: &(dyn Fn(u64) + Sync),
) -> Vec<ExactResult> {
    let one = |place| {
        let result = at(world, place, strategies);
        progress(1);
        result
    };
    places.par_iter().map(one).collect()
}

/// Works out one receiver.
pub fn at(world: &World, place: &Place, strategies: &[Strategy]) -> ExactResult {
    timed_at(world, place, strategies).0
}

/// CPU seconds of what strategies must know beforehand.
#[derive(Clone, Debug, Default)]
pub(crate) struct KnownSeconds {
    /// What x sees, with its irradiance or radiance.
    pub(crate) sight: f64,
    /// The α of each team.
    pub(crate) alpha: Vec<(Team, f64)>,
}

/// Works out one receiver, and says what it takes to know what strategies use.
pub(crate) fn timed_at(world: &World, place: &Place, strategies: &[Strategy]) -> (ExactResult, KnownSeconds) {
    let frame = place.frame();
    let look = || {
        let sight = receiver::look(&world.geometry, &world.lights, &frame, place.scale());
        sight.and_then(|sight| place.reflected(&frame, sight))
    };
    // To ask the clock takes as long as to look at a few targets.
    let known = place.is_glossy() || strategies.iter().any(|strategy| strategy.needs_alpha().is_some());
    let (sight, seconds) = if known { timed(look) } else { (look(), 0.0) };
    let mut known_seconds = KnownSeconds { sight: seconds, alpha: Vec::new() };
    // Where radiance varies over a target, the unhidden light of the mean radiances is another number, and not known.
    let known = |_: &&Sight| place.is_glossy() && !world.lights.vary();
    let unoccluded = sight.as_ref().ok().filter(known).map(|sight| sight.irradiance_unoccluded().rgb);
    let teams = strategies.iter().filter_map(|strategy| strategy.needs_alpha());
    let of = |team: Team| {
        let (alpha, seconds) = timed(|| sight.as_ref().ok()?.optimal_alpha(team).ok());
        known_seconds.alpha.push((team, seconds));
        Some((team, alpha?))
    };
    let alpha = teams.filter_map(of).collect();
    let light = ExactLight::of(place, sight, strategies);
    (ExactResult { alpha, unoccluded, ..ExactResult::new(place, light, None) }, known_seconds)
}
