//! Estimators that know what x would receive were nothing in between and all targets of one radiance each, U, and sample only
//! what is missing.

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Real;
use twoforms_geometry::segment::Segment;
use twoforms_geometry::view::{Vantage, View};

use crate::density::{ByArea, Density, OnLights};
use crate::estimator::{Primary, Worth, count};
use crate::measure::{Sample, SurfaceArea};
use crate::numbers::Drawn;
use crate::query::Query;
use crate::rgb::Rgb;

/// U Σ V f/p / Σ g/p with f the unhidden integrand and g that of the targets' mean radiances, whose integral is U: light
/// unhidden times the part of it that is seen, by one set of samples (Heitz, Hill, McGuire 2018, "Combining analytic direct
/// illumination and stochastic shadows"). Biased at few samples. Where no light emits by a texture, g is f.
pub(crate) struct Ratio<'a> {
    pub(crate) shadow: Shadow<'a>,
}

/// U − (1/N) Σ (g − V f)/p: unhidden light less the part that is hidden. Unbiased, and certain where nothing is hidden and no
/// light emits by a texture.
pub(crate) struct ControlVariate<'a> {
    pub(crate) shadow: Shadow<'a>,
}

/// The samples of both: points on the lights.
pub(crate) struct Shadow<'a> {
    pub(crate) view: &'a View<'a>,
    pub(crate) query: &'a Query<'a>,
    pub(crate) density: OnLights<'a, ByArea>,
    /// U, by the targets' mean radiances, RGB.
    pub(crate) unoccluded: [f64; 3],
}

/// One sample: g/p, f/p, V, and where V was asked for.
struct Shade<R: Real> {
    mean: Rgb<R>,
    unhidden: Rgb<R>,
    visible: R::Mask,
    asked: R::Mask,
}

impl Shadow<'_> {
    #[inline(always)]
    fn draw<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Masked<Sample<SurfaceArea, R>, R> {
        let (sample, some) = self.density.sample(from, drawn.xi(0)).parts();
        Masked::new(sample, some & from.wanted() & Segment::to(&sample.at).facing())
    }

    /// What a point would contribute were nothing in between, with this L_e, over its density.
    #[inline(always)]
    fn worth<R: Real>(
        &self,
        from: &Vantage<R>,
        sample: &Sample<SurfaceArea, R>,
        facing: R::Mask,
        l_e: Rgb<R>,
    ) -> Rgb<R> {
        let xy = Segment::to(&sample.at);
        let g = l_e * self.query.f_r(from, xy.psi) * xy.g();
        (g * (R::one() / sample.pdf.value())).or_black(facing)
    }

    /// g/p.
    #[inline(always)]
    fn mean<R: Real>(&self, from: &Vantage<R>, sample: &Sample<SurfaceArea, R>, facing: R::Mask) -> Rgb<R> {
        self.worth(from, sample, facing, self.query.mean_l_e(Masked::new(sample.at, facing)))
    }

    #[inline(always)]
    fn sample<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Shade<R> {
        let (sample, facing) = self.draw(from, drawn).parts();
        let mean = self.mean(from, &sample, facing);
        let visible = facing & from.visible(&sample.at, facing);
        let unhidden = if self.query.varies::<R>() {
            self.worth(from, &sample, facing, self.query.l_e(from, Masked::new(sample.at, visible)))
        } else {
            mean
        };
        Shade { mean, unhidden, visible, asked: facing }
    }
}

impl Primary for Ratio<'_> {
    const QUOTIENT: bool = true;

    fn view(&self) -> &View<'_> {
        self.shadow.view
    }

    fn query(&self) -> &Query<'_> {
        self.shadow.query
    }

    /// V f/p.
    #[inline(always)]
    fn primary<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Worth<R> {
        let Shade { unhidden, visible, asked, .. } = self.shadow.sample(from, drawn);
        Worth { value: unhidden.or_black(visible), rays: count::<R>(asked) }
    }

    /// g/p.
    #[inline(always)]
    fn divisor<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Rgb<R> {
        let (sample, facing) = self.shadow.draw(from, drawn).parts();
        self.shadow.mean(from, &sample, facing)
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

    fn query(&self) -> &Query<'_> {
        self.shadow.query
    }

    #[inline(always)]
    fn primary<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Worth<R> {
        let Shade { mean, unhidden, visible, asked } = self.shadow.sample(from, drawn);
        let known = Rgb::splat(self.shadow.unoccluded.map(|u| u as f32)).or_black(from.wanted());
        let hidden = if self.shadow.query.varies::<R>() {
            mean + unhidden.or_black(visible) * R::splat(-1.0)
        } else {
            mean.or_black(asked & !visible)
        };
        Worth { value: known + hidden * R::splat(-1.0), rays: count::<R>(asked) }
    }
}
