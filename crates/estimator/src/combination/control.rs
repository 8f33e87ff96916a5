//! Estimators that know what x would receive were nothing in between, U, and sample only the shadow.

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Real;
use twoforms_geometry::segment::Segment;
use twoforms_geometry::view::{Vantage, View};

use crate::density::{ByArea, Density, OnLights};
use crate::estimator::{Primary, Worth, count};
use crate::measure::Sample;
use crate::numbers::Drawn;
use crate::query::Query;
use crate::rgb::Rgb;

/// U Σ V g/p / Σ g/p with g the unhidden integrand: unhidden light times the part of it that is seen, by one set of samples
/// (Heitz, Hill, McGuire 2018, "Combining analytic direct illumination and stochastic shadows"). Biased at few samples.
pub(crate) struct Ratio<'a> {
    pub(crate) shadow: Shadow<'a>,
}

/// U − (1/N) Σ (1 − V) g/p: unhidden light less the part that is hidden. Unbiased, and certain where nothing is hidden.
pub(crate) struct ControlVariate<'a> {
    pub(crate) shadow: Shadow<'a>,
}

/// The samples of both: points on the lights.
pub(crate) struct Shadow<'a> {
    pub(crate) view: &'a View<'a>,
    pub(crate) query: &'a Query<'a>,
    pub(crate) density: OnLights<'a, ByArea>,
    /// U, RGB.
    pub(crate) unoccluded: [f64; 3],
}

/// One sample: g/p, V, and where V was asked for.
struct Shade<R: Real> {
    unhidden: Rgb<R>,
    visible: R::Mask,
    asked: R::Mask,
}

impl Shadow<'_> {
    #[inline(always)]
    fn unhidden<R: Real>(
        &self,
        from: &Vantage<R>,
        drawn: Drawn,
    ) -> (Rgb<R>, Sample<crate::measure::SurfaceArea, R>, R::Mask) {
        let (sample, some) = self.density.sample(from, drawn.xi(0)).parts();
        let xy = Segment::to(&sample.at);
        let facing = some & from.wanted() & xy.facing();
        let g = self.query.l_e(Masked::new(sample.at, facing)) * self.query.f_r(from, xy.psi) * xy.g();
        ((g * (R::one() / sample.pdf.value())).or_black(facing), sample, facing)
    }

    #[inline(always)]
    fn sample<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Shade<R> {
        let (unhidden, sample, facing) = self.unhidden(from, drawn);
        Shade { unhidden, visible: facing & from.visible(&sample.at, facing), asked: facing }
    }
}

impl Primary for Ratio<'_> {
    const QUOTIENT: bool = true;

    fn view(&self) -> &View<'_> {
        self.shadow.view
    }

    /// V g/p.
    #[inline(always)]
    fn primary<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Worth<R> {
        let Shade { unhidden, visible, asked } = self.shadow.sample(from, drawn);
        Worth { value: unhidden.or_black(visible), rays: count::<R>(asked) }
    }

    /// g/p.
    #[inline(always)]
    fn divisor<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Rgb<R> {
        self.shadow.unhidden(from, drawn).0
    }

    /// Zero where no sample faces x.
    fn estimate(&self, sum: [f64; 3], divisor: [f64; 3], _: u32) -> [f64; 3] {
        let quotient = |c: usize| if divisor[c] > 0.0 { sum[c] / divisor[c] } else { 0.0 };
        std::array::from_fn(|c| self.shadow.unoccluded[c] * quotient(c))
    }
}

impl Primary for ControlVariate<'_> {
    fn view(&self) -> &View<'_> {
        self.shadow.view
    }

    #[inline(always)]
    fn primary<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Worth<R> {
        let Shade { unhidden, visible, asked } = self.shadow.sample(from, drawn);
        let known = Rgb::splat(self.shadow.unoccluded.map(|u| u as f32)).or_black(from.wanted());
        let hidden = unhidden.or_black(asked & !visible);
        Worth { value: known + hidden * R::splat(-1.0), rays: count::<R>(asked) }
    }
}
