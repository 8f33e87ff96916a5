//! Estimators of the light that x receives: the lecture's primary estimator, by techniques and combinations of them.

use twoforms_geometry::lanes::{Instructions, Kernel};
use twoforms_geometry::real::{Mask, Real, Word};
use twoforms_geometry::vector::Vector;
use twoforms_geometry::view::{Vantage, View};

use crate::batch::Batch;
use crate::density::Density;
use crate::formulation::Formulation;
use crate::measure::Sample;
use crate::numbers::Drawn;
use crate::query::Query;
use crate::rgb::Rgb;

/// What one sample is worth, and the rays that it asked for.
#[derive(Clone, Copy, Debug)]
pub struct Worth<R: Real> {
    /// ⟨I⟩_prim, RGB.
    pub value: Rgb<R>,
    /// Rays: evaluations of vp or V.
    pub rays: R::Word,
}

/// What one sample of an estimator is worth at x: ⟨I⟩_prim.
pub trait Primary: Sync {
    /// Whether the estimate is a quotient of two sums instead of a mean.
    const QUOTIENT: bool = false;

    /// What x sees.
    fn view(&self) -> &View<'_>;

    /// What is asked of the light.
    fn query(&self) -> &Query<'_>;

    /// Pairs of random numbers that a sample takes.
    fn pairs(&self) -> usize {
        1
    }

    /// Rays that were asked for to make it, at x once.
    fn setup_rays(&self) -> u64 {
        0
    }

    /// What samples are worth. Those that are not wanted are worth zero.
    fn primary<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Worth<R>;

    /// What the same samples add to the divisor, RGB, where the estimate is a quotient.
    #[inline(always)]
    fn divisor<R: Real>(&self, _: &Vantage<R>, _: Drawn) -> Rgb<R> {
        Rgb::splat([0.0; 3])
    }

    /// The estimate from the sum of worths and that of divisors over n samples.
    fn estimate(&self, sum: [f64; 3], _: [f64; 3], n: u32) -> [f64; 3] {
        sum.map(|sum| sum / f64::from(n))
    }
}

/// An estimator at x, whichever it is. What depends on which one it is is compiled once, here, and asked for a batch at a time.
pub trait Estimator: Sync {
    /// Whether the estimate is a quotient of two sums instead of a mean.
    fn is_quotient(&self) -> bool;

    /// Pairs of random numbers that a sample takes.
    fn pairs(&self) -> usize;

    /// Rays that were asked for to make it, at x once.
    fn setup_rays(&self) -> u64;

    /// What the samples of a batch are worth.
    fn evaluate(&self, instructions: Instructions, batch: &mut Batch);

    /// The estimate from the sum of worths and that of divisors over n samples.
    fn estimate(&self, sum: [f64; 3], divisor: [f64; 3], n: u32) -> [f64; 3];
}

impl<P: Primary> Estimator for P {
    fn is_quotient(&self) -> bool {
        P::QUOTIENT
    }

    fn pairs(&self) -> usize {
        Primary::pairs(self)
    }

    fn setup_rays(&self) -> u64 {
        Primary::setup_rays(self)
    }

    fn evaluate(&self, instructions: Instructions, batch: &mut Batch) {
        let instructions = if self.query().lights().vary() { Instructions::SCALAR } else { instructions };
        instructions.run(Evaluate { primary: self, batch });
    }

    fn estimate(&self, sum: [f64; 3], divisor: [f64; 3], n: u32) -> [f64; 3] {
        Primary::estimate(self, sum, divisor, n)
    }
}

/// A batch with its numbers yet to be chosen.
struct Evaluate<'e, P> {
    primary: &'e P,
    batch: &'e mut Batch,
}

impl<P: Primary> Kernel for Evaluate<'_, P> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real>(self) {
        let Self { primary, batch } = self;
        let (view, length) = (primary.view(), batch.length);
        if batch.from_points {
            for offset in (0..length).step_by(R::LANES) {
                let [x, y, z] = batch.start.each_ref();
                let start = Vector::new(R::load(&x[offset..]), R::load(&y[offset..]), R::load(&z[offset..]));
                batch.evaluate(primary, view.from_points::<R>(start), offset);
            }
        } else {
            for offset in (0..length).step_by(R::LANES) {
                batch.evaluate(primary, view.from_x::<R>(), offset);
            }
        }
    }
}

/// One technique: a formulation and a density of one measure. ⟨I⟩_prim = f(x)/p(x).
#[derive(Clone, Copy)]
pub struct Single<'a, F, D> {
    pub(crate) view: &'a View<'a>,
    pub(crate) query: &'a Query<'a>,
    pub(crate) density: D,
    formulation: std::marker::PhantomData<fn() -> F>,
}

impl<'a, F: Formulation, D: Density<F::Measure>> Single<'a, F, D> {
    /// The estimator of `query` at x by formulation F with points drawn from `density`.
    pub fn new(view: &'a View<'a>, query: &'a Query<'a>, density: D) -> Self {
        Self { view, query, density, formulation: std::marker::PhantomData }
    }
}

impl<F: Formulation, D: Density<F::Measure>> Primary for Single<'_, F, D> {
    fn view(&self) -> &View<'_> {
        self.view
    }

    fn query(&self) -> &Query<'_> {
        self.query
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
