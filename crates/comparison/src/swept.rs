//! Exact light along a sweep, and where two strategies' variances are equal.

use rayon::prelude::*;
use twoforms_estimator::strategy::{Strategy, Team, Weighting};
use twoforms_estimator::technique::Kind;

use crate::crossing::{Difference, Root, Sample, roots};
pub use crate::exact_result::{Crossing, Step, Swept};
use crate::exact_result::{ExactLight, ExactResult, ExactVariance};
use crate::motion::Stage;
use crate::place::Place;
use crate::sweep::Sweep;
use crate::world::World;

/// Works out every receiver at rest and along the sweep, in parallel on rayon's threads; `progress` is told of each step
/// of each receiver that is done.
///
/// Crossings are found where the steps show a change of sign or a dip of the difference (see the head of `crossing.rs`):
/// of several between the same two steps, some may be missed.
pub fn swept(
    world: &World,
    places: &[Place],
    strategies: &[Strategy],
    sweep: &Sweep,
    progress: &(dyn Fn(u64) + Sync),
) -> Vec<ExactResult> {
    let stage = Stage::new(world, sweep.parameter());
    let one = |place: &Place| {
        let along = Along { stage: &stage, place, strategies, sweep };
        let at_rest = ExactLight::of(place, stage.at_rest(place), strategies);
        ExactResult::new(place, at_rest, Some(along.swept(progress)))
    };
    places.par_iter().map(one).collect()
}

/// The strategies of a sweep when nothing is said: the basic ones, and the balance heuristic.
pub fn default_strategies() -> Vec<Strategy> {
    vec![
        Strategy::from(Kind::AreaUniform),
        Strategy::from(Kind::HemisphereCosine),
        Strategy::from(Kind::HemisphereUniform),
        Strategy::from(Kind::AreaSolidAngle),
        Strategy::from(Kind::AreaProjectedSolidAngle),
        Strategy::Mis(Weighting::Balance, Team::default()),
    ]
}

/// One receiver along a sweep.
struct Along<'a> {
    stage: &'a Stage<'a>,
    place: &'a Place,
    strategies: &'a [Strategy],
    sweep: &'a Sweep,
}

impl Along<'_> {
    fn swept(&self, progress: &(dyn Fn(u64) + Sync)) -> Swept {
        let places: Vec<f64> = self.sweep.places().collect();
        let step = |&u: &f64| {
            let step = self.step(u);
            progress(1);
            step
        };
        let steps: Vec<Step> = places.par_iter().map(step).collect();
        let crossings = self.crossings(&places, &steps);
        let [from, to] = self.sweep.range();
        Swept { parameter: self.sweep.parameter(), from, to, scale: self.sweep.spacing(), steps, crossings }
    }

    fn step(&self, u: f64) -> Step {
        let at = self.sweep.at(u);
        Step { at, light: ExactLight::of(self.place, self.stage.look(self.place, at), self.strategies) }
    }

    /// The crossings of every two strategies.
    fn crossings(&self, places: &[f64], steps: &[Step]) -> Vec<Crossing> {
        let count = self.strategies.len();
        let pairs: Vec<[usize; 2]> = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b])).collect();
        let mut crossings: Vec<(f64, Crossing)> =
            pairs.into_par_iter().flat_map_iter(|pair| self.crossings_of(pair, places, steps)).collect();
        crossings.sort_by(|(u, _), (v, _)| u.total_cmp(v));
        crossings.into_iter().map(|(_, crossing)| crossing).collect()
    }

    /// The crossings of two strategies, each with its place.
    fn crossings_of(&self, pair: [usize; 2], places: &[f64], steps: &[Step]) -> Vec<(f64, Crossing)> {
        let sample = |(&u, step): (&f64, &Step)| Sample { u, difference: difference(&step.light.strategies, pair) };
        let samples: Vec<Sample> = places.iter().zip(steps).map(sample).collect();
        let roots = roots(&samples, |u| self.difference(pair, u));
        roots.into_iter().map(|root| (root.u, self.crossing(pair, root))).collect()
    }

    /// The difference of two variances at a place between steps.
    fn difference(&self, pair: [usize; 2], u: f64) -> Option<Difference> {
        let sight = self.stage.look(self.place, self.sweep.at(u)).ok()?;
        let [a, b] = pair.map(|k| sight.variance(self.strategies[k]).ok());
        let (a, b) = (a?, b?);
        Difference::of([a.luminance, a.error_bound], [b.luminance, b.error_bound])
    }

    fn crossing(&self, pair: [usize; 2], Root { u, error }: Root) -> Crossing {
        let [before, at, after] = [u - error, u, u + error].map(|u| self.sweep.at(u));
        let error_bound = (after - at).abs().max((at - before).abs());
        Crossing { strategies: pair.map(|k| self.strategies[k].to_string()), at, error_bound }
    }
}

/// The difference of two variances of a step.
fn difference(variances: &[ExactVariance], [a, b]: [usize; 2]) -> Option<Difference> {
    let of = |k: usize| variances.get(k)?.variance_of_one.map(|v| [v.luminance, v.error_bound]);
    Difference::of(of(a)?, of(b)?)
}
