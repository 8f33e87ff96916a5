//! The one rule for what blocks and what does not.
//!
//! - Every triangle blocks on both faces, emitters too.
//! - A triangle whose plane holds x blocks nothing.
//! - A triangle coplanar with a light's does not block that light; where both are met at one distance, the emitter wins.
//!
//! "Holds" and "coplanar" mean: |distance| <= 4 · 2⁻²⁴ × the largest coordinate magnitude involved, which is what the
//! rounding of world vertices to binary32 can move. There is no other tolerance and no fixed epsilon: rays, the
//! [`View`](crate::view::View) and exact light all ask the functions of this file.

use glam::DVec3;

use crate::mesh::Triangle;
use crate::ray::Crossing;

/// 4 · 2⁻²⁴: the tolerance per metre of coordinate magnitude.
pub const TOLERANCE: f64 = 4.0 / 16_777_216.0;

/// Whether the plane of `triangle` holds `x` (metres), so that the triangle blocks nothing that x sees.
///
/// |N·(x − a)| <= tolerance × magnitude × |N| with N = (b − a) × (c − a).
pub fn plane_holds(triangle: &Triangle, x: DVec3) -> bool {
    within(triangle, x, magnitude(triangle, x))
}

/// How far from a triangle's plane x may lie and still be held by it, in metres.
pub fn reach(triangle: &Triangle, x: DVec3) -> f64 {
    TOLERANCE * magnitude(triangle, x)
}

fn magnitude(triangle: &Triangle, x: DVec3) -> f64 {
    triangle.magnitude().max(x.abs().max_element())
}

/// Whether a triangle that a ray crosses is so far off the ray's origin that its plane cannot hold it, all coordinates
/// being at most `magnitude` and the triangle's extents along the axes at most `extent`.
///
/// |N| <= 3 L², so that |N·(x − a)| above 4/3 of 3 L² times tolerance and magnitude is enough. The volume, a sum of three
/// products of three numbers, is wrong by less than 2⁻⁴⁶ (aside + 2L)² times the magnitude.
#[inline(always)]
pub(crate) fn clears_plane(crossing: &Crossing, magnitude: f64, extent: f64) -> bool {
    const ROUNDING: f64 = 1.0 / (1_u64 << 46) as f64;
    let reach = crossing.aside + 2.0 * extent;
    crossing.volume > magnitude * (4.0 * TOLERANCE * extent * extent + ROUNDING * reach * reach)
}

/// Whether two triangles lie in one plane: all vertices of one within the tolerance of the other's plane. Either may be
/// the one whose plane is taken, since the plane of a small triangle is known too poorly to be extended across a large one.
pub fn coplanar(one: &Triangle, other: &Triangle) -> bool {
    let magnitude = one.magnitude().max(other.magnitude());
    let lies_in = |t: &Triangle, plane: &Triangle| t.vertices().iter().all(|&v| within(plane, v, magnitude));
    lies_in(one, other) || lies_in(other, one)
}

fn within(plane: &Triangle, point: DVec3, magnitude: f64) -> bool {
    let normal = plane.cross();
    let offset = normal.dot(point - plane.a.as_dvec3()).abs();
    offset <= TOLERANCE * magnitude * normal.length()
}
