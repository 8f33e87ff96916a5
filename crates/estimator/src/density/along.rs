//! Where a direction meets the plane of a target.

use glam::DVec3;
use twoforms_geometry::real::{Real, at_least};
use twoforms_geometry::segment::SurfacePoint;
use twoforms_geometry::vector::{Vector, round};

/// Three orthonormal axes in the frame of x.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axes(pub(crate) [DVec3; 3]);

impl Axes {
    /// Those of the frame itself.
    pub(crate) const OF_X: Self = Self([DVec3::X, DVec3::Y, DVec3::Z]);
}

/// Numbers in the row of a plane.
pub(crate) const PLANE: usize = 5;
/// Numbers in the row of a plane and of axes.
pub(crate) const ROW: usize = 9 + PLANE;

/// A plane as directions along some axes meet it: the direction to the plane along them, its distance, and the least m·Ψ of a
/// direction toward the target.
pub(crate) fn plane(axes: &Axes, corners: &[DVec3]) -> [f32; PLANE] {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
    let toward = normal * 1.0_f64.copysign(normal.dot(corners[0]));
    let depth = toward.dot(corners[0]);
    let reach = corners.iter().map(|corner| corner.length()).fold(0.0, f64::max);
    let [x, y, z] = axes.0.map(|axis| axis.dot(toward) as f32);
    [x, y, z, depth as f32, (depth / reach) as f32]
}

/// The axes, then the plane.
pub(crate) fn row(axes: &Axes, corners: &[DVec3]) -> [f32; ROW] {
    let mut row = [0.0; ROW];
    for (slot, axis) in row.chunks_exact_mut(3).zip(axes.0) {
        slot.copy_from_slice(&round(axis));
    }
    row[9..].copy_from_slice(&plane(axes, corners));
    row
}

/// The point y of the plane along a direction, given along the axes by a vector of any length near one.
#[inline(always)]
pub(crate) fn point<R: Real>(row: &[R; ROW], along: Vector<R>, target: R::Word) -> SurfacePoint<R> {
    let [xx, xy, xz, yx, yy, yz, zx, zy, zz, mx, my, mz, depth, least] = *row;
    let psi = Vector::new(xx, xy, xz) * along.x + Vector::new(yx, yy, yz) * along.y + Vector::new(zx, zy, zz) * along.z;
    point_along(&[mx, my, mz, depth, least], along, psi, target)
}

/// A vector in the frame of x, along the axes.
#[inline(always)]
pub(crate) fn along<R: Real>(row: &[R; ROW], v: Vector<R>) -> Vector<R> {
    let [xx, xy, xz, yx, yy, yz, zx, zy, zz, ..] = *row;
    Vector::new(Vector::new(xx, xy, xz).dot(v), Vector::new(yx, yy, yz).dot(v), Vector::new(zx, zy, zz).dot(v))
}

/// The point y of the plane along Ψ, given along the axes and in the frame of x: r = s / (m·Ψ).
#[inline(always)]
pub(crate) fn point_along<R: Real>(
    plane: &[R; PLANE],
    along: Vector<R>,
    psi: Vector<R>,
    target: R::Word,
) -> SurfacePoint<R> {
    let [x, y, z, depth, least] = *plane;
    let r = depth / at_least(Vector::new(x, y, z).dot(along), least);
    SurfacePoint { position: psi * r, depth, target }
}
