//! Where a direction meets the plane of a target.

use glam::DVec3;
use twoforms_geometry::real::Real;
use twoforms_geometry::segment::SurfacePoint;
use twoforms_geometry::vector::{Vector, round};

/// Three orthonormal axes in the frame of x.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axes(pub(crate) [DVec3; 3]);

/// Numbers in a row.
pub(crate) const ROW: usize = 14;

/// A plane as directions along some axes meet it: the axes, the direction to the plane along them, its distance, and the least
/// m·Ψ of a direction toward the target.
pub(crate) fn row(axes: &Axes, corners: &[DVec3]) -> [f32; ROW] {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
    let toward = normal * 1.0_f64.copysign(normal.dot(corners[0]));
    let depth = toward.dot(corners[0]);
    let reach = corners.iter().map(|corner| corner.length()).fold(0.0, f64::max);
    let [x, y, z] = axes.0;
    let local = DVec3::new(x.dot(toward), y.dot(toward), z.dot(toward));
    let mut row = [0.0; ROW];
    for (slot, vector) in row.chunks_exact_mut(3).zip([x, y, z, local]) {
        slot.copy_from_slice(&round(vector));
    }
    row[12] = depth as f32;
    row[13] = (depth / reach) as f32;
    row
}

/// The point y of the plane along a direction, given along the axes by a vector of any length near one: r = s / (m·Ψ).
#[inline(always)]
pub(crate) fn point<R: Real>(row: &[R; ROW], along: Vector<R>, target: R::Word) -> SurfacePoint<R> {
    let [xx, xy, xz, yx, yy, yz, zx, zy, zz, mx, my, mz, depth, least] = *row;
    let toward = Vector::new(mx, my, mz).dot(along);
    let r = depth / R::select(least.lt(toward), toward, least);
    let psi = Vector::new(xx, xy, xz) * along.x + Vector::new(yx, yy, yz) * along.y + Vector::new(zx, zy, zz) * along.z;
    SurfacePoint { position: psi * r, depth, target }
}
