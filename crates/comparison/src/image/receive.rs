//! The light that camera samples receive where they meet one pane.

use twoforms_estimator::batch::Batch;
use twoforms_estimator::estimator::Estimator;
use twoforms_estimator::sampler::{ROW, ROWS, Row};
use twoforms_geometry::lanes::Kernel;
use twoforms_geometry::real::{Real, Word};
use twoforms_geometry::vector::Vector;
use twoforms_geometry::wide::{EIGHT, Wide};

use super::chunk::Chunk;
use super::samples::Samples;

/// The light samples of the camera samples that meet one pane, from where they meet it.
pub(super) struct Receive<'e> {
    pub(super) estimator: &'e dyn Estimator,
    pub(super) light: Samples,
    pub(super) pane: u32,
    /// The vectors that give the coordinates of a point of the pane from its direction.
    pub(super) along: [[f32; 3]; 2],
}

impl Receive<'_> {
    /// Samples the lights for all of the chunk that meets the pane. Camera samples lie side by side, and each row of them takes
    /// one light sample after the other.
    pub(super) fn all(&self, chunk: &mut Chunk, batch: &mut Batch) {
        debug_assert!(!self.estimator.is_quotient(), "quotients are of one x each");
        batch.from_points = true;
        let (mut rows, mut open) = (Vec::with_capacity(ROWS), [[0.0; ROW]; 3]);
        for from in chunk.rows_that_meet(self.pane).collect::<Vec<_>>() {
            for index in 0..self.light.each {
                rows.push(Row { from, index });
                if rows.len() == ROWS {
                    self.evaluate(chunk, &rows, batch, &mut open);
                    rows.clear();
                }
            }
        }
        self.evaluate(chunk, &rows, batch, &mut open);
    }

    /// Evaluates some rows, and adds them up.
    fn evaluate(&self, chunk: &mut Chunk, rows: &[Row], batch: &mut Batch, open: &mut Sums) {
        let Samples { instructions, each, .. } = self.light;
        batch.length = rows.len() * ROW;
        instructions.run(LookFrom { chunk, pane: self.pane, along: self.along, rows, batch });
        self.light.fill(chunk.streams(), rows, &mut batch.numbers);
        self.estimator.evaluate(instructions, batch);
        instructions.run(Add { chunk, rows, batch, each, open });
    }
}

/// Which camera samples of some rows meet a pane, and where, in the frame of the view from it; the third coordinate is zero.
struct LookFrom<'c> {
    chunk: &'c Chunk,
    pane: u32,
    along: [[f32; 3]; 2],
    rows: &'c [Row],
    batch: &'c mut Batch,
}

impl Kernel for LookFrom<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real>(self) {
        let Self { chunk, pane, along, rows, batch } = self;
        for lane in (0..ROW).step_by(R::LANES) {
            let (mut last, mut start, mut meets) = (None, [R::zero(); 2], R::Word::splat(0));
            for (k, row) in rows.iter().enumerate() {
                if last != Some(row.from) {
                    let (toward, per_t) = chunk.direction::<R>(row.from + lane);
                    let t = R::one() / per_t;
                    start = [Vector::splat(along[0]).dot(toward) * t, Vector::splat(along[1]).dot(toward) * t];
                    meets = chunk.meets::<R>(row.from + lane, pane);
                    last = Some(row.from);
                }
                let offset = k * ROW + lane;
                start[0].store(&mut batch.start[0][offset..]);
                start[1].store(&mut batch.start[1][offset..]);
                meets.store(&mut batch.wanted[offset..]);
            }
        }
    }
}

/// Sums over light samples of the camera samples in a row, RGB.
type Sums = [[f64; ROW]; 3];

/// Adds up rows of light samples; where a row of camera samples has all of its own, their mean joins the values.
struct Add<'c> {
    chunk: &'c mut Chunk,
    rows: &'c [Row],
    batch: &'c Batch,
    /// Light samples of each camera sample.
    each: u32,
    /// The sums of the row of camera samples that is not complete.
    open: &'c mut Sums,
}

impl Kernel for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real>(self) {
        let Self { chunk, rows, batch, each, open } = self;
        let mut offset = 0;
        for same in rows.chunk_by(|one, next| one.from == next.from) {
            let (from, end) = (same[0].from, offset + same.len() * ROW);
            let (begins, ends) = (same[0].index == 0, same[same.len() - 1].index + 1 == each);
            for c in 0..3 {
                for k in (0..ROW).step_by(EIGHT) {
                    let mut sum = if begins { R::Wide::splat(0.0) } else { R::Wide::load(&open[c][k..]) };
                    for row in (offset..end).step_by(ROW) {
                        sum = sum + R::Wide::widen(&batch.worth[c][row + k..]);
                    }
                    if ends {
                        let value = &mut chunk.value[c][from + k..];
                        (R::Wide::load(value) + sum * R::Wide::splat(1.0 / f64::from(each))).store(value);
                    } else {
                        sum.store(&mut open[c][k..]);
                    }
                }
            }
            for k in (0..ROW).step_by(R::LANES) {
                let mut sum = R::Word::load(&chunk.rays[from + k..]);
                for row in (offset..end).step_by(ROW) {
                    sum = sum.wrapping_add(R::Word::load(&batch.rays[row + k..]));
                }
                sum.store(&mut chunk.rays[from + k..]);
            }
            offset = end;
        }
    }
}
