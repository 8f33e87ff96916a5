//! Points on the lights, and the directions toward them.

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::{Real, Word};
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::view::Vantage;

use super::Density;
use crate::measure::{ANYWHERE, Aim, Pdf, Sample, SolidAngle, SurfaceArea};
use crate::selection::Pick;
use crate::xi::Xi;

/// A target is picked, then a point on it uniformly: p(y) = Pr(target)/A(target).
#[derive(Clone, Copy, Debug)]
pub struct OnLights<'p, P> {
    /// Picks the target.
    pub picker: &'p P,
}

/// The crossed row: y is drawn as [`OnLights`] does, and Ψ points at it, with p(Ψ) = p(y) r²/cosθ_y at that y. Only the
/// target drawn counts, so the two ways to write the integral have one density and equal each other sample by sample.
#[derive(Clone, Copy, Debug)]
pub struct TowardLights<'p, P> {
    /// Where Ψ points at.
    pub lights: OnLights<'p, P>,
}

impl<P: Pick> Density<SurfaceArea> for OnLights<'_, P> {
    #[inline(always)]
    fn sample<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SurfaceArea, R>, R> {
        let (target, u) = self.picker.pick::<R>(xi.pick());
        let at = from.facet(target).point([u, xi.v()], target);
        self.pdf(from, &at).map(|pdf| Sample { at, pdf })
    }

    #[inline(always)]
    fn pdf<R: Real>(&self, _: &Vantage<R>, y: &SurfacePoint<R>) -> Masked<Pdf<SurfaceArea, R>, R> {
        Masked::all(Pdf::new(self.picker.density::<R>(y.target)))
    }
}

impl<P: Pick> Density<SolidAngle> for TowardLights<'_, P> {
    #[inline(always)]
    fn sample<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SolidAngle, R>, R> {
        let (Sample { at: y, pdf }, some) = self.lights.sample(from, xi).parts();
        let xy = Segment::to(&y);
        let at = Aim { psi: xy.psi, target: y.target };
        Masked::new(Sample { at, pdf: pdf.per_solid_angle(&xy) }, some & xy.facing())
    }

    #[inline(always)]
    fn pdf<R: Real>(&self, from: &Vantage<R>, aim: &Aim<R>) -> Masked<Pdf<SolidAngle, R>, R> {
        let aimed = !R::same(aim.target, R::Word::splat(ANYWHERE));
        let target = R::select_word(aimed, aim.target, R::Word::splat(0));
        let y = from.facet(target).point_along(aim.psi, target);
        let xy = Segment::to(&y);
        let (pdf, some) = self.lights.pdf(from, &y).parts();
        let drawn = some & aimed & xy.facing() & from.meets(target, aim.psi);
        Masked::new(pdf.per_solid_angle(&xy), drawn)
    }
}
