//! Finding triangles: nearest along a ray, any before a distance, all within a convex region.

use std::ops::ControlFlow;

use glam::DVec3;

use crate::blocking;
use crate::mesh::{Mesh, Triangle};
use crate::ray::{Hit, Ray, Shear};

/// Answers questions about the triangles of a mesh. Every answer is a function of the question alone: it depends neither
/// on the order of traversal nor on which tracer is asked. A triangle whose plane holds the ray's origin is never met
/// (see [`blocking`]), nor is any by a ray whose direction is not finite or zero.
pub trait Tracer {
    /// The nearest triangle along the ray.
    fn closest(&self, mesh: &Mesh, ray: &Ray) -> Option<Hit>;

    /// The nearest triangle along each ray, as [`Self::closest`] gives them: sooner where neighbours run alike.
    fn closest_of(&self, mesh: &Mesh, rays: &[Ray], hits: &mut [Option<Hit>]) {
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.closest(mesh, ray);
        }
    }

    /// Whether the ray meets a triangle at a distance below `before` for which `blocks` holds.
    fn any(&self, mesh: &Mesh, ray: &Ray, before: f64, blocks: impl Fn(u32) -> bool) -> bool;

    /// Visits every triangle that touches the region, and possibly others, each at least once.
    fn within(&self, mesh: &Mesh, region: &Region, visit: impl FnMut(u32) -> ControlFlow<()>);
}

/// Distance of the ray's meeting with a triangle, under the blocking rule.
#[inline(always)]
pub(crate) fn meet(triangle: &Triangle, ray: &Ray, shear: &Shear) -> Option<f64> {
    let t = shear.distance(triangle)?;
    (!blocking::plane_holds(triangle, ray.origin)).then_some(t)
}

/// A convex region: the points p with n·(p − origin) <= offset for each of its half-spaces.
#[derive(Clone, Debug)]
pub struct Region {
    /// The point that the half-spaces are measured from, world metres.
    pub origin: DVec3,
    /// Outward normals, of any length, and offsets along them.
    pub half_spaces: Vec<(DVec3, f64)>,
}

impl Region {
    /// Whether the box lies wholly outside one of the half-spaces, so that no point of it is in the region.
    #[inline]
    pub fn misses(&self, low: DVec3, high: DVec3) -> bool {
        let (low, high) = (low - self.origin, high - self.origin);
        self.half_spaces.iter().any(|(n, offset)| {
            let nearest = DVec3::select(n.cmpgt(DVec3::ZERO), low, high);
            n.dot(nearest) > *offset
        })
    }
}

/// Asks every triangle: slow, and right by inspection.
#[derive(Clone, Copy, Debug, Default)]
pub struct BruteForce;

impl Tracer for BruteForce {
    fn closest(&self, mesh: &Mesh, ray: &Ray) -> Option<Hit> {
        if !ray.leads() {
            return None;
        }
        let shear = Shear::new(ray);
        let hit = |triangle| meet(&mesh.triangle(triangle), ray, &shear).map(|t| Hit { t, triangle });
        let hits = (0..mesh.len() as u32).filter_map(hit);
        hits.reduce(|best, hit| if hit.before(&best) { hit } else { best })
    }

    fn any(&self, mesh: &Mesh, ray: &Ray, before: f64, blocks: impl Fn(u32) -> bool) -> bool {
        let shear = Shear::new(ray);
        ray.leads()
            && (0..mesh.len() as u32)
                .filter(|&index| blocks(index))
                .any(|index| meet(&mesh.triangle(index), ray, &shear).is_some_and(|t| t < before))
    }

    fn within(&self, mesh: &Mesh, _: &Region, mut visit: impl FnMut(u32) -> ControlFlow<()>) {
        let _ = (0..mesh.len() as u32).try_for_each(&mut visit);
    }
}
