//! Directions toward points on the lights.

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::{Real, Word};
use twoforms_geometry::segment::Segment;
use twoforms_geometry::view::{Vantage, View};

use super::lights::{AreaOnLights, ByArea, OnLights};
use super::{Density, Ready};
use crate::lights::Lights;
use crate::measure::{ANYWHERE, Aim, Pdf, Sample, SolidAngle};
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

    fn at<'a>(&'a self, view: &View, lights: &Lights) -> TowardLights<'a> {
        TowardLights { lights: self.0.at(view, lights) }
    }
}
