//! Points on the lights by solid angle.

use std::borrow::Cow;

use twoforms_geometry::real::Real;
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::view::{Vantage, View};

use super::Ready;
use super::lights::{OnLights, Picking, Spread};
use super::pieces::Pieces;
use crate::lights::Lights;
use crate::measure::SurfaceArea;
use crate::query::Query;
use crate::selection::{Picker, Piece, Selection};

/// Solid angle, not cut by the horizon, over the targets that face x and rise above its horizon.
#[derive(Clone, Debug)]
pub struct BySolidAngle(Pieces);

impl Spread for BySolidAngle {
    #[inline(always)]
    fn point<R: Real>(&self, _: &Vantage<R>, piece: R::Word, uv: [R; 2]) -> SurfacePoint<R> {
        self.0.point(piece, uv)
    }

    /// dω/dA = cosθ_y / r².
    #[inline(always)]
    fn per_area<R: Real>(&self, _: &Vantage<R>, y: &SurfacePoint<R>) -> R {
        Segment::to(y).d_omega_d_area()
    }
}

/// `area/solid-angle`.
#[derive(Clone, Debug)]
pub struct SolidAngleOnLights(Selection);

impl Ready for SolidAngleOnLights {
    type Measure = SurfaceArea;
    type At<'a> = OnLights<'a, BySolidAngle>;

    fn prepare(_: &Lights, selection: Selection) -> Self {
        Self(selection)
    }

    fn depends_on_x(&self) -> bool {
        true
    }

    fn at<'a>(&'a self, view: &View, query: &Query) -> OnLights<'a, BySolidAngle> {
        let mut shares = Vec::new();
        let pieces = Pieces::new(view, |target, piece| shares.push(Piece { target, measure: piece.solid_angle() }));
        let lights = query.lights();
        let picker = Picker::over(self.0, lights, &shares, || self.0.at_x(lights, view));
        OnLights { picking: Picking::Listed(Cow::Owned(picker)), spread: BySolidAngle(pieces) }
    }
}
