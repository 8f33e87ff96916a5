//! What an eye sees through a small window.

use std::ops::ControlFlow;

use glam::DVec3;

use super::cone::{Cone, Line, Start, edge_planes, orientation, sides_of};
use super::polygon::clipped;
use crate::blocking;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::masked::Masked;
use crate::real::{Mask, Real, Word};
use crate::tracer::Region;
use crate::vector::{Vector, round};
use crate::veil::Cover;

/// Most triangles that are held against every line; beyond, rays are cast.
const MANY_PANES: usize = 24;
/// Most candidates looked at before gathering is given up.
const MANY_CANDIDATES: usize = 8 * MANY_PANES;

/// The triangles in the pyramid from an eye through a window, so that vp(eye, Ψ) for many directions is a few dot products
/// with the planes of each. In the frame of the eye.
#[derive(Clone, Debug)]
pub struct Vista {
    panes: Vec<Pane>,
}

/// A triangle seen through a window.
#[derive(Clone, Debug)]
pub struct Pane {
    /// Which triangle.
    pub triangle: u32,
    /// The part of it in the pyramid, whatever stands before it: a convex polygon, metres.
    pub outline: Vec<DVec3>,
    cone: Cone,
    /// n/s of its plane n·y = s: the plane lies at t along d where 1/t = (n/s)·d.
    per_t: [f32; 3],
}

/// Where a line from the eye first meets a surface.
#[derive(Clone, Copy, Debug)]
pub struct Glimpse<R: Real> {
    /// Which pane.
    pub pane: R::Word,
    /// 1/t, t the distance in units of the line's direction.
    pub per_t: R,
}

impl Vista {
    /// What the eye at the origin of `eye` sees between four directions in order around the window, in its frame.
    ///
    /// None where that is too much, where a light lies in the plane of another surface there, which takes a ray to tell apart,
    /// or where a surface there is not opaque.
    pub fn new(geometry: &Geometry, eye: &Frame, corners: &[DVec3; 4]) -> Option<Self> {
        let inward: Vec<DVec3> = edge_planes(corners).collect();
        let ahead: DVec3 = corners.iter().map(|c| c.normalize_or_zero()).sum();
        let mut panes: Vec<Pane> = Vec::new();
        let mut candidates = 0;
        let mut too_many = false;
        geometry.within(&region(eye, &inward, ahead), |triangle| {
            candidates += 1;
            panes.extend(Pane::new(geometry, eye, &inward, triangle));
            too_many = candidates > MANY_CANDIDATES || panes.len() > MANY_PANES;
            if too_many { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        panes.sort_by_key(|pane| pane.triangle);
        panes.dedup_by_key(|pane| pane.triangle);
        let among = |t: u32| panes.iter().any(|pane| pane.triangle == t);
        let ambiguous = panes.iter().any(|pane| geometry.emitters_flush_with(pane.triangle).any(among));
        let veiled = panes.iter().any(|pane| geometry.cover(pane.triangle) != Cover::Opaque);
        (!too_many && !ambiguous && !veiled).then_some(Self { panes })
    }

    /// The triangles, by index in the mesh.
    pub fn panes(&self) -> &[Pane] {
        &self.panes
    }

    /// The first surface along each direction (of any length); of several at one distance the first in the mesh.
    #[inline(always)]
    pub fn look<R: Real>(&self, toward: Vector<R>) -> Masked<Glimpse<R>, R> {
        let line = Line { toward, start: Start::origin() };
        let (mut per_t, mut pane) = (R::zero(), R::Word::splat(0));
        for (k, candidate) in self.panes.iter().enumerate() {
            let here = Vector::splat(candidate.per_t).dot(toward);
            let nearer = candidate.cone.holds(&line) & per_t.lt(here);
            if nearer.any() {
                per_t = R::select(nearer, here, per_t);
                pane = R::select_word(nearer, R::Word::splat(k as u32), pane);
            }
        }
        Masked::new(Glimpse { pane, per_t }, R::zero().lt(per_t))
    }
}

impl Pane {
    fn new(geometry: &Geometry, eye: &Frame, inward: &[DVec3], index: u32) -> Option<Self> {
        let triangle = geometry.mesh().triangle(index);
        if blocking::plane_holds(&triangle, eye.x()) {
            return None;
        }
        let corners = triangle.vertices().map(|v| eye.localize(v));
        let [a, b, c] = corners;
        let outline = inward.iter().fold(corners.to_vec(), |polygon, inward| clipped(&polygon, |p| inward.dot(p)));
        let n = (b - a).cross(c - a);
        let per_t = round(n / n.dot(a));
        (outline.len() > 2).then(|| Self {
            triangle: index,
            outline,
            cone: Cone::new(sides_of(&corners, orientation(&corners))),
            per_t,
        })
    }

    /// The vectors q with q·d/((n/s)·d) = u·(t d − x): they give the coordinate along u of the point of the triangle's
    /// plane along d, from the point `x` of that plane.
    pub fn coordinate(&self, u: DVec3, x: DVec3) -> [f32; 3] {
        let [x_, y, z] = self.per_t.map(f64::from);
        round(u - DVec3::new(x_, y, z) * u.dot(x))
    }
}

fn region(eye: &Frame, inward: &[DVec3], ahead: DVec3) -> Region {
    let planes = inward.iter().chain([&ahead]);
    Region { origin: eye.x(), half_spaces: planes.map(|&inward| (eye.to_world(-inward), 0.0)).collect() }
}
