//! Points on the lights by projected solid angle.

use std::borrow::Cow;

use glam::DVec3;
use twoforms_geometry::real::Real;
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::view::{Vantage, View};

use super::Ready;
use super::along::{self, Axes};
use super::lights::{OnLights, Picking, Spread};
use super::sector::{self, sectors};
use crate::lights::Lights;
use crate::measure::SurfaceArea;
use crate::query::Query;
use crate::selection::{Picker, Piece, Selection};

const DIRECTION: usize = sector::ROW;
const ROW: usize = DIRECTION + along::PLANE;

/// Projected solid angle over what rises above the horizon of the targets that face x: each some sectors.
#[derive(Clone, Debug)]
pub struct ByProjectedSolidAngle {
    sectors: Vec<[f32; ROW]>,
    targets: Vec<u32>,
}

impl ByProjectedSolidAngle {
    /// The targets that face x, and the pieces that they fall into.
    fn new(view: &View) -> (Self, Vec<Piece>) {
        let (mut spread, mut pieces) = (Self { sectors: Vec::new(), targets: Vec::new() }, Vec::new());
        for target in 0..view.geometry().targets().len() as u32 {
            view.facing(target, |corners| {
                sectors(corners, |sector| {
                    pieces.push(Piece { target, measure: sector.projected_solid_angle() });
                    spread.push(target, &sector.row(), corners);
                });
            });
        }
        // Beyond the last: a point that is none, since all of its depth is zero.
        spread.sectors.push([0.0; ROW]);
        spread.targets.push(0);
        (spread, pieces)
    }

    fn push(&mut self, target: u32, sector: &[f32; DIRECTION], plane: &[DVec3]) {
        let mut row = [0.0; ROW];
        row[..DIRECTION].copy_from_slice(sector);
        row[DIRECTION..].copy_from_slice(&along::plane(&Axes::OF_X, plane));
        self.sectors.push(row);
        self.targets.push(target);
    }
}

impl Spread for ByProjectedSolidAngle {
    #[inline(always)]
    fn point<R: Real>(&self, _: &Vantage<R>, piece: R::Word, uv: [R; 2]) -> SurfacePoint<R> {
        let row: [R; ROW] = R::gather(
            piece,
            #[inline(always)]
            |k| &self.sectors[k as usize],
        );
        let target = R::gather_word(
            piece,
            #[inline(always)]
            |k| self.targets[k as usize],
        );
        let (mut sector, mut plane) = ([R::zero(); DIRECTION], [R::zero(); along::PLANE]);
        sector.copy_from_slice(&row[..DIRECTION]);
        plane.copy_from_slice(&row[DIRECTION..]);
        let psi = sector::direction(&sector, uv);
        along::point_along(&plane, psi, psi, target)
    }

    /// cosθ_x dω/dA = cosθ_x cosθ_y / r².
    #[inline(always)]
    fn per_area<R: Real>(&self, _: &Vantage<R>, y: &SurfacePoint<R>) -> R {
        let xy = Segment::to(y);
        R::select(R::zero().lt(xy.cos_x), xy.g(), R::zero())
    }
}

/// `area/projected-solid-angle`.
#[derive(Clone, Debug)]
pub struct ProjectedSolidAngleOnLights(Selection);

impl Ready for ProjectedSolidAngleOnLights {
    type Measure = SurfaceArea;
    type At<'a> = OnLights<'a, ByProjectedSolidAngle>;

    fn prepare(_: &Lights, selection: Selection) -> Self {
        Self(selection)
    }

    fn depends_on_x(&self) -> bool {
        true
    }

    fn at<'a>(&'a self, view: &View, query: &Query) -> OnLights<'a, ByProjectedSolidAngle> {
        let (spread, pieces) = ByProjectedSolidAngle::new(view);
        let lights = query.lights();
        let picker = Picker::over(self.0, lights, &pieces, || self.0.at_x(lights, view));
        OnLights { picking: Picking::Listed(Cow::Owned(picker)), spread }
    }
}
