//! What single samples are worth.

use twoforms_comparison::exactly;
use twoforms_comparison::place::Place;
use twoforms_estimator::batch::Batch;
use twoforms_estimator::estimator::Estimator;
use twoforms_estimator::moments::Moments;
use twoforms_estimator::numbers::BATCH;
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::{Sampler, Stream};
use twoforms_estimator::strategy::{Known, Strategy};
use twoforms_estimator::xi::{Draws, Key, Xi};
use twoforms_geometry::lanes::Instructions;
use twoforms_geometry::view::{Effort, View};

use crate::worlds::Case;

/// The first n samples of an estimate, RGB, in order.
#[derive(Clone, Copy, Debug)]
pub struct Samples {
    /// How ξ are spread.
    pub sampler: Sampler,
    /// Which ξ.
    pub draws: Draws,
    /// How many.
    pub n: u32,
}

impl Samples {
    /// Samples keyed by seed, place, density and sampler.
    pub fn new(seed: u64, place: &Place, strategy: Strategy, sampler: Sampler, n: u32) -> Self {
        let names = format!("{}\n{sampler}", strategy.density_name());
        let words: Vec<u64> = [seed].into_iter().chain(place.bits()).chain(Key::words_of(&names)).collect();
        Self { sampler, draws: Draws { key: Key::new(words), stream: [n, 0] }, n }
    }

    /// The first pair of ξ of one of them.
    pub fn xi(&self, index: u32) -> Xi<f32> {
        self.stream().xi(index, 1).from(0).xi(0)
    }

    fn stream(&self) -> Stream {
        Stream { sampler: self.sampler, draws: self.draws, n: self.n }
    }
}

impl Samples {
    /// What the samples are worth, by the scalar numbers.
    pub fn of(&self, estimator: &dyn Estimator) -> Vec<[f32; 3]> {
        let mut batch = Batch::new(estimator.pairs());
        let mut worths = Vec::with_capacity(self.n as usize);
        for first in (0..self.n).step_by(BATCH) {
            batch.length = BATCH.min((self.n - first) as usize);
            self.stream().fill(Instructions::SCALAR, first, batch.length, &mut batch.numbers);
            estimator.evaluate(Instructions::SCALAR, &mut batch);
            worths.extend((0..batch.length).map(|k| batch.worth.map(|channel| channel[k])));
        }
        worths
    }
}

/// What n samples of a strategy are worth at a receiver, as irradiance.
pub fn samples(case: &Case, strategy: Strategy, sampler: Sampler, n: u32, seed: u64) -> Vec<[f32; 3]> {
    let world = &case.stage.world;
    let view = View::new(&world.geometry, case.place.frame(), Effort::Gather);
    let (query, prepared) = (Query::irradiance(&world.lights), strategy.prepare(&world.lights));
    Samples::new(seed, &case.place, strategy, sampler, n).of(&*prepared.at(&view, &query, &known(case, strategy)))
}

/// What a strategy may know beforehand at a receiver.
pub fn known(case: &Case, strategy: Strategy) -> Known {
    let asked: Vec<Strategy> = Some(strategy).into_iter().filter(|strategy| strategy.needs_alpha().is_some()).collect();
    exactly::at(&case.stage.world, &case.place, &asked).known()
}

/// The moments of one channel.
pub fn moments(samples: &[[f32; 3]], channel: usize) -> Moments {
    let values: Vec<f64> = samples.iter().map(|worth| f64::from(worth[channel])).collect();
    Moments::of(&values)
}
