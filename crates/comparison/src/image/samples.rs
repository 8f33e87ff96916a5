//! The random numbers of a pixel.

use twoforms_estimator::numbers::Numbers;
use twoforms_estimator::sampler::{Parts, Row, Sampler, Stream};
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

    /// Fills the batch with ξ of rows of camera samples, of which the pixels' numbers and places among their samples are given.
    pub(super) fn fill<const SIZE: usize>(
        &self,
        [pixels, parts]: [&[u32; SIZE]; 2],
        rows: &[Row],
        numbers: &mut Numbers,
    ) {
        let Self { sampler, key, each, spp, instructions } = *self;
        let streams: [&[u32]; 2] = [pixels, &[0; SIZE]];
        Parts { sampler, key, n: spp * each, each, streams, parts }.fill(instructions, rows, numbers);
    }
}
