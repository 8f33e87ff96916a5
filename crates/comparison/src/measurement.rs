//! What replicates of one row come to.

use std::ops::Range;

use twoforms_estimator::batch::Batch;
use twoforms_estimator::estimate::{self, NotFinite};
use twoforms_estimator::estimator::Estimator;
use twoforms_estimator::moments::Moments;
use twoforms_estimator::query::Query;
use twoforms_estimator::rgb::luminance;
use twoforms_estimator::sampler::Stream;
use twoforms_estimator::secondary::secondary_in;
use twoforms_estimator::strategy::Known;
use twoforms_estimator::xi::{Draws, Key};
use twoforms_geometry::view::View;

use crate::clock;
use crate::plan::{Plan, Task};

/// All that is kept of the replicates of one row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Measurement {
    /// Luminance of each replicate's estimate.
    pub(crate) estimates: Vec<f64>,
    /// Sum of the replicates' estimates, RGB.
    pub(crate) total: [f64; 3],
    /// Moments of single samples' luminances over all replicates.
    pub(crate) one: Moments,
    /// Rays asked for.
    pub(crate) rays: u64,
    /// Samples that were not zero.
    pub(crate) hits: u64,
    /// Range of the samples that were not zero.
    pub(crate) range: estimate::Range,
    /// CPU seconds.
    pub(crate) seconds: f64,
    /// What it takes to make the estimator at x, once.
    pub(crate) setup: Setup,
}

/// What it takes to make an estimator, which every task does anew.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Setup {
    seconds: f64,
    times: u32,
    /// Rays asked for, each time the same.
    pub(crate) rays: u64,
}

impl Setup {
    /// CPU seconds, once.
    pub(crate) fn seconds(&self) -> f64 {
        self.seconds / f64::from(self.times.max(1))
    }
}

impl Measurement {
    /// Measures the replicates of `task`; the error names the replicate.
    pub(crate) fn of(
        plan: &Plan,
        view: &View,
        query: &Query,
        known: &Known,
        emission: [f64; 3],
        key: Key,
        task: &Task,
    ) -> Result<Self, (u32, NotFinite)> {
        let (estimator, seconds) = clock::timed(|| plan.prepared.at(view, query, known));
        let setup = Setup { seconds, times: 1, rays: estimator.setup_rays() };
        let replicates = Replicates { plan, estimator: &*estimator, key, range: task.replicates.clone(), emission };
        let (measured, seconds) = clock::timed(|| replicates.measure());
        Ok(Self { seconds, setup, ..measured? })
    }

    /// Appends what the next replicates came to; they are appended in order.
    pub(crate) fn add(&mut self, next: Self) {
        self.estimates.extend(next.estimates);
        self.total = std::array::from_fn(|c| self.total[c] + next.total[c]);
        self.one = self.one + next.one;
        self.rays += next.rays;
        self.hits += next.hits;
        self.range = self.range.with(next.range);
        self.seconds += next.seconds;
        let [one, other] = [self.setup, next.setup];
        let (seconds, times) = (one.seconds + other.seconds, one.times + other.times);
        self.setup = Setup { seconds, times, rays: one.rays.max(other.rays) };
    }

    /// Pools the single samples of another row: their moments, hits and range.
    pub(crate) fn with_samples_of(self, row: &Self) -> Self {
        let (one, hits) = (self.one + row.one, self.hits + row.hits);
        Self { one, hits, range: self.range.with(row.range), ..self }
    }

    fn push(&mut self, estimate: &estimate::Estimate, emission: [f64; 3]) {
        let value: [f64; 3] = std::array::from_fn(|c| estimate.value[c] + emission[c]);
        self.estimates.push(luminance(value));
        self.total = std::array::from_fn(|c| self.total[c] + value[c]);
        self.one = self.one + estimate.luminance;
        self.rays += estimate.rays;
        self.hits += estimate.hits;
        self.range = self.range.with(estimate.range);
    }
}

struct Replicates<'a> {
    plan: &'a Plan<'a>,
    estimator: &'a dyn Estimator,
    key: Key,
    range: Range<u32>,
    emission: [f64; 3],
}

impl Replicates<'_> {
    fn measure(self) -> Result<Measurement, (u32, NotFinite)> {
        let Plan { sampler, samples, .. } = *self.plan;
        let (mut measurement, mut batch) = (Measurement::default(), Batch::new(self.estimator.pairs()));
        for replicate in self.range {
            let draws = Draws { key: self.key, stream: [samples, replicate] };
            let stream = Stream { sampler, draws, n: samples };
            let estimate = secondary_in(&mut batch, self.estimator, stream, 0..samples);
            let estimate = estimate.map_err(|not_finite| (replicate, not_finite))?;
            measurement.push(&estimate, self.emission);
        }
        Ok(measurement)
    }
}
