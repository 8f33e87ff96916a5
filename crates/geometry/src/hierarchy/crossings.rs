//! Where a ray crosses eight triangles, in binary32, and what that tells of the answer in binary64.

use fearless_simd::{Simd, f32x8, mask32x8, prelude::*};

use super::packet::Packet;
use super::probe::{EPSILON, Probe, SIGN};
use crate::blocking::TOLERANCE;

/// The test of Woop, Benthin, Wald 2013 ("Watertight Ray/Triangle Intersection") in binary32, with what rounding can do.
///
/// With ε = 2⁻²⁴, |o| the origin's largest coordinate, A = |a_z| as computed, and L the largest extent: a triangle that is
/// met has all its vertices within A + 2L of the origin along every axis, and its sheared ones within 2L of the ray.
///
/// - A sheared coordinate is wrong by at most δ = ε(6(A + 2L) + 2|o|), from rounding o, v − o, the slope, the product
///   and the difference.
/// - An edge function, of two products of coordinates below 2L, is wrong by at most 8Lδ + 2δ² + 16εL². That is below
///   m = d(L + d) with d = 8ε(8A + 16L + 4|o|). `f32::MIN_POSITIVE` stands for products that underflow.
/// - Σ u·z, the sum of the edge functions times depths, differs from t'·Σ u by at most 3m(A + 2L) + (|Σ u| + 8m) d,
///   whatever sign a Σ u below 3m has. A triangle in a square of side 2L has |Σ u| <= 4L² + 3m, and m >= dL, so that
///   m(6A + 12L + 12d) is more; `f32::MIN_POSITIVE` again for what underflows.
pub(super) struct Crossings<S: Simd> {
    /// The least and the greatest of the edge functions u, v, w.
    least: f32x8<S>,
    most: f32x8<S>,
    /// m.
    margin: f32x8<S>,
    /// |Σ u|.
    sum: f32x8<S>,
    /// Σ u·z, with the sign that the distance has.
    along: f32x8<S>,
    /// m(6A + 12L + 12d).
    slack: f32x8<S>,
    /// The larger of |a_x| and |a_y|.
    aside: f32x8<S>,
}

impl<S: Simd> Crossings<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, packet: &Packet, probe: &Probe) -> Self {
        let vertex = |v: usize| sheared(simd, packet, probe, v);
        let ([ax, ay, az], [bx, by, bz], [cx, cy, cz]) = (vertex(0), vertex(1), vertex(2));
        let u = cx.mul_sub(by, cy * bx);
        let v = ax.mul_sub(cy, ay * cx);
        let w = bx.mul_sub(ay, by * ax);

        let (depth, extent) = (az.abs(), packet.extent());
        let d = depth.mul_add(64.0 * EPSILON, f32x8::splat(simd, 128.0 * EPSILON * extent + probe.blur));
        let margin = d.mul_add(d + extent, f32x8::splat(simd, f32::MIN_POSITIVE));
        let far = depth.mul_add(6.0, d.mul_add(12.0, f32x8::splat(simd, 12.0 * extent)));
        let slack = far.mul_add(margin, f32x8::splat(simd, f32::MIN_POSITIVE));

        let sum = u + v + w;
        let moment = u.mul_add(az, v.mul_add(bz, w * cz));
        let flip = (sum.to_bits() ^ probe.backward) & SIGN;
        let along = f32x8::from_bits(moment.to_bits() ^ flip);
        let (least, most, aside) = (u.min(v).min(w), u.max(v).max(w), ax.abs().max(ay.abs()));
        Self { least, most, margin, sum: sum.abs(), along, slack, aside }
    }

    /// The triangles that the ray may meet at a distance up to `reach`, a bit each: all that
    /// [`Ray::distance`](crate::ray::Ray::distance) finds there, and others only within rounding.
    #[inline(always)]
    pub(super) fn possible(&self, probe: &Probe, reach: f32) -> u32 {
        let behind = (self.along + self.slack).simd_lt(0.0);
        let beyond = (self.along - self.slack).simd_gt(self.sum * (probe.depth * reach));
        mask(self.crossed() & !(behind | beyond))
    }

    /// The triangles that the ray's line may cross, before its origin, behind it or beyond its end, a bit each.
    #[inline(always)]
    pub(super) fn inside(&self) -> u32 {
        mask(self.crossed())
    }

    #[inline(always)]
    fn crossed(&self) -> mask32x8<S> {
        self.least.simd_ge(-self.margin) | self.most.simd_le(self.margin)
    }

    /// The triangles that the ray surely meets at a distance below `before`, and whose planes surely do not hold its
    /// origin, a bit each.
    ///
    /// Where a is within 2L of the ray, the others are within 4L, and what is wrong is at most four times what it is above.
    /// A plane is clear of the origin where the volume |Σ u·z| is beyond 4 tolerances times L² and the largest coordinate,
    /// and 2⁻⁴² L² more (see [`clears_plane`](crate::blocking::clears_plane)): here, beyond 8.
    #[inline(always)]
    pub(super) fn certain(&self, packet: &Packet, probe: &Probe, before: f32) -> u32 {
        const CLEAR: f32 = 8.0 * TOLERANCE as f32;
        let (margin, slack, extent) = (self.margin * 4.0, self.slack * 4.0, packet.extent());
        let inside = self.least.simd_gt(margin) | self.most.simd_lt(-margin);
        let near = self.aside.simd_le(2.0 * extent);
        let clear = (self.along - slack).simd_gt(CLEAR * probe.magnitude * extent * extent);
        let short = (self.along + slack).simd_lt(self.sum * (probe.depth * before));
        mask(inside & near & clear & short)
    }
}

#[inline(always)]
fn mask<S: Simd>(lanes: mask32x8<S>) -> u32 {
    lanes.to_bitmask() as u32
}

/// Vertex `v` of all triangles, translated by the origin and sheared along the ray; its depth is not divided by d_z.
#[inline(always)]
fn sheared<S: Simd>(simd: S, packet: &Packet, probe: &Probe, v: usize) -> [f32x8<S>; 3] {
    let [x, y, z] = probe.axes;
    let depth = packet.row(simd, v, z) - probe.origin[2];
    let x = packet.row(simd, v, x) - probe.origin[0];
    let y = packet.row(simd, v, y) - probe.origin[1];
    [depth.mul_add(probe.slope[0], x), depth.mul_add(probe.slope[1], y), depth]
}
