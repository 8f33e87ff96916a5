//! Estimators: a formulation and a density of one measure.

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::{Mask, Real};
use twoforms_geometry::view::View;

use crate::density::Density;
use crate::formulation::Formulation;
use crate::measure::Sample;
use crate::moments::Moments;
use crate::query::Query;
use crate::rgb::{Rgb, luminance};
use crate::xi::Xi;

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
    pub words: [u32; 4],
}

/// Samples evaluated before their moments are merged.
const BATCH: usize = 64;

impl<'a, F: Formulation, D: Density<F::Measure>> Estimator<'a, F, D> {
    /// The estimator of `query` at x by formulation F with points drawn from `density`.
    pub fn new(view: &'a View<'a>, query: &'a Query<'a>, density: D) -> Self {
        Self { view, query, density, formulation: std::marker::PhantomData }
    }

    /// ⟨I⟩_prim = f(x)/p(x): one sample, and where it asked for a ray.
    #[inline(always)]
    pub fn primary<R: Real>(&self, xi: Xi<R>) -> (Rgb<R>, R::Mask) {
        let (Sample { at, pdf }, some) = self.density.sample(self.view, xi).parts();
        if !some.any() {
            return (Rgb([R::zero(); 3]), some);
        }
        let worth = F::integrand(self.view, self.query, &at) / pdf;
        (worth.or_black(some), some & F::asks(&at))
    }

    /// The drawn point and its density, for tests and figures.
    pub fn sample<R: Real>(&self, xi: Xi<R>) -> Masked<Sample<F::Measure, R>, R> {
        self.density.sample(self.view, xi)
    }

    /// ⟨I⟩_sec = (1/N) Σ f(x_i)/p(x_i), with ξ_i from `xi`.
    ///
    /// # Errors
    /// When a sample is not finite.
    pub fn secondary(&self, n: u32, xi: impl Fn(u32) -> Xi<f32>) -> Result<Estimate, NotFinite> {
        let mut estimate = Estimate::default();
        let mut total = [0.0; 3];
        let mut batch = [0.0; BATCH];
        for start in (0..n).step_by(BATCH) {
            let length = BATCH.min((n - start) as usize);
            for (offset, slot) in (0..).zip(&mut batch[..length]) {
                let xi = xi(start + offset);
                let (Rgb(worth), ray) = self.primary::<f32>(xi);
                let wide = worth.map(f64::from);
                *slot = luminance(wide);
                if !slot.is_finite() {
                    return Err(NotFinite { index: start + offset, value: worth, words: xi.words() });
                }
                total = std::array::from_fn(|c| total[c] + wide[c]);
                estimate.rays += u64::from(ray);
            }
            estimate.count(&batch[..length]);
        }
        estimate.value = total.map(|sum| sum / f64::from(n));
        Ok(estimate)
    }
}

impl Estimate {
    fn count(&mut self, luminances: &[f64]) {
        self.luminance = self.luminance + Moments::of(luminances);
        for &worth in luminances.iter().filter(|&&worth| worth != 0.0) {
            self.hits += 1;
            self.range = self.range.with(Range { low: worth, high: worth });
        }
    }
}
