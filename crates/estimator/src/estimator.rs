//! Estimators: a formulation and a density of one measure.

use twoforms_geometry::lanes::{Instructions, Kernel};
use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::{Mask, Real, Word};
use twoforms_geometry::view::{Vantage, View};
use twoforms_geometry::wide::{EIGHT, Wide};

use crate::density::Density;
use crate::formulation::Formulation;
use crate::measure::Sample;
use crate::moments::Moments;
use crate::query::Query;
use crate::rgb::{LUMINANCE, Rgb};
use crate::sampler::Stream;
use crate::xi::{DIMENSIONS, Words, Xi};

/// An estimator of the light that x receives, in the lecture's words: primary with one sample, secondary with the mean of N.
#[derive(Clone, Copy)]
pub struct Estimator<'a, F, D> {
    view: &'a View<'a>,
    query: &'a Query<'a>,
    density: D,
    formulation: std::marker::PhantomData<F>,
}

/// An estimate: what N samples add up to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// ⟨I⟩_sec = (1/N) Σ f(x_i)/p(x_i), RGB.
    pub value: [f64; 3],
    /// Moments of the single samples' luminances.
    pub luminance: Moments,
    /// Rays asked for.
    pub rays: u64,
    /// Samples that were not zero.
    pub hits: u64,
    /// Smallest and largest luminance among the samples that were not zero; (∞, −∞) without any.
    pub range: Range,
}

/// The smallest and the largest of some values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The smallest, +∞ without values.
    pub low: f64,
    /// The largest, −∞ without values.
    pub high: f64,
}

impl Default for Range {
    fn default() -> Self {
        Self { low: f64::INFINITY, high: f64::NEG_INFINITY }
    }
}

impl Range {
    /// The range of both.
    pub fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Whether all values are the same but for the rounding of binary32 arithmetic (some ten roundings).
    pub fn is_one_value(&self) -> bool {
        self.low <= self.high && self.high - self.low <= 1e-6 * self.high.abs()
    }
}

/// A sample that came out infinite or not a number.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("sample {index} is worth {value:?}, which is not finite; its random words are {words:?}")]
pub struct NotFinite {
    /// Which sample of the estimate.
    pub index: u32,
    /// Its value, RGB.
    pub value: [f32; 3],
    /// ξ.
    pub words: [u32; DIMENSIONS],
}

/// Samples evaluated before their moments are merged.
const BATCH: usize = 128;

impl<'a, F: Formulation, D: Density<F::Measure>> Estimator<'a, F, D> {
    /// The estimator of `query` at x by formulation F with points drawn from `density`.
    pub fn new(view: &'a View<'a>, query: &'a Query<'a>, density: D) -> Self {
        Self { view, query, density, formulation: std::marker::PhantomData }
    }

    /// What x sees.
    pub fn view(&self) -> &'a View<'a> {
        self.view
    }

    /// ⟨I⟩_prim = f(x)/p(x): one sample each, and where it asked for a ray. Samples that are not wanted are worth zero.
    #[inline(always)]
    pub fn primary<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> (Rgb<R>, R::Mask) {
        let (Sample { at, pdf }, some) = self.density.sample(from, xi).parts();
        let some = some & from.wanted();
        if !some.any() {
            return (Rgb::splat([0.0; 3]), some);
        }
        let worth = F::integrand(&from.only(some), self.query, &at) / pdf;
        (worth.or_black(some), some & F::asks(&at))
    }

    /// The drawn point and its density, for tests and figures.
    pub fn sample<R: Real>(&self, xi: Xi<R>) -> Masked<Sample<F::Measure, R>, R> {
        self.density.sample(&self.view.from_x(), xi)
    }

    /// ⟨I⟩_sec = (1/N) Σ f(x_i)/p(x_i), with ξ_i from `stream`, by the best instructions of this machine.
    ///
    /// # Errors
    /// When a sample is not finite.
    pub fn secondary(&self, n: u32, stream: Stream) -> Result<Estimate, NotFinite> {
        self.secondary_by(Instructions::best(), n, stream)
    }

    /// The same estimate by other instructions. The bits do not depend on them.
    ///
    /// # Errors
    /// When a sample is not finite.
    pub fn secondary_by(&self, instructions: Instructions, n: u32, stream: Stream) -> Result<Estimate, NotFinite> {
        instructions.run(Secondary { estimator: self, n, stream })
    }
}

/// The secondary estimator with its numbers yet to be chosen.
struct Secondary<'e, 'a, F, D> {
    estimator: &'e Estimator<'a, F, D>,
    n: u32,
    stream: Stream,
}

impl<F: Formulation, D: Density<F::Measure>> Kernel for Secondary<'_, '_, F, D> {
    type Output = Result<Estimate, NotFinite>;

    #[inline(always)]
    fn run<R: Real>(self) -> Self::Output {
        let mut estimate = Estimate::default();
        let mut batch = Batch::new();
        for start in (0..self.n).step_by(BATCH) {
            let length = BATCH.min((self.n - start) as usize);
            (batch.length, batch.rays) = (length, 0);
            self.stream.fill::<R, BATCH>(start, length, &mut batch.words);
            for offset in (0..length).step_by(R::LANES) {
                self.evaluate::<R>(offset, &mut batch);
            }
            estimate.add::<R::Wide>(&batch).map_err(|offset| batch.not_finite(start, offset))?;
        }
        estimate.value = estimate.value.map(|sum| sum / f64::from(self.n));
        Ok(estimate)
    }
}

impl<F: Formulation, D: Density<F::Measure>> Secondary<'_, '_, F, D> {
    /// Samples that lie side by side, from `offset` of the batch on.
    #[inline(always)]
    fn evaluate<R: Real>(&self, offset: usize, batch: &mut Batch) {
        let wanted = R::below(R::Word::counting(offset as u32), R::Word::splat(batch.length as u32));
        let from = self.estimator.view.from_x::<R>().only(wanted);
        let (Rgb(worth), ray) = self.estimator.primary(&from, Xi::load(&batch.words, offset));
        for c in 0..3 {
            worth[c].store(&mut batch.worth[c][offset..]);
        }
        batch.rays += u64::from(ray.count());
    }
}

/// Some samples: their ξ, what they are worth, RGB, and the rays they asked for.
struct Batch {
    words: Words<BATCH>,
    worth: [[f32; BATCH]; 3],
    length: usize,
    rays: u64,
}

impl Batch {
    #[inline(always)]
    fn new() -> Self {
        Self { words: [[0; BATCH]; DIMENSIONS], worth: [[0.0; BATCH]; 3], length: 0, rays: 0 }
    }

    #[cold]
    fn not_finite(&self, start: u32, offset: usize) -> NotFinite {
        let words = Xi::<f32>::load(&self.words, offset).words();
        NotFinite { index: start + offset as u32, value: self.worth.map(|channel| channel[offset]), words }
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
        self.range = Range { low: least(low), high: -least(zero - high) };
        self.luminance = self.luminance + moments;
        self.rays += batch.rays;
        Ok(())
    }
}

#[inline(always)]
fn least<W: Wide>(values: W) -> f64 {
    values.to_array().into_iter().fold(f64::INFINITY, f64::min)
}
