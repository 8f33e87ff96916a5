//! Points on the lights by solid angle.

use std::borrow::Cow;

use glam::DVec3;
use twoforms_geometry::real::Real;
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::view::{Vantage, View};

use super::Ready;
use super::along;
use super::lights::{OnLights, Picking, Spread};
use super::spherical_triangle::{self, SphericalTriangle};
use crate::lights::Lights;
use crate::measure::SurfaceArea;
use crate::query::Query;
use crate::selection::{Picker, Piece, Selection};

const DIRECTION: usize = spherical_triangle::ROW;
const ROW: usize = DIRECTION + along::ROW;

/// Solid angle, not cut by the horizon, over the targets that face x and rise above its horizon: each a spherical triangle, two for a parallelogram, more
/// where they are huge.
#[derive(Clone, Debug)]
pub struct BySolidAngle {
    triangles: Vec<[f32; ROW]>,
    targets: Vec<u32>,
}

impl BySolidAngle {
    /// The targets that face x and rise above its horizon, and the pieces that they fall into.
    fn new(view: &View) -> (Self, Vec<Piece>) {
        let (mut spread, mut pieces) = (Self { triangles: Vec::new(), targets: Vec::new() }, Vec::new());
        for target in 0..view.geometry().targets().len() as u32 {
            view.facing(target, |corners| {
                if corners.iter().all(|corner| corner.z <= 0.0) {
                    return;
                }
                each_triangle(corners, |triangle| {
                    pieces.push(Piece { target, measure: triangle.solid_angle() });
                    spread.push(target, &triangle, corners);
                });
            });
        }
        // Beyond the last: a point that is none, since all of its depth is zero.
        spread.triangles.push([0.0; ROW]);
        spread.targets.push(0);
        (spread, pieces)
    }

    fn push(&mut self, target: u32, triangle: &SphericalTriangle, plane: &[DVec3]) {
        let mut row = [0.0; ROW];
        row[..DIRECTION].copy_from_slice(&triangle.row());
        row[DIRECTION..].copy_from_slice(&along::row(triangle.axes(), plane));
        self.triangles.push(row);
        self.targets.push(target);
    }
}

/// How often a triangle is cut.
const MOST_CUTS: u32 = 3;

/// The spherical triangles that a target's corners make.
fn each_triangle(corners: &[DVec3], mut f: impl FnMut(SphericalTriangle)) {
    for edge in corners[1..].windows(2) {
        if let Some(triangle) = SphericalTriangle::new([corners[0], edge[0], edge[1]]) {
            triangle.each_part(MOST_CUTS, &mut f);
        }
    }
}

impl Spread for BySolidAngle {
    #[inline(always)]
    fn point<R: Real>(&self, _: &Vantage<R>, piece: R::Word, uv: [R; 2]) -> SurfacePoint<R> {
        let row: [R; ROW] = R::gather(
            piece,
            #[inline(always)]
            |k| &self.triangles[k as usize],
        );
        let target = R::gather_word(
            piece,
            #[inline(always)]
            |k| self.targets[k as usize],
        );
        let (mut triangle, mut plane) = ([R::zero(); DIRECTION], [R::zero(); along::ROW]);
        triangle.copy_from_slice(&row[..DIRECTION]);
        plane.copy_from_slice(&row[DIRECTION..]);
        along::point(&plane, spherical_triangle::direction(&triangle, uv), target)
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
        let (spread, pieces) = BySolidAngle::new(view);
        let lights = query.lights();
        let picker = Picker::over(self.0, lights, &pieces, || self.0.at_x(lights, view));
        OnLights { picking: Picking::Listed(Cow::Owned(picker)), spread }
    }
}

/// The spherical triangles that a target is drawn as.
pub fn spherical_triangles(corners: &[DVec3]) -> Vec<SphericalTriangle> {
    let mut triangles = Vec::new();
    each_triangle(corners, |triangle| triangles.push(triangle));
    triangles
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::DVec3;

    use super::spherical_triangles;

    /// An octant; most of the hemisphere; a sliver half around it: cut or not, parts add up and draws lie within.
    #[test]
    fn parts_add_up_and_hold_their_draws() {
        let corner = |degrees: f64, z: f64| DVec3::new(degrees.to_radians().cos(), degrees.to_radians().sin(), z);
        let octant = [DVec3::X, DVec3::Y, DVec3::Z];
        let wide = [corner(0.0, 1e-3), corner(120.0, 1e-3), corner(240.0, 1e-3)];
        let sliver = [corner(0.0, 0.01), corner(175.0, 0.01), corner(80.0, 0.012)];
        for (corners, least, most) in [(octant, 1, 1), (wide, 3, 12), (sliver, 2, 8)] {
            let parts = spherical_triangles(&corners);
            let sum: f64 = parts.iter().map(super::SphericalTriangle::solid_angle).sum();
            let whole = twoforms_geometry::solid_angle::solid_angle(&corners);
            assert!((least..=most).contains(&parts.len()) && (sum - whole).abs() < 1e-9 * PI, "{sum} {whole}");
            let around = 1.0_f64.copysign(corners[0].dot(corners[1].cross(corners[2])));
            for part in &parts {
                for k in 0..64_u8 {
                    let uv = [f32::from(k % 8) / 7.0, f32::from(k / 8 + 1) / 8.0];
                    let psi = part.turned(part.direction(uv).map(f64::from));
                    let edges =
                        [[0, 1], [1, 2], [2, 0]].map(|[i, j]| corners[i].cross(corners[j]).normalize() * around);
                    assert!(edges.iter().all(|normal| normal.dot(psi) > -1e-6), "{psi} at {uv:?} of {corners:?}");
                }
            }
        }
    }
}
