//! Walking the tree through a convex region.

use std::ops::ControlFlow;

use fearless_simd::{Simd, f32x8, prelude::*};

use super::Hierarchy;
use super::node::{FAN, Node, WIDTH};
use super::packet::Packet;
use super::probe::EPSILON;
use super::stack::{Stack, entry, parts};
use super::traverse::lanes;
use crate::tracer::Region;

/// Visits every triangle that touches the region, and possibly others.
#[inline(always)]
pub(super) fn within<S: Simd, T: Stack>(
    simd: S,
    tree: &Hierarchy,
    region: &Region,
    visit: &mut impl FnMut(u32) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let planes = Planes::new(region);
    let mut stack = T::new();
    let mut next = tree.root;
    while let Some(child) = next {
        if child.is_packet() {
            let touching = planes.packet(simd, &tree.packets[child.index()]);
            for lane in lanes::<WIDTH>(touching) {
                visit(tree.triangles[child.index()][lane])?;
            }
        } else {
            let node = &tree.nodes[child.index()];
            let touching = planes.node(simd, node);
            for slot in lanes::<FAN>(touching) {
                stack.push(entry(0.0, node.children[slot]));
            }
        }
        next = stack.pop().map(|entry| parts(entry).1);
    }
    ControlFlow::Continue(())
}

/// The half-spaces of a region in binary32.
///
/// With normals scaled to a largest component of 1, coordinates rounded relative to the region's rounded origin, and Q
/// the largest of them: n·(p − o) is wrong by at most 3ε|o| + 20εQ, from rounding o, p − o, n, three products and two
/// sums. What lies outside by more than 4ε|o| + 24εQ and the rounding of the offset is outside.
struct Planes {
    origin: [f32; 3],
    planes: Vec<Plane>,
}

/// n·(p − o) <= offset, the offset grown by the rounding of o and of itself.
struct Plane {
    normal: [f32; 3],
    offset: f32,
}

impl Planes {
    fn new(region: &Region) -> Self {
        let origin = region.origin.as_vec3().to_array();
        let most = region.origin.abs().max_element();
        let mut planes = Vec::with_capacity(region.half_spaces.len());
        planes.extend(region.half_spaces.iter().filter_map(|&(normal, offset)| {
            let length = normal.abs().max_element();
            let (normal, offset) = if length > 0.0 { (normal / length, offset / length) } else { (normal, offset) };
            let grown = offset + f64::from(EPSILON) * (4.0 * most + 2.0 * offset.abs());
            (normal.is_finite() && grown.is_finite())
                .then(|| Plane { normal: normal.as_vec3().to_array(), offset: grown as f32 })
        }));
        Self { origin, planes }
    }

    /// The children whose boxes may touch the region, a bit each.
    #[inline(always)]
    fn node<S: Simd>(&self, simd: S, node: &Node) -> u32 {
        let [x, y, z] = self.origin;
        let low = [node.face(simd, 0) - x, node.face(simd, 1) - y, node.face(simd, 2) - z];
        let high = [node.face(simd, 3) - x, node.face(simd, 4) - y, node.face(simd, 5) - z];
        let blur = largest(low).max(largest(high)) * (24.0 * EPSILON);
        let mut touching = low[0].simd_le(high[0]);
        for plane in &self.planes {
            touching &= !plane.excludes(plane.nearest(low, high), blur);
        }
        touching.to_bitmask() as u32
    }

    /// The triangles that may touch the region, a bit each.
    #[inline(always)]
    fn packet<S: Simd>(&self, simd: S, packet: &Packet) -> u32 {
        let [a, b, c] = [self.vertex(simd, packet, 0), self.vertex(simd, packet, 1), self.vertex(simd, packet, 2)];
        let blur = largest(a).max(largest(b)).max(largest(c)) * (24.0 * EPSILON);
        let mut touching = a[0].simd_eq(a[0]);
        for plane in &self.planes {
            touching &= !(plane.excludes(a, blur) & plane.excludes(b, blur) & plane.excludes(c, blur));
        }
        touching.to_bitmask() as u32
    }

    /// A vertex of all triangles, relative to the origin.
    #[inline(always)]
    fn vertex<S: Simd>(&self, simd: S, packet: &Packet, v: usize) -> [f32x8<S>; 3] {
        let [x, y, z] = self.origin;
        [packet.row(simd, v, 0) - x, packet.row(simd, v, 1) - y, packet.row(simd, v, 2) - z]
    }
}

/// The largest magnitude of the coordinates.
#[inline(always)]
fn largest<S: Simd, V: SimdFloat<S, Element = f32>>([x, y, z]: [V; 3]) -> V {
    x.abs().max(y.abs()).max(z.abs())
}

impl Plane {
    /// The corner of boxes that is farthest inside.
    #[inline(always)]
    fn nearest<V: Copy>(&self, low: [V; 3], high: [V; 3]) -> [V; 3] {
        let mut nearest = high;
        for k in 0..3 {
            if self.normal[k] > 0.0 {
                nearest[k] = low[k];
            }
        }
        nearest
    }

    /// Which points are outside by more than rounding can be.
    #[inline(always)]
    fn excludes<S: Simd, V: SimdFloat<S, Element = f32>>(&self, point: [V; 3], blur: V) -> V::Mask {
        let [x, y, z] = point;
        let along = x * self.normal[0] + y * self.normal[1] + z * self.normal[2];
        along.simd_gt(blur + self.offset)
    }
}
