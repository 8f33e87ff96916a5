//! Directions as the surface at x reflects them.

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Real;
use twoforms_geometry::view::{Vantage, View};

use super::{CosineHemisphere, Density, Ready};
use crate::glossy::Glossy;
use crate::lights::Lights;
use crate::measure::{Aim, Pdf, Sample, SolidAngle};
use crate::query::Query;
use crate::selection::Selection;
use crate::xi::Xi;

/// The surface's own density: of one with a highlight, mirrored at visible normals mixed with cosθ/π
/// ([`MetallicRoughness::pdf`](crate::glossy::MetallicRoughness::pdf)); cosθ/π where f_r is the same for all directions.
#[derive(Clone, Copy, Debug)]
pub struct ByBrdf {
    /// The surface, if it has a highlight.
    pub glossy: Option<Glossy>,
}

impl Density<SolidAngle> for ByBrdf {
    /// No sample below the horizon, where a mirrored direction may lie.
    #[inline(always)]
    fn sample<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SolidAngle, R>, R> {
        let Some(glossy) = &self.glossy else { return CosineHemisphere.sample(from, xi) };
        let at = Aim::anywhere(glossy.direction(from.footprint(), xi.uv()));
        self.pdf(from, &at).map(|pdf| Sample { at, pdf })
    }

    #[inline(always)]
    fn pdf<R: Real>(&self, from: &Vantage<R>, aim: &Aim<R>) -> Masked<Pdf<SolidAngle, R>, R> {
        let Some(glossy) = &self.glossy else { return CosineHemisphere.pdf(from, aim) };
        let pdf = glossy.pdf(from.footprint(), aim.psi);
        Masked::new(Pdf::new(pdf), R::zero().lt(aim.psi.cos_theta()))
    }
}

/// `hemisphere/brdf`.
#[derive(Clone, Copy, Debug)]
pub struct BrdfOfSurface;

impl Ready for BrdfOfSurface {
    type Measure = SolidAngle;
    type At<'a> = ByBrdf;

    fn prepare(_: &Lights, _: Selection) -> Self {
        Self
    }

    /// Θ is that of each point of a footprint.
    fn depends_on_x(&self) -> bool {
        false
    }

    fn at(&self, _: &View, query: &Query) -> ByBrdf {
        ByBrdf { glossy: query.glossy().copied() }
    }
}
