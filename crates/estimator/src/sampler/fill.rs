//! Filling a batch with random numbers: samples of one estimate in a row, or of many estimates side by side.

use std::marker::PhantomData;

use twoforms_geometry::lanes::{Instructions, Kernel};
use twoforms_geometry::real::{Mask, Real, Word};

use super::{Place, Sampler, Spread};
use crate::numbers::{BATCH, Numbers, ROOM, Words};
use crate::philox::philox4x32_10;
use crate::xi::{Draws, Key};

/// Samples that lie side by side, at most.
pub const ROW: usize = 16;
/// Rows of a batch.
pub const ROWS: usize = BATCH / ROW;

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
        self.sampler.run(Along { stream: self, instructions, first, length, numbers });
    }

    /// ξ of one sample that takes so many pairs, at the batch's beginning.
    pub fn xi(&self, index: u32, pairs: usize) -> Numbers {
        let mut numbers = Numbers::new(pairs);
        self.fill(Instructions::SCALAR, index, 1, &mut numbers);
        numbers
    }
}

/// Many estimates side by side, each of which takes a part of a stream.
#[derive(Clone, Copy, Debug)]
pub struct Parts<'p> {
    /// How a stream is spread.
    pub sampler: Sampler,
    /// Who asks.
    pub key: Key,
    /// N: samples of a stream.
    pub n: u32,
    /// Samples of a part.
    pub each: u32,
    /// The stream of each estimate.
    pub streams: [&'p [u32]; 2],
    /// Which part of it the estimate takes.
    pub parts: &'p [u32],
}

/// One sample of each of [`ROW`] estimates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// The first of the estimates.
    pub from: usize,
    /// Which sample of each.
    pub index: u32,
}

impl Parts<'_> {
    /// Fills the batch with ξ of rows, one after the other.
    pub fn fill(&self, instructions: Instructions, rows: &[Row], numbers: &mut Numbers) {
        self.sampler.run(Across { parts: self, instructions, rows, numbers });
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
    length: usize,
    numbers: &'n mut Numbers,
}

struct Across<'s, 'n> {
    parts: &'s Parts<'s>,
    instructions: Instructions,
    rows: &'s [Row],
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
        let Along { stream: Stream { draws: Draws { key, stream }, n, .. }, first, length, numbers, .. } = self.0;
        let common = common(*key, *stream).map(R::Word::splat);
        let mut weights = weights::<S>(&mut numbers.weights);
        for (pair, Words([u, v])) in numbers.pairs.iter_mut().enumerate() {
            let (plan, seed) = (S::plan(*n, pair as u32), seed(*key, *stream, pair as u32).map(R::Word::splat));
            for offset in (0..length).step_by(R::LANES) {
                let place = Place { index: R::Word::counting(first + offset as u32), seed, common };
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
        let Across { parts, rows, numbers, .. } = self.0;
        let mut weights = weights::<S>(&mut numbers.weights);
        for (pair, Words([u, v])) in numbers.pairs.iter_mut().enumerate() {
            let plan = S::plan(parts.n, pair as u32);
            for lane in (0..ROW).step_by(R::LANES) {
                let mut seeds = Seeds::<R>::none();
                for (k, row) in rows.iter().enumerate() {
                    let (from, offset) = (row.from + lane, k * ROW + lane);
                    seeds.follow(parts, from, pair as u32);
                    let place =
                        Place { index: parts.index::<R>(from, row.index), seed: seeds.seed, common: seeds.common };
                    put::<S, R>(&plan, &place, [&mut u[offset..], &mut v[offset..]]);
                    if let Some(weights) = &mut weights {
                        S::weight::<R>(&plan, &place).store(&mut weights[offset..]);
                    }
                }
            }
        }
    }
}

impl Parts<'_> {
    /// Indices of this sample of the estimates from `from` on, in their streams.
    #[inline(always)]
    fn index<R: Real>(&self, from: usize, index: u32) -> R::Word {
        let first = R::Word::load(&self.parts[from..]).wrapping_mul(R::Word::splat(self.each));
        first.wrapping_add(R::Word::splat(index))
    }
}

/// The random words of streams side by side. Estimates that follow each other often share their streams.
struct Seeds<R: Real> {
    known: bool,
    streams: [R::Word; 2],
    seed: [R::Word; 4],
    common: [R::Word; 2],
}

impl<R: Real> Seeds<R> {
    #[inline(always)]
    fn none() -> Self {
        let zero = R::Word::splat(0);
        Self { known: false, streams: [zero; 2], seed: [zero; 4], common: [zero; 2] }
    }

    /// Moves on to the streams of the estimates from `from` on.
    #[inline(always)]
    fn follow(&mut self, parts: &Parts, from: usize, pair: u32) {
        let streams = [R::Word::load(&parts.streams[0][from..]), R::Word::load(&parts.streams[1][from..])];
        let other = !R::same(streams[0], self.streams[0]) | !R::same(streams[1], self.streams[1]);
        if !self.known || other.any() {
            (self.known, self.streams) = (true, streams);
            (self.seed, self.common) = (seed(parts.key, streams, pair), common(parts.key, streams));
        }
    }
}
