//! Filling a batch with random numbers: samples of one estimate in a row, or of many estimates side by side.

use std::marker::PhantomData;
use std::ops::Range;

use twoforms_geometry::lanes::{Instructions, Kernel};
use twoforms_geometry::real::{Real, Word};

use super::{Place, Sampler, Spread};
use crate::numbers::{Numbers, ROOM};
use crate::philox::philox4x32_10;
use crate::xi::{Draws, Key};

/// Estimates that lie side by side, at most.
pub const ROW: usize = 16;

/// The random numbers of one estimate, as a sampler spreads them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stream {
    /// How they are spread.
    pub sampler: Sampler,
    /// Which they are.
    pub draws: Draws,
    /// N: samples of the estimate.
    pub n: u32,
}

impl Stream {
    /// Fills the batch with ξ of `length` samples from `first` on.
    pub fn fill(&self, instructions: Instructions, first: u32, length: usize, numbers: &mut Numbers) {
        self.fill_at(instructions, first, 0..length, numbers);
    }

    /// Fills places of the batch with ξ of as many samples from `first` on; what follows the places is written to as well.
    pub fn fill_at(&self, instructions: Instructions, first: u32, places: Range<usize>, numbers: &mut Numbers) {
        self.sampler.run(Along { stream: self, instructions, first, places, numbers });
    }

    /// ξ of one sample that takes so many pairs, at the batch's beginning.
    pub fn xi(&self, index: u32, pairs: usize) -> Numbers {
        let mut numbers = Numbers::new(pairs);
        self.fill(Instructions::SCALAR, index, 1, &mut numbers);
        numbers
    }
}

/// Samples of many estimates side by side, each with a stream and an index of its own.
#[derive(Clone, Debug)]
pub struct Row {
    /// Who asks.
    pub key: Key,
    /// N of each estimate.
    pub n: u32,
    /// The streams.
    pub streams: [[u32; ROW]; 2],
    /// Index of each one's first sample.
    pub first: [u32; ROW],
}

impl Row {
    /// Fills the batch with ξ of these samples, then of the next index of each, and so on, for `length` indices: the
    /// i-th index of sample k lies at i × [`ROW`] + k.
    pub fn fill(&self, sampler: Sampler, instructions: Instructions, length: usize, numbers: &mut Numbers) {
        sampler.run(Across { row: self, instructions, length, numbers });
    }
}

/// Something to do with a sampler, whichever it is.
pub(super) trait Fill {
    fn run<S: Spread>(self);
}

struct Along<'s, 'n> {
    stream: &'s Stream,
    instructions: Instructions,
    first: u32,
    places: Range<usize>,
    numbers: &'n mut Numbers,
}

struct Across<'s, 'n> {
    row: &'s Row,
    instructions: Instructions,
    length: usize,
    numbers: &'n mut Numbers,
}

/// A way to fill with its sampler chosen.
struct By<F, S>(F, PhantomData<S>);

impl Fill for Along<'_, '_> {
    fn run<S: Spread>(self) {
        self.instructions.run(By(self, PhantomData::<S>));
    }
}

impl Fill for Across<'_, '_> {
    fn run<S: Spread>(self) {
        self.instructions.run(By(self, PhantomData::<S>));
    }
}

/// Random words of a stream and pair: Philox 4×32-10 of the two.
#[inline(always)]
fn seed<W: Word>(key: Key, [one, other]: [W; 2], pair: u32) -> [W; 4] {
    philox4x32_10([W::splat(pair), W::splat(0), one, other], key.0)
}

/// Random words of a stream for all of its pairs.
#[inline(always)]
fn common<W: Word>(key: Key, [one, other]: [W; 2]) -> [W; 2] {
    let [a, b, ..] = philox4x32_10([W::splat(0), W::splat(1), one, other], key.0);
    [a, b]
}

/// The weights to fill, all of them 1 so far; nothing where samples count alike.
fn weights<S: Spread>(weights: &mut Option<Box<[f32; ROOM]>>) -> Option<&mut [f32; ROOM]> {
    if S::WEIGHTED {
        Some(&mut **weights.get_or_insert_with(|| Box::new([1.0; ROOM])))
    } else {
        *weights = None;
        None
    }
}

/// Writes the words at a place.
#[inline(always)]
fn put<S: Spread, R: Real>(plan: &S::Plan, place: &Place<R>, [u, v]: [&mut [u32]; 2]) {
    let [one, other] = S::pair::<R>(plan, place);
    one.store(u);
    other.store(v);
}

impl<S: Spread> Kernel for By<Along<'_, '_>, S> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real>(self) {
        let Along { stream: Stream { draws: Draws { key, stream }, n, .. }, first, places, numbers, .. } = self.0;
        let common = common(*key, *stream).map(R::Word::splat);
        let mut weights = weights::<S>(&mut numbers.weights);
        for (pair, [u, v]) in numbers.pairs.iter_mut().enumerate() {
            let (plan, seed) = (S::plan(*n, pair as u32), seed(*key, *stream, pair as u32).map(R::Word::splat));
            for offset in places.clone().step_by(R::LANES) {
                let place = Place { index: R::Word::counting(first + (offset - places.start) as u32), seed, common };
                put::<S, R>(&plan, &place, [&mut u[offset..], &mut v[offset..]]);
                if let Some(weights) = &mut weights {
                    S::weight::<R>(&plan, &place).store(&mut weights[offset..]);
                }
            }
        }
    }
}

impl<S: Spread> Kernel for By<Across<'_, '_>, S> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real>(self) {
        let Across { row: Row { key, n, streams, first }, length, numbers, .. } = self.0;
        let mut weights = weights::<S>(&mut numbers.weights);
        for lane in (0..ROW).step_by(R::LANES) {
            let streams = [R::Word::load(&streams[0][lane..]), R::Word::load(&streams[1][lane..])];
            let (common, first) = (common(*key, streams), R::Word::load(&first[lane..]));
            for (pair, [u, v]) in numbers.pairs.iter_mut().enumerate() {
                let (plan, seed) = (S::plan(*n, pair as u32), seed(*key, streams, pair as u32));
                for index in 0..length {
                    let offset = index * ROW + lane;
                    let place = Place { index: first.wrapping_add(R::Word::splat(index as u32)), seed, common };
                    put::<S, R>(&plan, &place, [&mut u[offset..], &mut v[offset..]]);
                    if let Some(weights) = &mut weights {
                        S::weight::<R>(&plan, &place).store(&mut weights[offset..]);
                    }
                }
            }
        }
    }
}
