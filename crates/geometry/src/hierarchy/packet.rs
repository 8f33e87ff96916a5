//! A leaf of the wide tree: eight triangles side by side.

use fearless_simd::{Simd, f32x8, prelude::*};
use glam::Vec3;

use super::node::WIDTH;
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

    /// L: the largest extent of any of the triangles along an axis.
    #[inline(always)]
    pub(super) fn extent(&self) -> f32 {
        self.extent
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
}
