//! The bounding-volume hierarchy: built by obvhs, traversed here in binary64.
//!
//! obvhs's own traversal is not used, since it is not watertight and takes binary32 rays. This is the only file that
//! knows obvhs.

use std::ops::ControlFlow;
use std::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::{Boundable, BvhBuildParams};

use crate::mesh::{Mesh, Triangle};
use crate::ray::{Hit, Ray};
use crate::tracer::{Region, Tracer, meet};

/// A binary hierarchy over the triangles of one mesh.
pub struct Hierarchy {
    tree: Bvh2,
}

impl Hierarchy {
    /// Builds the hierarchy, in parallel.
    pub fn new(mesh: &Mesh) -> Self {
        let boxes: Vec<Bounds> = (0..mesh.len() as u32).map(|t| Bounds::of(&mesh.triangle(t))).collect();
        let params = BvhBuildParams { pre_split: false, ..BvhBuildParams::medium_build() };
        Self { tree: build_bvh2(&boxes, params, &mut Duration::default()) }
    }

    /// Visits the triangles of every leaf whose boxes `enter` lets in, nearer children first. `enter` gives a box's
    /// distance, or `None` to skip it; a box farther than `reach` by the time its turn comes is skipped too.
    #[inline]
    fn walk(
        &self,
        enter: impl Fn(DVec3, DVec3) -> Option<f64>,
        reach: impl Fn() -> f64,
        mut visit: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let nodes = &self.tree.nodes;
        let approach = |index: u32| {
            let bounds = nodes.get(index as usize)?.aabb;
            enter(bounds.min.as_dvec3(), bounds.max.as_dvec3()).map(|distance| (distance, index))
        };
        let mut stack = Stack::new();
        stack.extend(approach(0));
        while let Some((distance, index)) = stack.pop() {
            if distance > reach() {
                continue;
            }
            let node = &nodes[index as usize];
            if node.is_leaf() {
                let leaf = node.first_index as usize..(node.first_index + node.prim_count) as usize;
                self.tree.primitive_indices[leaf].iter().try_for_each(|&t| visit(t))?;
            } else {
                let (left, right) = (approach(node.first_index), approach(node.first_index + 1));
                let swap = matches!((left, right), (Some(l), Some(r)) if l.0 < r.0);
                stack.extend(if swap { right } else { left });
                stack.extend(if swap { left } else { right });
            }
        }
        ControlFlow::Continue(())
    }
}

impl Tracer for Hierarchy {
    fn closest(&self, mesh: &Mesh, ray: &Ray) -> Option<Hit> {
        let slabs = Slabs::new(ray);
        let best = std::cell::Cell::new(None::<Hit>);
        let _ = self.walk(
            |low, high| slabs.enter(low, high),
            || best.get().map_or(f64::INFINITY, |hit| hit.t * (1.0 + SLACK)),
            |index| {
                if let Some(hit) = meet(mesh, ray, index)
                    && best.get().is_none_or(|best| hit.before(&best))
                {
                    best.set(Some(hit));
                }
                ControlFlow::Continue(())
            },
        );
        best.get()
    }

    fn any(&self, mesh: &Mesh, ray: &Ray, before: f64, blocks: impl Fn(u32) -> bool) -> bool {
        let slabs = Slabs::new(ray);
        let found = self.walk(
            |low, high| slabs.enter(low, high),
            || before * (1.0 + SLACK),
            |index| {
                let hit = meet(mesh, ray, index).is_some_and(|hit| hit.t < before && blocks(index));
                if hit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
        );
        found.is_break()
    }

    fn within(&self, _: &Mesh, region: &Region, visit: impl FnMut(u32) -> ControlFlow<()>) {
        let _ = self.walk(|low, high| (!region.misses(low, high)).then_some(0.0), || 0.0, visit);
    }
}

/// A ray against boxes.
struct Slabs {
    origin: DVec3,
    inverse: DVec3,
}

/// What rounding may add to a distance along a ray, relative: entering a box takes three roundings, and a triangle's
/// distance takes some tens of them against terms of its own size.
const SLACK: f64 = 1e-12;

/// Takes the place of a component of the direction that is zero, so that no product is 0·∞.
const TINY: f64 = 1e-200;
/// How far the faces of a box move apart, so that a ray within a face meets the box: next to nothing in any scene, but
/// much where the ray does not move at all.
const FACE: f64 = 1e-100;

impl Slabs {
    fn new(ray: &Ray) -> Self {
        let inverse = ray.direction.to_array().map(|d| 1.0 / if d.abs() < TINY { TINY.copysign(d) } else { d });
        Self { origin: ray.origin, inverse: DVec3::from_array(inverse) }
    }

    /// Distance at which the ray enters the box, if it meets it.
    #[inline]
    fn enter(&self, low: DVec3, high: DVec3) -> Option<f64> {
        let (one, other) = ((low - self.origin - FACE) * self.inverse, (high - self.origin + FACE) * self.inverse);
        let near = one.min(other).max_element().max(0.0);
        let far = one.max(other).min_element();
        (near <= far * (1.0 + SLACK)).then_some(near)
    }
}

/// Nodes yet to be visited, with their distances; deeper trees than the fixed part holds spill to the heap.
struct Stack {
    fixed: [(f64, u32); 64],
    len: usize,
    spilled: Vec<(f64, u32)>,
}

impl Stack {
    fn new() -> Self {
        Self { fixed: [(0.0, 0); 64], len: 0, spilled: Vec::new() }
    }

    #[inline]
    fn extend(&mut self, node: Option<(f64, u32)>) {
        let Some(node) = node else { return };
        if let Some(slot) = self.fixed.get_mut(self.len) {
            *slot = node;
            self.len += 1;
        } else {
            self.spilled.push(node);
        }
    }

    #[inline]
    fn pop(&mut self) -> Option<(f64, u32)> {
        self.spilled.pop().or_else(|| {
            self.len = self.len.checked_sub(1)?;
            Some(self.fixed[self.len])
        })
    }
}

struct Bounds(Aabb);

impl Bounds {
    fn of(triangle: &Triangle) -> Self {
        let corners = [triangle.a, triangle.b, triangle.c].map(Vec3A::from);
        Self(Aabb::from_points(&corners))
    }
}

impl Boundable for Bounds {
    fn aabb(&self) -> Aabb {
        self.0
    }
}
