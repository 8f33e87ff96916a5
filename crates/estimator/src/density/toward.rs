//! Directions toward points on the lights.

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::{Mask, Real, Word};
use twoforms_geometry::segment::Segment;
use twoforms_geometry::vector::Direction;
use twoforms_geometry::view::{Vantage, View};

use super::lights::{AreaOnLights, ByArea, OnLights};
use super::{Density, Ready};
use crate::lights::Lights;
use crate::measure::{ANYWHERE, Aim, Pdf, Sample, SolidAngle};
use crate::query::Query;
use crate::selection::Selection;
use crate::xi::Xi;

/// The crossed row: y is drawn as [`OnLights`] does, and Ψ points at it, with p(Ψ) = p(y) r²/cosθ_y at that y. Only the
/// target drawn counts, so the two ways to write the integral have one density and equal each other sample by sample.
#[derive(Clone, Debug)]
pub struct TowardLights<'p> {
    /// Where Ψ points at.
    pub lights: OnLights<'p, ByArea>,
}

impl Density<SolidAngle> for TowardLights<'_> {
    #[inline(always)]
    fn sample<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SolidAngle, R>, R> {
        let (Sample { at: y, pdf }, some) = self.lights.sample(from, xi).parts();
        let xy = Segment::to(&y);
        let at = Aim { psi: xy.psi, target: y.target, alone: true };
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

/// `hemisphere/toward-lights`.
#[derive(Clone, Debug)]
pub struct TowardPreparedLights(AreaOnLights);

impl Ready for TowardPreparedLights {
    type Measure = SolidAngle;
    type At<'a> = TowardLights<'a>;

    fn prepare(lights: &Lights, selection: Selection) -> Self {
        Self(AreaOnLights::prepare(lights, selection))
    }

    fn depends_on_x(&self) -> bool {
        self.0.depends_on_x()
    }

    fn at<'a>(&'a self, view: &View, query: &Query) -> TowardLights<'a> {
        TowardLights { lights: self.0.at(view, query) }
    }
}

/// The same directions with their true density: p(Ψ) = Σ p(y) r²/|cosθ_y| over all points y of lights along Ψ, whatever stands
/// between and whichever side they show. Whatever light Ψ meets first counts. A sample asks every target.
#[derive(Clone, Debug)]
pub struct TowardLightsMarginal<'p> {
    /// Where Ψ points at.
    pub lights: OnLights<'p, ByArea>,
}

impl TowardLightsMarginal<'_> {
    /// Σ p(y) r²/|cosθ_y|; the target that y was drawn on is met, however Ψ was rounded.
    #[inline(always)]
    fn density<R: Real>(&self, from: &Vantage<R>, psi: Direction<R>, drawn: R::Word) -> R {
        let mut sum = R::zero();
        for k in 0..from.view().geometry().targets().len() as u32 {
            let target = R::Word::splat(k);
            let met = R::same(drawn, target) | from.meets_one(k, psi);
            if met.any() {
                let xy = Segment::to(&from.facet(target).point_along(psi, target));
                let d_omega = xy.d_omega_d_area();
                let d_omega = R::select(d_omega.lt(R::zero()), -d_omega, d_omega);
                let met = met & R::zero().lt(d_omega);
                sum = sum + R::select(met, self.lights.picking.density::<R>(target) / d_omega, R::zero());
            }
        }
        sum
    }
}

impl Density<SolidAngle> for TowardLightsMarginal<'_> {
    #[inline(always)]
    fn sample<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SolidAngle, R>, R> {
        let (Sample { at: y, .. }, some) = self.lights.sample(from, xi).parts();
        let xy = Segment::to(&y);
        let pdf = self.density(&from.only(some), xy.psi, y.target);
        let off_plane = R::zero().lt(y.depth) | y.depth.lt(R::zero());
        let some = some & off_plane & R::zero().lt(xy.cos_x) & R::zero().lt(pdf);
        let at = Aim { psi: xy.psi, target: y.target, alone: false };
        Masked::new(Sample { at, pdf: Pdf::new(pdf) }, some)
    }

    #[inline(always)]
    fn pdf<R: Real>(&self, from: &Vantage<R>, aim: &Aim<R>) -> Masked<Pdf<SolidAngle, R>, R> {
        let pdf = self.density(from, aim.psi, aim.target);
        Masked::new(Pdf::new(pdf), R::zero().lt(aim.psi.cos_theta()) & R::zero().lt(pdf))
    }
}

/// `hemisphere/toward-lights-marginal`.
#[derive(Clone, Debug)]
pub struct TowardLightsMarginally(AreaOnLights);

impl Ready for TowardLightsMarginally {
    type Measure = SolidAngle;
    type At<'a> = TowardLightsMarginal<'a>;

    fn prepare(lights: &Lights, selection: Selection) -> Self {
        Self(AreaOnLights::prepare(lights, selection))
    }

    /// Which targets lie along Ψ, whichever side they show, is told by the facets of x alone.
    fn depends_on_x(&self) -> bool {
        true
    }

    fn at<'a>(&'a self, view: &View, query: &Query) -> TowardLightsMarginal<'a> {
        TowardLightsMarginal { lights: self.0.at(view, query) }
    }
}
