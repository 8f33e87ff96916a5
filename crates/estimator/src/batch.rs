//! Samples that are evaluated together.

use twoforms_geometry::real::{Real, Word};
use twoforms_geometry::view::Vantage;

use crate::estimator::{Primary, Worth};
use crate::numbers::{BATCH, Numbers};
use crate::rgb::Rgb;
use crate::sampler::ROW;

/// Some samples: their ξ, where they look from, what they are worth, RGB, and the rays they asked for. Arrays have one entry a
/// sample, and stand on lines of the cache.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct Batch {
    /// Where they look from, in metres in the frame of x.
    pub start: [[f32; BATCH]; 3],
    /// What they are worth, RGB.
    pub worth: [[f32; BATCH]; 3],
    /// What they add to the divisor of a quotient, RGB.
    pub divisor: [[f32; BATCH]; 3],
    /// Which samples count: 1, or 0.
    pub wanted: [u32; BATCH],
    /// Rays asked for.
    pub rays: [u32; BATCH],
    /// ξ.
    pub numbers: Numbers,
    /// How many samples there are, or room for more up to a multiple of what lies side by side.
    pub length: usize,
    /// Whether samples look from points of a footprint, or all from x.
    pub from_points: bool,
}

impl Batch {
    /// Room for samples that take so many pairs of random numbers, all from x and wanted.
    #[inline]
    pub fn new(pairs: usize) -> Self {
        Self {
            numbers: Numbers::new(pairs),
            length: 0,
            wanted: [1; BATCH],
            from_points: false,
            start: [[0.0; BATCH]; 3],
            worth: [[0.0; BATCH]; 3],
            divisor: [[0.0; BATCH]; 3],
            rays: [0; BATCH],
        }
    }

    /// Makes room for samples that take so many pairs of random numbers, all from x.
    pub(crate) fn empty(&mut self, pairs: usize) {
        self.numbers.fit(pairs);
        self.from_points = false;
    }

    /// Wants the first samples, so many, and of the row that they end in no more.
    pub(crate) fn want(&mut self, length: usize) {
        self.length = length;
        self.wanted[..length].fill(1);
        self.wanted[length..length.next_multiple_of(ROW)].fill(0);
    }

    /// Those of the last row that are beyond the samples are worth nothing.
    pub(crate) fn round_up(&mut self) {
        for channel in &mut self.worth {
            channel[self.length..self.length.next_multiple_of(ROW)].fill(0.0);
        }
    }

    /// Samples that lie side by side, from `offset` on.
    #[inline(always)]
    pub(crate) fn evaluate<R: Real, P: Primary>(&mut self, primary: &P, from: Vantage<R>, offset: usize) {
        let from = from.only(R::same(R::Word::load(&self.wanted[offset..]), R::Word::splat(1)));
        let drawn = self.numbers.from(offset);
        let Worth { value, rays } = primary.primary(&from, drawn);
        let Rgb(mut worth) = value.or_black(from.wanted());
        if let Some(weight) = drawn.weight::<R>() {
            worth = [worth[0] * weight, worth[1] * weight, worth[2] * weight];
        }
        if P::QUOTIENT {
            let Rgb(divisor) = primary.divisor(&from, drawn);
            for c in 0..3 {
                divisor[c].store(&mut self.divisor[c][offset..]);
            }
        }
        for c in 0..3 {
            worth[c].store(&mut self.worth[c][offset..]);
        }
        rays.store(&mut self.rays[offset..]);
    }
}
