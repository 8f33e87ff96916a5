//! The plan of an experiment: its rows, and the tasks they are cut into.

use std::ops::Range;

use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::{Prepared, Strategy};

/// One row to be measured: a strategy, a sampler, and N.
pub(crate) struct Plan<'a> {
    pub(crate) prepared: &'a Prepared,
    pub(crate) sampler: Sampler,
    pub(crate) samples: u32,
}

impl Plan<'_> {
    pub(crate) fn pair(&self) -> (Strategy, Sampler) {
        (self.prepared.strategy(), self.sampler)
    }
}

/// Some replicates of one row at one receiver.
#[derive(Clone, Debug)]
pub(crate) struct Task {
    pub(crate) place: usize,
    pub(crate) plan: usize,
    pub(crate) replicates: Range<u32>,
}
