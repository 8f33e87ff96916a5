//! Walking the tree through a convex region.

use std::ops::ControlFlow;

use fearless_simd::{Simd, f32x8, prelude::*};

use super::Hierarchy;
use super::node::Node;
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
            for lane in lanes(touching) {
                visit(tree.triangles[child.index()][lane])?;
            }
        } else {
            let node = &tree.nodes[child.index()];
            let touching = planes.node(simd, node);
            for slot in lanes(touching) {
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
        let planes = region.half_spaces.iter().filter_map(|&(normal, offset)| {
            let length = normal.abs().max_element();
            let (normal, offset) = if length > 0.0 { (normal / length, offset / length) } else { (normal, offset) };
            let grown = offset + f64::from(EPSILON) * (4.0 * most + 2.0 * offset.abs());
            (normal.is_finite() && grown.is_finite())
                .then(|| Plane { normal: normal.as_vec3().to_array(), offset: grown as f32 })
        });
        Self { origin, planes: planes.collect() }
    }

    /// The children whose boxes may touch the region, a bit each.
    #[inline(always)]
    fn node<S: Simd>(&self, simd: S, node: &Node) -> u32 {
        let face = |row: usize| node.face(simd, row) - self.origin[row % 3];
        let low = [face(0), face(1), face(2)];
        let high = [face(3), face(4), face(5)];
        let size = |k: usize| high[k].max(-low[k]);
        let blur = size(0).max(size(1)).max(size(2)) * (24.0 * EPSILON);
        let mut touching = low[0].simd_le(high[0]);
        for plane in &self.planes {
            let nearest = |k: usize| if plane.normal[k] > 0.0 { low[k] } else { high[k] };
            touching &= !plane.excludes([nearest(0), nearest(1), nearest(2)], blur);
        }
        touching.to_bitmask() as u32
    }

    /// The triangles that may touch the region, a bit each.
    #[inline(always)]
    fn packet<S: Simd>(&self, simd: S, packet: &Packet) -> u32 {
        let vertex = |v: usize| {
            let coordinate = |k: usize| packet.row(simd, v, k) - self.origin[k];
            [coordinate(0), coordinate(1), coordinate(2)]
        };
        let vertices = [vertex(0), vertex(1), vertex(2)];
        let size = |v: usize| vertices[v][0].abs().max(vertices[v][1].abs()).max(vertices[v][2].abs());
        let blur = size(0).max(size(1)).max(size(2)) * (24.0 * EPSILON);
        let mut touching = vertices[0][0].simd_eq(vertices[0][0]);
        for plane in &self.planes {
            let [a, b, c] = vertices;
            touching &= !(plane.excludes(a, blur) & plane.excludes(b, blur) & plane.excludes(c, blur));
        }
        touching.to_bitmask() as u32
    }
}

impl Plane {
    /// Which points are outside by more than rounding can be.
    #[inline(always)]
    fn excludes<S: Simd>(&self, point: [f32x8<S>; 3], blur: f32x8<S>) -> <f32x8<S> as SimdBase<S>>::Mask {
        let [x, y, z] = point;
        let along = x * self.normal[0] + y * self.normal[1] + z * self.normal[2];
        along.simd_gt(blur + self.offset)
    }
}
