//! A leaf of the wide tree: eight triangles side by side.

use fearless_simd::{Simd, f32x8, prelude::*};
use glam::Vec3;

use super::node::WIDTH;
use super::probe::{EPSILON, Probe, SIGN};
use crate::blocking;
use crate::mesh::Triangle;
use crate::ray::{Ray, Shear};

/// Up to eight triangles. Row 3v + k holds coordinate k of their vertices v; lanes without a triangle hold NaN.
#[repr(C, align(64))]
pub(super) struct Packet {
    rows: [[f32; WIDTH]; 9],
    /// L: the largest extent of any of the triangles along an axis.
    extent: f32,
}

impl Packet {
    /// Up to eight triangles side by side.
    pub(super) fn new(triangles: impl Iterator<Item = Triangle>) -> Self {
        let mut packet = Self { rows: [[f32::NAN; WIDTH]; 9], extent: 0.0 };
        for (lane, Triangle { a, b, c }) in triangles.enumerate() {
            for (v, vertex) in [a, b, c].iter().enumerate() {
                for k in 0..3 {
                    packet.rows[3 * v + k][lane] = vertex[k];
                }
            }
            let extent = (a.max(b).max(c) - a.min(b).min(c)).max_element();
            packet.extent = packet.extent.max(extent);
        }
        packet
    }

    /// The triangle in a lane.
    fn triangle(&self, lane: usize) -> Triangle {
        let vertex = |v: usize| Vec3::new(self.rows[v][lane], self.rows[v + 1][lane], self.rows[v + 2][lane]);
        Triangle { a: vertex(0), b: vertex(3), c: vertex(6) }
    }

    /// Eight triangles' coordinate `k` of vertex `v`.
    #[inline(always)]
    pub(super) fn row<S: Simd>(&self, simd: S, v: usize, k: usize) -> f32x8<S> {
        f32x8::from_slice(simd, &self.rows[3 * v + k])
    }

    /// Distance of the ray's meeting with the triangle in a lane, under the blocking rule: as
    /// [`meet`](crate::tracer::meet), which it asks only where the answer is not plain. No coordinate is beyond `magnitude`.
    #[inline(always)]
    pub(super) fn meet(&self, lane: usize, ray: &Ray, shear: &Shear, magnitude: f64) -> Option<f64> {
        let crossing = shear.crossing(|v, axis| self.rows[3 * v + axis][lane])?;
        let clear = blocking::clears_plane(&crossing, magnitude, f64::from(self.extent));
        (clear || !self.holds(lane, ray)).then_some(crossing.t)
    }

    /// Whether the plane of the triangle in a lane holds the ray's origin.
    #[cold]
    fn holds(&self, lane: usize, ray: &Ray) -> bool {
        blocking::plane_holds(&self.triangle(lane), ray.origin)
    }

    /// The triangles that the ray may meet within reach, a bit each: all that
    /// [`Ray::distance`](crate::ray::Ray::distance) finds there, and others only within rounding.
    ///
    /// The same test (Woop, Benthin, Wald 2013) in binary32, in which each comparison grants what rounding can do. With
    /// ε = 2⁻²⁴, |o| the origin's largest coordinate, A = |a_z| as computed, and L the largest extent: a triangle that is
    /// met has all its vertices within A + 2L of the origin along every axis, and its sheared ones within 2L of the ray.
    ///
    /// - A sheared coordinate is wrong by at most δ = ε(6(A + 2L) + 2|o|), from rounding o, v − o, the slope, the product
    ///   and the difference.
    /// - An edge function, of two products of coordinates below 2L, is wrong by at most 8Lδ + 2δ² + 16εL². That is below
    ///   m = d(L + d) with d = 8ε(8A + 16L + 4|o|). `f32::MIN_POSITIVE` stands for products that underflow.
    /// - Σ u·z, the sum of the edge functions times depths, differs from t'·Σ u by at most 3m(A + 2L) + (|Σ u| + 8m) d,
    ///   whatever sign a Σ u below 3m has. A triangle in a square of side 2L has |Σ u| <= 4L² + 3m, and m >= dL, so that
    ///   m(6A + 12L + 12d) is more.
    #[inline(always)]
    pub(super) fn candidates<S: Simd>(&self, simd: S, probe: &Probe, reach: f32) -> u32 {
        let ([ax, ay, az], [bx, by, bz], [cx, cy, cz]) =
            (self.sheared(simd, probe, 0), self.sheared(simd, probe, 1), self.sheared(simd, probe, 2));
        let u = cx.mul_sub(by, cy * bx);
        let v = ax.mul_sub(cy, ay * cx);
        let w = bx.mul_sub(ay, by * ax);

        let depth = az.abs();
        let d = depth.mul_add(64.0 * EPSILON, f32x8::splat(simd, 128.0 * EPSILON * self.extent + probe.blur));
        let m = d.mul_add(d + self.extent, f32x8::splat(simd, f32::MIN_POSITIVE));
        let slack = depth.mul_add(6.0, d.mul_add(12.0, f32x8::splat(simd, 12.0 * self.extent))) * m;
        let inside = u.min(v).min(w).simd_ge(-m) | u.max(v).max(w).simd_le(m);

        let sum = u + v + w;
        let moment = u.mul_add(az, v.mul_add(bz, w * cz));
        let flip = (sum.to_bits() ^ probe.backward) & SIGN;
        let along = f32x8::from_bits(moment.to_bits() ^ flip);
        let behind = (along + slack).simd_lt(0.0);
        let beyond = (along - slack).simd_gt(sum.abs() * (probe.depth * reach));
        (inside & !(behind | beyond)).to_bitmask() as u32
    }

    /// Vertex `v` of all triangles, translated by the origin and sheared along the ray; its depth is not divided by d_z.
    #[inline(always)]
    fn sheared<S: Simd>(&self, simd: S, probe: &Probe, v: usize) -> [f32x8<S>; 3] {
        let [x, y, z] = probe.axes;
        let depth = self.row(simd, v, z) - probe.origin[2];
        let x = self.row(simd, v, x) - probe.origin[0];
        let y = self.row(simd, v, y) - probe.origin[1];
        [depth.mul_add(probe.slope[0], x), depth.mul_add(probe.slope[1], y), depth]
    }
}
