//! A target as x meets it.

use glam::DVec3;

use super::cone::{Cone, sides_of};
use crate::blocking;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::real::{Mask, Real};
use crate::segment::SurfacePoint;
use crate::target::{Shape, Sides};
use crate::vector::{Direction, Vector, round};

/// Numbers in a row of the table of facets.
pub(crate) const ROW: usize = 17;

/// A target in the frame of x: the map from the unit square onto it, and its plane.
///
/// y(s, t) = a + s·e + t·f + st·g. A parallelogram abcd has e = b − a, f = d − a, g = a − b + c − d (its vertices are
/// rounded, so g is some units in the last place); a triangle abc has e = b − a, f = 0, g = c − b, and s the square root
/// of a uniform number.
#[derive(Clone, Copy, Debug)]
pub struct Facet<R> {
    origin: Vector<R>,
    e: Vector<R>,
    f: Vector<R>,
    g: Vector<R>,
    /// Unit vector from x straight toward the plane.
    toward: Vector<R>,
    /// N_y·(x − y): distance of x from the plane on the side that emits; negative on the dark side of a one-sided target.
    depth: R,
    /// 1 for a triangle, 0 for a parallelogram.
    triangle: R,
}

impl<R: Real> Facet<R> {
    #[inline(always)]
    pub(crate) fn from_row(row: [R; ROW]) -> Self {
        let [ox, oy, oz, ex, ey, ez, fx, fy, fz, gx, gy, gz, tx, ty, tz, depth, triangle] = row;
        Self {
            origin: Vector::new(ox, oy, oz),
            e: Vector::new(ex, ey, ez),
            f: Vector::new(fx, fy, fz),
            g: Vector::new(gx, gy, gz),
            toward: Vector::new(tx, ty, tz),
            depth,
            triangle,
        }
    }

    /// The same facet from a point `start` of a footprint around x.
    #[inline(always)]
    pub(crate) fn seen_from(self, start: Vector<R>) -> Self {
        let nearer = self.depth - self.toward.dot(start);
        let depth = R::select(R::zero().lt(self.depth), nearer, self.depth);
        Self { origin: self.origin - start, depth, ..self }
    }

    /// The point that two uniform numbers pick, uniform over the area. `target` is the facet's own index.
    #[inline(always)]
    pub fn point(&self, [u, v]: [R; 2], target: R::Word) -> SurfacePoint<R> {
        let is_triangle = R::zero().lt(self.triangle);
        let s = if is_triangle.any() { R::select(is_triangle, u.sqrt(), u) } else { u };
        let position = self.origin + self.e * s + self.f * v + self.g * (s * v);
        SurfacePoint { position, depth: self.depth, target }
    }

    /// The point of the facet's plane along Ψ: r = s / (m·Ψ), s the distance of the plane and m the direction to it.
    #[inline(always)]
    pub fn point_along(&self, psi: Direction<R>, target: R::Word) -> SurfacePoint<R> {
        let r = self.depth / self.toward.dot(psi.vector());
        SurfacePoint { position: psi.vector() * r, depth: self.depth, target }
    }
}

/// A facet in binary64, from which the rounded ones come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wide {
    corners: [DVec3; 4],
    count: usize,
    toward: DVec3,
    depth: f64,
}

impl Facet<f32> {
    /// The facet of a target in the frame of x, in binary64.
    pub(crate) fn wide(geometry: &Geometry, frame: &Frame, target: u32) -> Wide {
        let mesh = geometry.mesh();
        let target = &geometry.targets()[target as usize];
        let world = target.corners(mesh);
        let count = world.as_slice().len();
        let corner = |k: usize| frame.localize(world.as_slice()[k.min(count - 1)].as_dvec3());
        let corners = [corner(0), corner(1), corner(2), corner(3)];
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
        let distance = -normal.dot(corners[0]);
        let first = match target.shape {
            Shape::Triangle(t) | Shape::Parallelogram { triangles: [t, _], .. } => mesh.triangle(t),
        };
        let depth = match target.sides {
            _ if blocking::plane_holds(&first, frame.x()) => 0.0,
            Sides::Front => distance,
            Sides::Both => distance.abs(),
        };
        Wide { corners, count, toward: normal * -1.0_f64.copysign(distance), depth }
    }
}

impl Wide {
    /// The corners in the frame of x.
    pub(crate) fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }

    /// The cone of lines that meet it.
    pub(crate) fn outline(&self) -> Cone {
        Cone::new(sides_of(self.corners()))
    }

    /// Whether the points of a footprint are all on x's side of the plane, or all in it where x is.
    pub(crate) fn has_on_one_side(&self, footprint: &[DVec3]) -> bool {
        let distance = |v: &DVec3| self.plane_distance() - self.toward.dot(*v);
        let reach = footprint.iter().map(|v| v.length()).fold(0.0, f64::max);
        if self.depth == 0.0 {
            footprint.iter().all(|v| distance(v).abs() <= 1e-6 * reach)
        } else {
            footprint.iter().all(|v| distance(v) > 1e-6 * reach)
        }
    }

    /// Whether x is on a side that emits.
    pub(crate) fn faces_x(&self) -> bool {
        self.depth > 0.0
    }

    /// Whether light can come from it: x on a side that emits, and some of the target above x's horizon.
    pub(crate) fn lit(&self) -> bool {
        self.faces_x() && self.corners().iter().any(|corner| corner.z > 0.0)
    }

    /// Distance of x from the plane.
    pub(crate) fn plane_distance(&self) -> f64 {
        self.toward.dot(self.corners[0])
    }

    /// Unit vector from x straight toward the plane.
    pub(crate) fn toward(&self) -> DVec3 {
        self.toward
    }

    /// Where the plane lies along a local line, in units of its direction.
    pub(crate) fn distance_along(&self, start: DVec3, toward: DVec3) -> f64 {
        (self.plane_distance() - self.toward.dot(start)) / self.toward.dot(toward)
    }

    pub(crate) fn row(&self) -> [f32; ROW] {
        let [a, b, c, d] = self.corners;
        let (f, g) = if self.count == 3 { (DVec3::ZERO, c - b) } else { (d - a, a - b + c - d) };
        let vectors = [a, b - a, f, g, self.toward];
        let mut row = [0.0; ROW];
        for (slot, vector) in row.chunks_exact_mut(3).zip(vectors) {
            slot.copy_from_slice(&round(vector));
        }
        row[15] = self.depth as f32;
        row[16] = if self.count == 3 { 1.0 } else { 0.0 };
        row
    }
}
