//! The random numbers of a pixel.

use twoforms_estimator::numbers::Numbers;
use twoforms_estimator::sampler::{Row, Sampler, Stream};
use twoforms_estimator::xi::{Draws, Key};
use twoforms_geometry::lanes::Instructions;

/// The samples of a pixel, one set of points, shared out among its camera samples.
#[derive(Clone, Copy)]
pub(super) struct Samples {
    pub(super) sampler: Sampler,
    pub(super) key: Key,
    /// How many of the pixel's samples each camera sample has.
    pub(super) each: u32,
    /// Camera samples of a pixel.
    pub(super) spp: u32,
    pub(super) instructions: Instructions,
}

impl Samples {
    /// The stream of a pixel, from the pixel's number and one of its camera samples.
    pub(super) fn stream(&self, [pixel, _]: [u32; 2]) -> Stream {
        let draws = Draws { key: self.key, stream: [pixel, 0] };
        Stream { sampler: self.sampler, draws, n: self.spp * self.each }
    }

    /// Fills the batch with ξ of a row of camera samples, one each.
    pub(super) fn fill(&self, row: &Row, numbers: &mut Numbers) {
        row.fill(self.sampler, self.instructions, 1, numbers);
    }
}
