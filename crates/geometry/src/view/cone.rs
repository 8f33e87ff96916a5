//! Convex cones of lines, as x sees a triangle or a target.

use glam::DVec3;

use crate::real::Real;
use crate::vector::{Vector, round};

/// A half-line from x: from the origin of the frame, or from a point of a footprint around it.
#[derive(Clone, Copy, Debug)]
pub struct Line<R> {
    /// Its direction, of any length.
    pub toward: Vector<R>,
    /// Where it starts.
    pub start: Start<R>,
}

/// Where lines start: at the origin, or beside it. What an `Option` would say, in two fields: an `Option` of vectors in lanes
/// is copied through memory, at addresses that stores cannot be forwarded from.
#[derive(Clone, Copy, Debug)]
pub struct Start<R> {
    moved: bool,
    point: Vector<R>,
}

impl<R: Real> Start<R> {
    /// The origin.
    #[inline(always)]
    pub(crate) fn origin() -> Self {
        Self { moved: false, point: Vector::splat([0.0; 3]) }
    }

    /// A point beside it.
    #[inline(always)]
    pub(crate) fn at(point: Vector<R>) -> Self {
        Self { moved: true, point }
    }

    /// The point.
    #[inline(always)]
    pub fn point(self) -> Vector<R> {
        self.point
    }

    /// The point, if it is not the origin.
    #[inline(always)]
    pub fn beside(self) -> Option<Vector<R>> {
        self.moved.then_some(self.point)
    }
}

/// The lines from x that pass through a convex polygon of three or four sides. What stands between x and a target, and
/// the outline of the target itself, are such cones.
///
/// A side that runs along e through a point p is, for lines from the origin, the plane with normal p × e. For a line that
/// starts at o with direction d it is the side product of Plücker coordinates d·(p × e) + (o × d)·e, whose sign says on
/// which side of each other the two lines pass. The normal is taken in binary64 by two products and a difference, so
/// triangles on either side of an edge have exactly opposite planes, and a direction on the edge belongs to both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    sides: [Side; 3],
    fourth: Option<Side>,
    /// The polygon's plane n·y = s, as n and s, where lines start on either side of it: beyond it, inside is outside.
    straddled: Option<([f32; 3], f32)>,
}

/// A side of a polygon: the line through p along e, the inside on its positive side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Side {
    /// p × e.
    normal: [f32; 3],
    /// e, of length one.
    along: [f32; 3],
}

impl Side {
    /// The side along `e` with normal p × e, both times the same factor.
    pub(crate) fn new(normal: DVec3, e: DVec3) -> Self {
        let scale = 1.0 / e.length();
        let scale = if scale.is_finite() { scale } else { 0.0 };
        Self { normal: round(normal * scale), along: round(e * scale) }
    }

    #[inline(always)]
    fn product<R: Real>(&self, line: &Line<R>) -> R {
        let product = Vector::splat(self.normal).dot(line.toward);
        match line.start.beside() {
            Some(start) => product + start.cross(line.toward).dot(Vector::splat(self.along)),
            None => product,
        }
    }
}

impl Cone {
    /// The cone within these sides: three or four.
    pub(crate) fn new(sides: impl IntoIterator<Item = Side>) -> Self {
        let mut sides = sides.into_iter();
        let first = std::array::from_fn(|_| sides.next().unwrap_or_default());
        Self { sides: first, fourth: sides.next(), straddled: None }
    }

    /// The same cone for lines that start on either side of the polygon's plane n·y = s; the sides are those seen from
    /// where n·y < s.
    pub(crate) fn straddled(self, n: DVec3, s: f64) -> Self {
        Self { straddled: Some((round(n), s as f32)), ..self }
    }

    /// Whether a line passes through the polygon or its boundary.
    #[inline(always)]
    pub fn holds<R: Real>(&self, line: &Line<R>) -> R::Mask {
        let zero = R::zero();
        let [a, b, c] = [self.sides[0].product(line), self.sides[1].product(line), self.sides[2].product(line)];
        let fourth = self.fourth.map(
            #[inline(always)]
            |side| side.product(line),
        );
        let mut inside = zero.le(a) & zero.le(b) & zero.le(c);
        if let Some(d) = fourth {
            inside = inside & zero.le(d);
        }
        let (Some((n, s)), Some(start)) = (self.straddled, line.start.beside()) else { return inside };
        let mut mirrored = a.le(zero) & b.le(zero) & c.le(zero);
        if let Some(d) = fourth {
            mirrored = mirrored & d.le(zero);
        }
        let beyond = R::splat(s).lt(Vector::splat(n).dot(start));
        (inside & !beyond) | (mirrored & beyond)
    }
}

/// The sides of a convex polygon, its corners in order in the frame of x: counter-clockwise as seen from where the
/// orientation is +1, clockwise where it is −1.
pub(crate) fn sides_of(corners: &[DVec3], inward: f64) -> impl Iterator<Item = Side> + '_ {
    let next = |k: usize| corners[(k + 1) % corners.len()];
    (0..corners.len()).map(move |k| Side::new(inward * corners[k].cross(next(k)), inward * (next(k) - corners[k])))
}

/// The inward normals of the planes through x and the edges of a polygon that is convex as x sees it, its corners in
/// order in the frame of x. An edge that points straight at x gives the zero vector, which bounds nothing.
pub(crate) fn edge_planes(corners: &[DVec3]) -> impl Iterator<Item = DVec3> + '_ {
    let inward = orientation(corners);
    let next = |k: usize| corners[(k + 1) % corners.len()];
    (0..corners.len()).map(move |k| inward * corners[k].cross(next(k)))
}

/// +1 if the corners run counter-clockwise as x sees them, −1 if clockwise.
pub(crate) fn orientation(corners: &[DVec3]) -> f64 {
    let [a, rest @ ..] = corners else { return 1.0 };
    let volume: f64 = rest.windows(2).map(|edge| a.dot(edge[0].cross(edge[1]))).sum();
    1.0_f64.copysign(volume)
}
