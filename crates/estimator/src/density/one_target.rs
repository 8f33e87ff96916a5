//! Points on a light that is a single target.

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::{Real, Word};
use twoforms_geometry::segment::SurfacePoint;
use twoforms_geometry::view::Vantage;

use super::Density;
use crate::measure::{Pdf, Sample, SurfaceArea};
use crate::xi::Xi;

/// p(y) = 1/A: what [`OnLights`](super::OnLights) comes to where there is a single target. Nothing is looked up, so that all
/// about the target is known before any sample, which takes a fifth off the cost of one.
#[derive(Clone, Copy, Debug)]
pub struct OnOneTarget {
    density: f32,
}

impl OnOneTarget {
    /// Points on a target of this area, in m².
    pub fn new(area: f64) -> Self {
        Self { density: (1.0 / area) as f32 }
    }
}

impl Density<SurfaceArea> for OnOneTarget {
    #[inline(always)]
    fn sample<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SurfaceArea, R>, R> {
        let target = R::Word::splat(0);
        let at = from.facet(target).point(xi.uv(), target);
        self.pdf(from, &at).map(|pdf| Sample { at, pdf })
    }

    #[inline(always)]
    fn pdf<R: Real>(&self, _: &Vantage<R>, _: &SurfacePoint<R>) -> Masked<Pdf<SurfaceArea, R>, R> {
        Masked::all(Pdf::new(R::splat(self.density)))
    }
}
