//! The secondary estimator: the mean of N samples.

use std::ops::Range;

use twoforms_geometry::lanes::{Instructions, Kernel};
use twoforms_geometry::real::Real;
use twoforms_geometry::wide::{EIGHT, Wide};

use crate::batch::Batch;
use crate::estimate::{self, Estimate, NotFinite};
use crate::estimator::Estimator;
use crate::moments::Moments;
use crate::numbers::BATCH;
use crate::rgb::LUMINANCE;
use crate::sampler::Stream;

/// ⟨I⟩_sec = (1/N) Σ ⟨I⟩_prim, with ξ_i from `stream`, by the best instructions of this machine.
///
/// # Errors
/// When a sample is not finite.
pub fn secondary(estimator: &dyn Estimator, stream: Stream) -> Result<Estimate, NotFinite> {
    secondary_in(&mut Batch::new(estimator.pairs()), estimator, stream, 0..stream.n)
}

/// The mean of some of the N samples in a batch that is there already, whatever it has held: for many estimates.
///
/// # Errors
/// When a sample is not finite.
pub fn secondary_in(
    batch: &mut Batch,
    estimator: &dyn Estimator,
    stream: Stream,
    samples: Range<u32>,
) -> Result<Estimate, NotFinite> {
    sum(batch, estimator, Instructions::best(), stream, samples)
}

/// The mean of some of the N samples, by these instructions. The bits do not depend on them.
///
/// # Errors
/// When a sample is not finite.
pub fn secondary_by(
    estimator: &dyn Estimator,
    instructions: Instructions,
    stream: Stream,
    samples: Range<u32>,
) -> Result<Estimate, NotFinite> {
    sum(&mut Batch::new(estimator.pairs()), estimator, instructions, stream, samples)
}

fn sum(
    batch: &mut Batch,
    estimator: &dyn Estimator,
    instructions: Instructions,
    stream: Stream,
    samples: Range<u32>,
) -> Result<Estimate, NotFinite> {
    let (mut estimate, mut divisor) = (Estimate::default(), [0.0; 3]);
    batch.empty(estimator.pairs());
    for start in samples.clone().step_by(BATCH) {
        batch.want(BATCH.min((samples.end - start) as usize));
        stream.fill(instructions, start, batch.length, &mut batch.numbers);
        estimator.evaluate(instructions, batch);
        batch.round_up();
        instructions.run(Add { batch, estimate: &mut estimate }).map_err(|k| not_finite(batch, start, k))?;
        if estimator.is_quotient() {
            batch.divisor.iter().zip(&mut divisor).for_each(|(part, sum)| *sum += total(&part[..batch.length]));
        }
    }
    estimate.value = estimator.estimate(estimate.value, divisor, samples.len() as u32);
    Ok(estimate)
}

/// Adds a batch to the sums; the error is the first sample that is not finite.
struct Add<'b> {
    batch: &'b Batch,
    estimate: &'b mut Estimate,
}

impl Kernel for Add<'_> {
    type Output = Result<(), usize>;

    #[inline(always)]
    fn run<R: Real>(self) -> Result<(), usize> {
        add::<R::Wide>(self.batch, self.estimate)
    }
}

#[inline(always)]
fn add<W: Wide>(batch: &Batch, estimate: &mut Estimate) -> Result<(), usize> {
    let length = batch.length.next_multiple_of(EIGHT);
    let (zero, one, weights) = (W::splat(0.0), W::splat(1.0), LUMINANCE.map(W::splat));
    let (mut sums, mut low, mut high) = ([zero; 3], W::splat(estimate.range.low), W::splat(estimate.range.high));
    let (mut hits, mut luminances) = (zero, [0.0; BATCH]);
    for k in (0..length).step_by(EIGHT) {
        let [r, g, b] =
            [W::widen(&batch.worth[0][k..]), W::widen(&batch.worth[1][k..]), W::widen(&batch.worth[2][k..])];
        let luminance = r * weights[0] + g * weights[1] + b * weights[2];
        luminance.store(&mut luminances[k..]);
        sums = [sums[0] + r, sums[1] + g, sums[2] + b];
        let hit = !luminance.equals(zero);
        hits = W::select(hit, hits + one, hits);
        low = W::select(hit & luminance.lt(low), luminance, low);
        high = W::select(hit & high.lt(luminance), luminance, high);
    }
    let moments = Moments::by::<W>(&luminances[..batch.length]);
    if !moments.mean.is_finite() {
        return Err(first_not_finite(batch));
    }
    for c in 0..3 {
        estimate.value[c] += sums[c].sum();
    }
    estimate.hits += hits.sum() as u64;
    estimate.range = estimate::Range { low: least(low), high: -least(zero - high) };
    estimate.luminance = estimate.luminance + moments;
    estimate.rays += u64::from(batch.rays[..batch.length].iter().sum::<u32>());
    Ok(())
}

#[inline(always)]
fn least<W: Wide>(values: W) -> f64 {
    values.to_array().into_iter().fold(f64::INFINITY, f64::min)
}

fn total(values: &[f32]) -> f64 {
    values.iter().map(|&value| f64::from(value)).sum()
}

#[cold]
fn first_not_finite(batch: &Batch) -> usize {
    let broken = |k: &usize| batch.worth.iter().any(|channel| !channel[*k].is_finite());
    (0..batch.length).find(broken).unwrap_or_default()
}

#[cold]
fn not_finite(batch: &Batch, start: u32, k: usize) -> NotFinite {
    let value = batch.worth.map(|channel| channel[k]);
    NotFinite { index: start + k as u32, value, words: batch.numbers.words(k) }
}
