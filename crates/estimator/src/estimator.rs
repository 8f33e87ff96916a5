//! Estimators of the light that x receives, in the lecture's words: primary with one sample, secondary with the mean of N.

use std::ops::Range;

use twoforms_geometry::lanes::{Instructions, Kernel};
use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::{Mask, Real, Word};
use twoforms_geometry::view::{Vantage, View};
use twoforms_geometry::wide::{EIGHT, Wide};

use crate::density::Density;
use crate::estimate::{self, Estimate, NotFinite};
use crate::formulation::Formulation;
use crate::measure::Sample;
use crate::moments::Moments;
use crate::numbers::{BATCH, Drawn, Numbers};
use crate::query::Query;
use crate::rgb::{LUMINANCE, Rgb};
use crate::sampler::Stream;
use crate::xi::Xi;

/// What one sample is worth, and the rays that it asked for.
#[derive(Clone, Copy, Debug)]
pub struct Worth<R: Real> {
    /// ⟨I⟩_prim, RGB.
    pub value: Rgb<R>,
    /// Rays: evaluations of vp or V.
    pub rays: R::Word,
}

/// An estimator at one x.
pub trait Estimator {
    /// Whether the estimate is a quotient of two sums instead of a mean.
    const QUOTIENT: bool = false;

    /// What x sees.
    fn view(&self) -> &View<'_>;

    /// Pairs of random numbers that a sample takes.
    fn pairs(&self) -> usize {
        1
    }

    /// ⟨I⟩_prim: what samples are worth. Those that are not wanted are worth zero.
    fn primary<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Worth<R>;

    /// What the same samples add to the divisor, RGB, where the estimate is a quotient.
    #[inline(always)]
    fn divisor<R: Real>(&self, _: &Vantage<R>, _: Drawn) -> Rgb<R> {
        Rgb::splat([0.0; 3])
    }

    /// The estimate from the sum of worths and that of divisors over n samples.
    #[inline(always)]
    fn estimate(&self, sum: [f64; 3], _: [f64; 3], n: u32) -> [f64; 3] {
        sum.map(|sum| sum / f64::from(n))
    }

    /// ⟨I⟩_sec = (1/N) Σ ⟨I⟩_prim, with ξ_i from `stream`, by the best instructions of this machine.
    ///
    /// # Errors
    /// When a sample is not finite.
    fn secondary(&self, stream: Stream) -> Result<Estimate, NotFinite>
    where
        Self: Sized,
    {
        self.secondary_by(Instructions::best(), stream)
    }

    /// The same estimate by other instructions. The bits do not depend on them.
    ///
    /// # Errors
    /// When a sample is not finite.
    fn secondary_by(&self, instructions: Instructions, stream: Stream) -> Result<Estimate, NotFinite>
    where
        Self: Sized,
    {
        instructions.run(Secondary { estimator: self, instructions, stream, samples: 0..stream.n })
    }

    /// The mean of some of the N samples.
    ///
    /// # Errors
    /// When a sample is not finite.
    fn part(&self, stream: Stream, samples: Range<u32>) -> Result<Estimate, NotFinite>
    where
        Self: Sized,
    {
        let instructions = Instructions::best();
        instructions.run(Secondary { estimator: self, instructions, stream, samples })
    }
}

/// One technique: a formulation and a density of one measure. ⟨I⟩_prim = f(x)/p(x).
#[derive(Clone, Copy)]
pub struct Single<'a, F, D> {
    pub(crate) view: &'a View<'a>,
    pub(crate) query: &'a Query<'a>,
    pub(crate) density: D,
    formulation: std::marker::PhantomData<F>,
}

impl<'a, F: Formulation, D: Density<F::Measure>> Single<'a, F, D> {
    /// The estimator of `query` at x by formulation F with points drawn from `density`.
    pub fn new(view: &'a View<'a>, query: &'a Query<'a>, density: D) -> Self {
        Self { view, query, density, formulation: std::marker::PhantomData }
    }

    /// The drawn point and its density, for tests and figures.
    pub fn sample<R: Real>(&self, xi: Xi<R>) -> Masked<Sample<F::Measure, R>, R> {
        self.density.sample(&self.view.from_x(), xi)
    }
}

impl<F: Formulation, D: Density<F::Measure>> Estimator for Single<'_, F, D> {
    fn view(&self) -> &View<'_> {
        self.view
    }

    #[inline(always)]
    fn primary<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Worth<R> {
        let (Sample { at, pdf }, some) = self.density.sample(from, drawn.xi(0)).parts();
        let some = some & from.wanted();
        if !some.any() {
            return Worth { value: Rgb::splat([0.0; 3]), rays: R::Word::splat(0) };
        }
        let value = F::integrand(&from.only(some), self.query, &at) / pdf;
        Worth { value: value.or_black(some), rays: count::<R>(some & F::asks(&at)) }
    }
}

/// One where the mask holds, else zero.
#[inline(always)]
pub(crate) fn count<R: Real>(mask: R::Mask) -> R::Word {
    R::select_word(mask, R::Word::splat(1), R::Word::splat(0))
}

/// The secondary estimator with its numbers yet to be chosen.
struct Secondary<'e, E> {
    estimator: &'e E,
    instructions: Instructions,
    stream: Stream,
    samples: Range<u32>,
}

impl<E: Estimator> Kernel for Secondary<'_, E> {
    type Output = Result<Estimate, NotFinite>;

    #[inline(always)]
    fn run<R: Real>(self) -> Self::Output {
        let Range { start: first, end } = self.samples;
        let mut estimate = Estimate::default();
        let mut batch = Batch::new(self.estimator.pairs());
        let mut divisor = [0.0; 3];
        for start in (first..end).step_by(BATCH) {
            let length = BATCH.min((end - start) as usize);
            batch.length = length;
            self.stream.fill(self.instructions, start, length, &mut batch.numbers);
            let mut rays = R::Word::splat(0);
            for offset in (0..length).step_by(R::LANES) {
                rays = rays.wrapping_add(self.evaluate::<R>(offset, &mut batch));
            }
            batch.rays = u64::from(rays.sum());
            estimate.add::<R::Wide>(&batch).map_err(|offset| batch.not_finite(start, offset))?;
            if E::QUOTIENT {
                batch.divisor.iter().zip(&mut divisor).for_each(|(part, sum)| *sum += total(&part[..length]));
            }
        }
        estimate.value = self.estimator.estimate(estimate.value, divisor, end - first);
        Ok(estimate)
    }
}

impl<E: Estimator> Secondary<'_, E> {
    /// Samples that lie side by side, from `offset` of the batch on; answers with the rays they asked for.
    #[inline(always)]
    fn evaluate<R: Real>(&self, offset: usize, batch: &mut Batch) -> R::Word {
        let wanted = R::below(R::Word::counting(offset as u32), R::Word::splat(batch.length as u32));
        let from = self.estimator.view().from_x::<R>().only(wanted);
        let drawn = batch.numbers.from(offset);
        let Worth { value, rays } = self.estimator.primary(&from, drawn);
        let Rgb(worth) = weighed(value, drawn);
        if E::QUOTIENT {
            let Rgb(divisor) = weighed(self.estimator.divisor(&from, drawn), drawn);
            for c in 0..3 {
                divisor[c].store(&mut batch.divisor[c][offset..]);
            }
        }
        for c in 0..3 {
            worth[c].store(&mut batch.worth[c][offset..]);
        }
        rays
    }
}

/// Values as much as their samples count.
#[inline(always)]
fn weighed<R: Real>(Rgb([r, g, b]): Rgb<R>, drawn: Drawn) -> Rgb<R> {
    match drawn.weight::<R>() {
        Some(weight) => Rgb([r * weight, g * weight, b * weight]),
        None => Rgb([r, g, b]),
    }
}

/// Some samples: their ξ, what they are worth, RGB, and the rays they asked for.
struct Batch {
    numbers: Numbers,
    worth: [[f32; BATCH]; 3],
    divisor: [[f32; BATCH]; 3],
    length: usize,
    rays: u64,
}

impl Batch {
    fn new(pairs: usize) -> Self {
        let black = [[0.0; BATCH]; 3];
        Self { numbers: Numbers::new(pairs), worth: black, divisor: black, length: 0, rays: 0 }
    }

    #[cold]
    fn not_finite(&self, start: u32, offset: usize) -> NotFinite {
        let value = self.worth.map(|channel| channel[offset]);
        NotFinite { index: start + offset as u32, value, words: self.numbers.words(offset) }
    }

    #[cold]
    fn first_not_finite(&self) -> usize {
        let broken = |k: &usize| self.worth.iter().any(|channel| !channel[*k].is_finite());
        (0..self.length).find(broken).unwrap_or_default()
    }
}

impl Estimate {
    /// Adds a batch to the sums; the error is the first sample that is not finite.
    #[inline(always)]
    fn add<W: Wide>(&mut self, batch: &Batch) -> Result<(), usize> {
        let length = batch.length.next_multiple_of(EIGHT);
        let (zero, weights) = (W::splat(0.0), LUMINANCE.map(W::splat));
        let (mut sums, mut low, mut high) = ([zero; 3], W::splat(self.range.low), W::splat(self.range.high));
        let mut luminances = [0.0; BATCH];
        for k in (0..length).step_by(EIGHT) {
            let [r, g, b] =
                [W::widen(&batch.worth[0][k..]), W::widen(&batch.worth[1][k..]), W::widen(&batch.worth[2][k..])];
            let luminance = r * weights[0] + g * weights[1] + b * weights[2];
            luminance.store(&mut luminances[k..]);
            sums = [sums[0] + r, sums[1] + g, sums[2] + b];
            let hit = !luminance.equals(zero);
            self.hits += u64::from(hit.count());
            low = W::select(hit & luminance.lt(low), luminance, low);
            high = W::select(hit & high.lt(luminance), luminance, high);
        }
        let moments = Moments::by::<W>(&luminances[..batch.length]);
        if !moments.mean.is_finite() {
            return Err(batch.first_not_finite());
        }
        for c in 0..3 {
            self.value[c] += sums[c].sum();
        }
        self.range = estimate::Range { low: least(low), high: -least(zero - high) };
        self.luminance = self.luminance + moments;
        self.rays += batch.rays;
        Ok(())
    }
}

fn total(values: &[f32]) -> f64 {
    values.iter().map(|&value| f64::from(value)).sum()
}

#[inline(always)]
fn least<W: Wide>(values: W) -> f64 {
    values.to_array().into_iter().fold(f64::INFINITY, f64::min)
}
