//! The bounding-volume hierarchy: a tree whose nodes have sixteen children and whose leaves hold eight triangles.
//!
//! **The lanes propose, binary64 decides.** Sixteen boxes or eight triangles at a time are held against a ray in binary32, in
//! tests that grant what rounding can do, so that nothing is lost; what they let through is asked again in binary64, by
//! the very test that [`BruteForce`] asks of every triangle. So every answer is that of brute force to the last bit, on
//! every machine, whatever instructions it has and in whatever order the tree is walked, and the binary32 tests are free
//! to fuse, reorder and round as suits the machine.

mod best;
mod binary;
mod bundle;
mod collapse;
mod crossings;
mod node;
mod packet;
mod probe;
mod stack;
#[cfg(test)]
mod tests;
mod traverse;
mod within;

use std::ops::ControlFlow;

use fearless_simd::{Level, dispatch};

use self::binary::Binary;
use self::collapse::Collapse;
use self::node::{Child, Node, WIDTH};
use self::packet::Packet;
use self::probe::{HUGE, STEPS};
use self::stack::{Depth, Fixed, Growing};
use crate::mesh::Mesh;
use crate::ray::{Hit, Ray};
use crate::tracer::{BruteForce, Region, Tracer};

/// A wide hierarchy over the triangles of one mesh.
pub struct Hierarchy {
    nodes: Vec<Node>,
    packets: Vec<Packet>,
    /// For each packet, the triangles in its lanes.
    triangles: Vec<[u32; WIDTH]>,
    /// A node, if there is any triangle.
    root: Option<Child>,
    /// The largest coordinate of the mesh.
    magnitude: f32,
    /// Rays whose origins are closer to 0 than the root of this are held against lanes.
    limit: f64,
    /// The stack that walks need.
    depth: Depth,
    level: Level,
}

/// Compiles a walk for each set of instructions and each kind of stack, and runs the one that this machine and this tree
/// need.
macro_rules! walk {
    ($tree:expr, $simd:ident, $stack:ident => $walk:expr) => {
        match $tree.depth {
            Depth::Shallow => {
                type $stack = Fixed<{ Depth::SHALLOW }>;
                dispatch!($tree.level, $simd => $walk)
            }
            Depth::Middling => {
                type $stack = Fixed<{ Depth::MIDDLING }>;
                dispatch!($tree.level, $simd => $walk)
            }
            Depth::Deep => {
                type $stack = Growing;
                dispatch!($tree.level, $simd => $walk)
            }
        }
    };
}

impl Hierarchy {
    /// Builds the hierarchy, on all threads, for the best instructions that this machine has.
    pub fn new(mesh: &Mesh) -> Self {
        Self::with_level(mesh, Level::new())
    }

    /// Builds the hierarchy for given instructions.
    pub fn with_level(mesh: &Mesh, level: Level) -> Self {
        let magnitude = mesh.bounds().map_or(0.0, |(low, high)| low.abs().max(high.abs()).max_element());
        let limit = if f64::from(magnitude) < HUGE { HUGE * HUGE } else { 0.0 };
        let (nodes, packets, triangles) = (Vec::new(), Vec::new(), Vec::new());
        let mut hierarchy =
            Self { nodes, packets, triangles, root: None, magnitude, limit, depth: Depth::Shallow, level };
        let binary = Binary::new(mesh);
        if binary.len() > 0 {
            hierarchy.fill(mesh, &binary, &Collapse::new(&binary));
            hierarchy.depth = Depth::of(hierarchy.pending());
        }
        hierarchy
    }

    /// Makes nodes and packets, each node's own next to each other, subtree after subtree; the root is a node even above a
    /// single packet.
    fn fill(&mut self, mesh: &Mesh, binary: &Binary, collapse: &Collapse) {
        let top = self.make(mesh, collapse, 0);
        let mut unfinished = Vec::new();
        if top.is_packet() {
            let mut node = Node::EMPTY;
            node.put(0, top, binary.bounds(0));
            self.nodes.push(node);
        } else {
            unfinished.push((top, 0));
        }
        self.root = Some(Child::node(0));
        while let Some((child, place)) = unfinished.pop() {
            let mut node = Node::EMPTY;
            for (slot, part) in collapse.parts(place).into_iter().enumerate() {
                let child = self.make(mesh, collapse, part);
                node.put(slot, child, binary.bounds(part));
                if !child.is_packet() {
                    unfinished.push((child, part));
                }
            }
            self.nodes[child.index()] = node;
        }
        self.nodes.shrink_to_fit();
        self.packets.shrink_to_fit();
        self.triangles.shrink_to_fit();
    }

    /// Makes what a subtree becomes; a node is still without children.
    fn make(&mut self, mesh: &Mesh, collapse: &Collapse, part: u32) -> Child {
        if !collapse.is_packet(part) {
            self.nodes.push(Node::EMPTY);
            return Child::node(self.nodes.len() - 1);
        }
        let triangles = collapse.triangles(part);
        let mut lanes = [u32::MAX; WIDTH];
        lanes[..triangles.len()].copy_from_slice(&triangles);
        self.triangles.push(lanes);
        self.packets.push(Packet::new(triangles.iter().map(|&t| mesh.triangle(t))));
        Child::packet(self.packets.len() - 1)
    }

    /// The most entries that the stack of a walk may hold.
    fn pending(&self) -> usize {
        let (mut most, mut left) = (0, vec![(self.root, 1)]);
        while let Some((child, pending)) = left.pop() {
            most = most.max(pending);
            let node = child.filter(|child| !child.is_packet()).map(|child| &self.nodes[child.index()]);
            let children = node.iter().flat_map(|node| node.children()).collect::<Vec<_>>();
            left.extend(children.iter().map(|&child| (Some(child), pending - 1 + children.len())));
        }
        most
    }

    /// Whether lanes can hold the ray as it is.
    #[inline(always)]
    fn holds(&self, ray: &Ray) -> bool {
        self.reaches(ray) & STEPS.contains(&ray.direction.length_squared())
    }

    /// Whether lanes can hold rays from the origin of this one: beyond, products overflow, and brute force answers.
    #[inline(always)]
    fn reaches(&self, ray: &Ray) -> bool {
        ray.origin.length_squared() < self.limit
    }

    #[inline(always)]
    fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        walk!(self, simd, Pending => traverse::closest::<_, Pending>(simd, self, ray))
    }

    /// The nearest triangle along a ray that lanes can't hold as it is.
    #[cold]
    #[inline(never)]
    fn closest_otherwise(&self, mesh: &Mesh, ray: &Ray) -> Option<Hit> {
        if !ray.leads() || !self.reaches(ray) {
            return BruteForce.closest(mesh, ray);
        }
        let (ray, unit) = ray.scaled();
        self.closest_hit(&ray).map(|hit| Hit { t: hit.t / unit, ..hit })
    }

    /// Whether a ray that lanes can't hold as it is is blocked.
    #[cold]
    #[inline(never)]
    fn any_otherwise(&self, mesh: &Mesh, ray: &Ray, before: f64, blocks: &impl Fn(u32) -> bool) -> bool {
        if !ray.leads() || !self.reaches(ray) {
            return BruteForce.any(mesh, ray, before, blocks);
        }
        let (ray, unit) = ray.scaled();
        self.any_hit(&ray, before * unit, blocks)
    }

    #[inline(always)]
    fn any_hit(&self, ray: &Ray, before: f64, blocks: &impl Fn(u32) -> bool) -> bool {
        walk!(self, simd, Pending => traverse::any::<_, Pending>(simd, self, ray, before, blocks))
    }
}

impl Tracer for Hierarchy {
    #[inline]
    fn closest(&self, mesh: &Mesh, ray: &Ray) -> Option<Hit> {
        if self.holds(ray) { self.closest_hit(ray) } else { self.closest_otherwise(mesh, ray) }
    }

    fn closest_of(&self, mesh: &Mesh, rays: &[Ray], hits: &mut [Option<Hit>]) {
        for (rays, hits) in rays.chunks(WIDTH).zip(hits.chunks_mut(WIDTH)) {
            let plain = rays.iter().all(|ray| self.holds(ray));
            let together = plain && walk!(self, simd, Pending => bundle::closest::<_, Pending>(simd, self, rays, hits));
            if !together {
                for (ray, hit) in rays.iter().zip(hits) {
                    *hit = self.closest(mesh, ray);
                }
            }
        }
    }

    #[inline]
    fn any(&self, mesh: &Mesh, ray: &Ray, before: f64, blocks: impl Fn(u32) -> bool) -> bool {
        if self.holds(ray) {
            self.any_hit(ray, before, &blocks)
        } else {
            self.any_otherwise(mesh, ray, before, &blocks)
        }
    }

    fn within(&self, _: &Mesh, region: &Region, mut visit: impl FnMut(u32) -> ControlFlow<()>) {
        let _ = walk!(self, simd, Pending => within::within::<_, Pending>(simd, self, region, &mut visit));
    }
}
