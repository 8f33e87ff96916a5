//! The light that camera samples receive where they meet one pane.

use std::ops::Range;

use twoforms_estimator::batch::Batch;
use twoforms_estimator::estimator::Estimator;
use twoforms_estimator::numbers::BATCH;
use twoforms_geometry::lanes::Kernel;
use twoforms_geometry::real::Real;
use twoforms_geometry::vector::Vector;
use twoforms_geometry::wide::EIGHT;

use super::chunk::{Chunk, SIZE};
use super::samples::Samples;

/// The light samples of the camera samples that meet one pane, from where they meet it.
pub(super) struct Receive<'e> {
    pub(super) estimator: &'e dyn Estimator,
    pub(super) light: Samples,
    pub(super) pane: u32,
    /// The vectors that give the coordinates of a point of the pane from its direction.
    pub(super) along: [[f32; 3]; 2],
}

/// Light samples evaluated together.
struct Together {
    batch: Batch,
    blocks: Vec<Block>,
    /// Sums over the light samples of each camera sample, RGB, of an estimate that is a quotient: worths, and divisors.
    quotients: Option<[Vec<[f64; SIZE]>; 2]>,
}

/// Consecutive light samples of consecutive camera samples of one pixel.
struct Block {
    /// The first camera sample.
    first: usize,
    /// Light samples before these, from the first of that camera sample on.
    done: usize,
    /// Where they are in the batch.
    places: Range<usize>,
}

impl Block {
    /// The camera samples, with the places of their light samples.
    fn camera_samples(&self, each: usize) -> impl Iterator<Item = (usize, Range<usize>)> + use<> {
        let Self { first, done, places: Range { start, end } } = *self;
        let last = done + end - start;
        (done / each..last.div_ceil(each)).map(move |index| {
            let from = (index * each).max(done);
            let to = ((index + 1) * each).min(last);
            (first + index, start + from - done..start + to - done)
        })
    }
}

impl Receive<'_> {
    /// Samples the lights for all of the chunk that meets the pane.
    pub(super) fn all(&self, chunk: &mut Chunk) {
        let start = self.light.instructions.run(LookFrom { chunk, along: self.along });
        let mut together = Together::new(self.estimator);
        for piece in 0..chunk.pieces.len() {
            for met in self.met(chunk, chunk.pieces[piece].places()) {
                self.run(chunk, &start, met, &mut together);
            }
        }
        self.evaluate(chunk, &mut together);
        if let Some(sums) = together.quotients {
            for k in chunk.that_meet(self.pane).collect::<Vec<_>>() {
                let of = |sums: &Vec<[f64; SIZE]>| [sums[0][k], sums[1][k], sums[2][k]];
                let [sum, divisor] = sums.each_ref().map(of);
                chunk.add(k, self.estimator.estimate(sum, divisor, self.light.each), 0);
            }
        }
    }

    /// The runs of consecutive camera samples among these that meet the pane.
    fn met(&self, chunk: &Chunk, places: Range<usize>) -> Vec<Range<usize>> {
        let mut runs: Vec<Range<usize>> = Vec::new();
        for k in places.filter(|&k| chunk.pane(k) == Some(self.pane as usize)) {
            match runs.last_mut() {
                Some(run) if run.end == k => run.end += 1,
                _ => runs.push(k..k + 1),
            }
        }
        runs
    }

    /// The light samples of consecutive camera samples of one pixel, which follow each other in the pixel's stream.
    fn run(&self, chunk: &mut Chunk, start: &[[f32; SIZE]; 2], met: Range<usize>, together: &mut Together) {
        let (stream, each) = (self.light.stream(chunk.stream(met.start)), self.light.each as usize);
        let first = chunk.stream(met.start)[1] * self.light.each;
        let (mut done, all) = (0, met.len() * each);
        while done < all {
            if together.batch.length == BATCH {
                self.evaluate(chunk, together);
            }
            let offset = together.batch.length;
            let length = (BATCH - offset).min(all - done);
            let block = Block { first: met.start, done, places: offset..offset + length };
            let places = block.places.clone();
            stream.fill_at(self.light.instructions, first + done as u32, places, &mut together.batch.numbers);
            together.push(block, each, start);
            done += length;
        }
    }

    /// Evaluates what has been put together, and adds it up.
    fn evaluate(&self, chunk: &mut Chunk, together: &mut Together) {
        let (each, share) = (self.light.each as usize, 1.0 / f64::from(self.light.each));
        let Together { batch, blocks, quotients } = together;
        batch.wanted[..batch.length].fill(1);
        batch.wanted[batch.length..].fill(0);
        self.estimator.evaluate(self.light.instructions, batch);
        for block in blocks.drain(..) {
            match quotients {
                None if each == 1 => chunk.take_over(block.first + block.done, batch, block.places),
                None => {
                    for (k, places) in block.camera_samples(each) {
                        chunk.rays[k] += batch.rays[places.clone()].iter().sum::<u32>();
                        for c in 0..3 {
                            chunk.value[c][k] += total(&batch.worth[c][places.clone()]) * share;
                        }
                    }
                }
                Some(sums) => {
                    for (k, places) in block.camera_samples(each) {
                        chunk.rays[k] += batch.rays[places.clone()].iter().sum::<u32>();
                        for c in 0..3 {
                            sums[0][c][k] += total(&batch.worth[c][places.clone()]);
                            sums[1][c][k] += total(&batch.divisor[c][places.clone()]);
                        }
                    }
                }
            }
        }
        batch.length = 0;
    }
}

impl Chunk {
    /// Adds what samples of a batch are worth to consecutive camera samples with one light sample each.
    fn take_over(&mut self, first: usize, batch: &Batch, places: Range<usize>) {
        let taken = first..first + places.len();
        for (sum, rays) in self.rays[taken.clone()].iter_mut().zip(&batch.rays[places.clone()]) {
            *sum += rays;
        }
        for c in 0..3 {
            for (value, worth) in self.value[c][taken.clone()].iter_mut().zip(&batch.worth[c][places.clone()]) {
                *value += f64::from(*worth);
            }
        }
    }
}

impl Together {
    fn new(estimator: &dyn Estimator) -> Self {
        let mut batch = Batch::new(estimator.pairs());
        batch.from_points = true;
        let quotients = estimator.is_quotient().then(|| [0, 1].map(|_| vec![[0.0; SIZE]; 3]));
        Self { batch, blocks: Vec::new(), quotients }
    }

    /// Puts in a block of camera samples with so many light samples each, which look from `start`.
    fn push(&mut self, block: Block, each: usize, start: &[[f32; SIZE]; 2]) {
        if each == 1 {
            let from = block.first + block.done;
            for c in 0..2 {
                let start = &start[c][from..from + block.places.len()];
                self.batch.start[c][block.places.clone()].copy_from_slice(start);
            }
        } else {
            for (k, places) in block.camera_samples(each) {
                for c in 0..2 {
                    self.batch.start[c][places.clone()].fill(start[c][k]);
                }
            }
        }
        self.batch.length = block.places.end;
        self.blocks.push(block);
    }
}

/// The sum of numbers, in eight partial sums.
fn total(values: &[f32]) -> f64 {
    let mut parts = [0.0; EIGHT];
    let (eights, rest) = values.as_chunks::<EIGHT>();
    for eight in eights {
        for k in 0..EIGHT {
            parts[k] += f64::from(eight[k]);
        }
    }
    parts.iter().sum::<f64>() + rest.iter().map(|&value| f64::from(value)).sum::<f64>()
}

/// Where the camera samples of a chunk would meet a pane, in the frame of the view from it; its third coordinate is zero.
struct LookFrom<'c> {
    chunk: &'c Chunk,
    along: [[f32; 3]; 2],
}

impl Kernel for LookFrom<'_> {
    type Output = [[f32; SIZE]; 2];

    #[inline(always)]
    fn run<R: Real>(self) -> [[f32; SIZE]; 2] {
        let Self { chunk, along } = self;
        let mut start = [[0.0; SIZE]; 2];
        for k in (0..chunk.len()).step_by(R::LANES) {
            let (toward, per_t) = chunk.direction::<R>(k);
            let t = R::one() / per_t;
            for c in 0..2 {
                (Vector::splat(along[c]).dot(toward) * t).store(&mut start[c][k..]);
            }
        }
        start
    }
}
