//! A target as x meets it.

use glam::DVec3;

use super::cone::{Cone, orientation, sides_of};
use crate::blocking;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::mesh::Triangle;
use crate::real::{Mask, Real};
use crate::segment::SurfacePoint;
use crate::target::Sides;
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

    /// The same facet for every sample.
    #[inline(always)]
    pub(crate) fn splat(row: &[f32; ROW]) -> Self {
        let mut numbers = [R::zero(); ROW];
        for k in 0..ROW {
            numbers[k] = R::splat(row[k]);
        }
        Self::from_row(numbers)
    }

    /// The same facet from a point `start` of a footprint around x.
    #[inline(always)]
    pub(crate) fn seen_from(self, start: Vector<R>) -> Self {
        Self { origin: self.origin - start, depth: self.depth - self.toward.dot(start), ..self }
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

/// How x lies to a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// No light comes from it: x lies off it and does not face a side that emits, or all of it lies below x's horizon. So too
    /// where x lies in its plane, beside it or on a side that emits and looks out from there: light then comes along that
    /// plane alone, which is the limit of what comes where x is moved off the plane to the side it faces.
    Dark,
    /// Light comes from it, unless something stands between: x is on a side that emits, some of it above x's horizon.
    Lit,
    /// x lies on the dark side of a one-sided target and faces away from the side that emits: no light comes from it. At a
    /// point of no surface, which might as well lie just before the other side, nobody can tell.
    OnBack,
    /// x lies on the target, and some of it rises above x's horizon: what comes from it jumps there.
    On,
}

/// A facet in binary64, from which the rounded ones come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wide {
    corners: [DVec3; 4],
    count: usize,
    toward: DVec3,
    depth: f64,
    standing: Standing,
    /// Whether it is taken as seen from the other side than x's.
    turned: bool,
}

/// How far beside a plane a footprint may lie, over its extent, and count as in it.
const BESIDE: f64 = 1e-6;

impl Facet<f32> {
    /// The facet of a target in the frame of x, in binary64.
    pub(crate) fn wide(geometry: &Geometry, frame: &Frame, target: u32) -> Wide {
        let mesh = geometry.mesh();
        let target = &geometry.targets()[target as usize];
        let corners = target.corners(mesh);
        let corners = corners.as_slice().iter().map(|corner| frame.localize(corner.as_dvec3()));
        Wide::new(corners, target.sides, &mesh.triangle(target.first()), frame.x())
    }
}

impl Wide {
    /// A target with these corners in the frame of `x`, three or four; `plane` is a triangle of it in world space.
    pub(crate) fn new(corners: impl Iterator<Item = DVec3>, sides: Sides, plane: &Triangle, x: DVec3) -> Self {
        let (mut at, mut count) = ([DVec3::ZERO; 4], 0);
        for (slot, corner) in at.iter_mut().zip(corners) {
            *slot = corner;
            count += 1;
        }
        let normal = (at[1] - at[0]).cross(at[2] - at[0]).normalize_or_zero();
        let distance = -normal.dot(at[0]);
        let toward = normal * -1.0_f64.copysign(distance);
        let held = blocking::plane_holds(plane, x);
        let depth = match sides {
            _ if held => 0.0,
            Sides::Front => distance,
            Sides::Both => distance.abs(),
        };
        let mut wide = Self { corners: at, count, toward, depth, standing: Standing::Dark, turned: false };
        wide.standing = if held {
            wide.standing_in_plane(normal, sides, blocking::reach(plane, x))
        } else {
            wide.standing_off_plane()
        };
        wide
    }

    /// The corners in the frame of x.
    pub(crate) fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }

    /// The cone of lines that meet it.
    pub(crate) fn outline(&self) -> Cone {
        Cone::new(sides_of(
            self.corners(),
            if self.turned { -orientation(self.corners()) } else { orientation(self.corners()) },
        ))
    }

    /// The same target for all points of a footprint: where some of them lie before a one-sided target and some behind,
    /// its plane is taken as those before it see it. None where they lie on both sides of a two-sided one, or some in its
    /// plane.
    pub(crate) fn over(self, sides: Sides, footprint: &[DVec3]) -> Option<Self> {
        let height = |v: &DVec3| self.depth - self.toward.dot(*v);
        let reach = BESIDE * footprint.iter().map(|v| v.length()).fold(0.0, f64::max);
        if self.depth == 0.0 {
            let flat = footprint.iter().all(|v| self.toward.dot(*v).abs() <= reach);
            return flat.then_some(Self { toward: DVec3::ZERO, ..self });
        }
        match sides {
            Sides::Both => footprint.iter().all(|v| height(v) > reach).then_some(self),
            Sides::Front => {
                let turned = self.depth < 0.0;
                let seen = Self { toward: if turned { -self.toward } else { self.toward }, turned, ..self };
                let lit = footprint.iter().any(|v| seen.height(*v) > reach) && self.rises(0.0);
                Some(Self { standing: if lit { Standing::Lit } else { Standing::Dark }, ..seen })
            }
        }
    }

    /// How far a point lies from the plane, on x's side or on the side that emits.
    pub(crate) fn height(&self, point: DVec3) -> f64 {
        self.depth - self.toward.dot(point)
    }

    /// Whether x is on a side that emits.
    pub(crate) fn faces_x(&self) -> bool {
        self.depth > 0.0
    }

    /// Whether light can come from it: x on a side that emits, and some of the target above x's horizon.
    pub(crate) fn lit(&self) -> bool {
        self.standing == Standing::Lit
    }

    /// How x lies to it.
    pub(crate) fn standing(&self) -> Standing {
        self.standing
    }

    fn standing_off_plane(&self) -> Standing {
        if self.faces_x() && self.rises(0.0) { Standing::Lit } else { Standing::Dark }
    }

    /// Where its plane holds x; `reach` is how far from a plane a point may lie to be held by it.
    fn standing_in_plane(&self, normal: DVec3, sides: Sides, reach: f64) -> Standing {
        let (rises, on_back) = (self.rises(reach), sides == Sides::Front && normal.z < -blocking::TOLERANCE);
        match (self.holds_x(normal, reach), on_back, rises) {
            (false, ..) | (true, false, false) => Standing::Dark,
            (true, true, _) => Standing::OnBack,
            (true, false, true) => Standing::On,
        }
    }

    /// Whether a corner lies more than `height` above x's horizon.
    fn rises(&self, height: f64) -> bool {
        self.corners().iter().any(|corner| corner.z > height)
    }

    /// Whether x, which lies in its plane, lies within its outline or no farther from it than `reach`.
    fn holds_x(&self, normal: DVec3, reach: f64) -> bool {
        let corners = self.corners();
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).all(|(&v, &w)| normal.cross(w - v).normalize_or_zero().dot(v) <= reach)
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
