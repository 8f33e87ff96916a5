//! The light that camera samples receive where they meet one pane.

use std::ops::Range;

use twoforms_estimator::batch::Batch;
use twoforms_estimator::estimator::Estimator;
use twoforms_estimator::numbers::BATCH;
use twoforms_geometry::lanes::Kernel;
use twoforms_geometry::real::{Real, Word};
use twoforms_geometry::vector::Vector;

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

/// Light samples evaluated together: runs of them, each for one camera sample.
struct Together {
    batch: Batch,
    /// Camera samples with their light samples' places in the batch.
    runs: Vec<(usize, Range<usize>)>,
    /// Sums over the light samples of each camera sample, RGB: worths, and what they add to a divisor.
    sums: [[[f64; SIZE]; 3]; 2],
}

impl Receive<'_> {
    /// Samples the lights for all of the chunk that meets the pane.
    pub(super) fn all(&self, chunk: &mut Chunk) {
        let start = self.light.instructions.run(LookFrom { chunk, along: self.along });
        let mut together = Together::new(self.estimator.pairs());
        for piece in 0..chunk.pieces.len() {
            for met in self.met(chunk, chunk.pieces[piece].places()) {
                self.run(chunk, &start, met, &mut together);
            }
        }
        self.evaluate(chunk, &mut together);
        for k in chunk.that_meet(self.pane).collect::<Vec<_>>() {
            let of = |sums: &[[f64; SIZE]; 3]| [sums[0][k], sums[1][k], sums[2][k]];
            let [sum, divisor] = together.sums.each_ref().map(of);
            chunk.add(k, self.estimator.estimate(sum, divisor, self.light.each), 0);
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
            let instructions = self.light.instructions;
            stream.fill_at(instructions, first + done as u32, offset..offset + length, &mut together.batch.numbers);
            together.push(met.start, done, each, length, start);
            done += length;
        }
    }

    /// Evaluates what has been put together, and adds it up.
    fn evaluate(&self, chunk: &mut Chunk, together: &mut Together) {
        let Together { batch, runs, sums: [worths, divisors] } = together;
        let used = batch.length;
        batch.wanted[..used].fill(1);
        batch.wanted[used..].fill(0);
        self.estimator.evaluate(self.light.instructions, batch);
        for (k, places) in runs.drain(..) {
            add(worths, k, &batch.worth, places.clone());
            if self.estimator.is_quotient() {
                add(divisors, k, &batch.divisor, places.clone());
            }
            chunk.add(k, [0.0; 3], batch.rays[places].iter().sum());
        }
        batch.length = 0;
    }
}

impl Together {
    fn new(pairs: usize) -> Box<Self> {
        let mut batch = Batch::new(pairs);
        batch.from_points = true;
        Box::new(Self { batch, runs: Vec::new(), sums: [[[0.0; SIZE]; 3]; 2] })
    }

    /// Puts in `length` light samples from the `done`-th on of consecutive camera samples with so many each.
    fn push(&mut self, first: usize, done: usize, each: usize, length: usize, start: &[[f32; SIZE]; 2]) {
        let end = done + length;
        for index in done / each..end.div_ceil(each) {
            let from = self.batch.length + (index * each).max(done) - done;
            let to = self.batch.length + ((index + 1) * each).min(end) - done;
            for c in 0..2 {
                self.batch.start[c][from..to].fill(start[c][first + index]);
            }
            self.runs.push((first + index, from..to));
        }
        self.batch.length += length;
    }
}

/// Adds what some places of a batch hold to the sum of a camera sample.
fn add(sums: &mut [[f64; SIZE]; 3], k: usize, values: &[[f32; BATCH]; 3], places: Range<usize>) {
    for c in 0..3 {
        sums[c][k] += values[c][places.clone()].iter().map(|&value| f64::from(value)).sum::<f64>();
    }
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
