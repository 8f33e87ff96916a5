//! The geometry of a scene: y = vp(x, Ψ) and V(x, y).

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::Arc;

use glam::DVec3;

use crate::blocking;
use crate::clusters::Clusters;
use crate::hierarchy::Hierarchy;
use crate::mesh::{Mesh, Triangle};
use crate::ray::{Hit, Ray};
use crate::target::Target;
use crate::tracer::{BruteForce, Region, Tracer};

/// A mesh, its targets, and a tracer that finds triangles.
pub struct Geometry {
    mesh: Arc<Mesh>,
    targets: Vec<Target>,
    clusters: Clusters,
    tracer: AnyTracer,
    /// The target each emitting triangle belongs to.
    target_of: HashMap<u32, u32>,
    /// For each target, its own triangles and those coplanar with it nearby, ascending: they do not block it.
    spared: Vec<Box<[u32]>>,
    /// For each triangle that does not emit, the targets coplanar with it nearby.
    flush: HashMap<u32, Vec<u32>>,
}

impl Geometry {
    /// Builds the hierarchy over the mesh and relates targets to what is coplanar with them.
    ///
    /// Targets must refer to triangles of the mesh, and no triangle may belong to two.
    pub fn new(mesh: impl Into<Arc<Mesh>>, targets: Vec<Target>) -> Self {
        let mesh = mesh.into();
        let tracer = AnyTracer::Hierarchy(Hierarchy::new(&mesh));
        Self::with_tracer(mesh, targets, tracer)
    }

    /// The same geometry without a hierarchy: every question is asked of every triangle. The truth to test against.
    pub fn brute_force(mesh: impl Into<Arc<Mesh>>, targets: Vec<Target>) -> Self {
        Self::with_tracer(mesh.into(), targets, AnyTracer::BruteForce(BruteForce))
    }

    fn with_tracer(mesh: Arc<Mesh>, targets: Vec<Target>, tracer: AnyTracer) -> Self {
        let target_of: HashMap<u32, u32> =
            (0..).zip(&targets).flat_map(|(k, target)| target.triangles().map(move |t| (t, k))).collect();
        let spared: Vec<Box<[u32]>> = targets.iter().map(|target| spared_by(&mesh, &tracer, target)).collect();
        let mut flush: HashMap<u32, Vec<u32>> = HashMap::new();
        for (k, triangles) in (0..).zip(&spared) {
            for triangle in triangles.iter().filter(|t| !target_of.contains_key(t)) {
                flush.entry(*triangle).or_default().push(k);
            }
        }
        let clusters = Clusters::new(&mesh, &targets);
        Self { mesh, targets, clusters, tracer, target_of, spared, flush }
    }

    /// All triangles.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// All targets, in scene order.
    pub fn targets(&self) -> &[Target] {
        &self.targets
    }

    /// The targets in clusters of neighbours.
    pub fn clusters(&self) -> &Clusters {
        &self.clusters
    }

    /// y = vp(x, Ψ): the first surface that the ray meets. Where an emitter is coplanar with it and the ray meets both,
    /// the emitter. None too where the direction is not finite, or zero.
    #[inline]
    pub fn vp(&self, ray: &Ray) -> Option<Hit> {
        if !ray.leads() {
            return None;
        }
        self.tracer.closest(&self.mesh, ray).map(|hit| self.emitter_or(ray, hit))
    }

    /// y = vp(x, Ψ) of each ray, as [`Self::vp`] gives them: sooner where neighbours run alike, as those of a camera do.
    pub fn vp_of(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        if !rays.iter().all(Ray::leads) {
            return rays.iter().zip(hits).for_each(|(ray, hit)| *hit = self.vp(ray));
        }
        self.tracer.closest_of(&self.mesh, rays, hits);
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = hit.map(|hit| self.emitter_or(ray, hit));
        }
    }

    /// V(x, y) for the point y at distance `before` along the ray from x, on target `target`: whether nothing that may
    /// block this target stands between.
    pub fn visible(&self, ray: &Ray, before: f64, target: u32) -> bool {
        !ray.leads() || !self.tracer.any(&self.mesh, ray, before, |triangle| self.may_block(triangle, target))
    }

    /// Whether the ray meets any surface at a distance below `before`.
    pub fn blocked(&self, ray: &Ray, before: f64) -> bool {
        ray.leads() && self.tracer.any(&self.mesh, ray, before, |_| true)
    }

    /// Whether a triangle may stand between a target and what sees it: it is neither part of the target nor coplanar with it.
    pub fn may_block(&self, triangle: u32, target: u32) -> bool {
        self.spared[target as usize].binary_search(&triangle).is_err()
    }

    /// The emitting triangles nearby that lie in the plane of a triangle that does not emit.
    pub(crate) fn emitters_flush_with(&self, triangle: u32) -> impl Iterator<Item = u32> + '_ {
        let targets = self.flush.get(&triangle).into_iter().flatten();
        targets.flat_map(|&target| self.targets[target as usize].triangles())
    }

    /// The target that a triangle belongs to.
    pub fn target_of(&self, triangle: u32) -> Option<u32> {
        self.target_of.get(&triangle).copied()
    }

    /// Visits every triangle that touches the region, and possibly others.
    pub fn within(&self, region: &Region, visit: impl FnMut(u32) -> ControlFlow<()>) {
        self.tracer.within(&self.mesh, region, visit);
    }

    /// The emitter that is coplanar with what is met, where the ray meets it too.
    #[inline]
    fn emitter_or(&self, ray: &Ray, hit: Hit) -> Hit {
        let emitter = self.flush.get(&hit.triangle).and_then(|targets| self.emitter_among(ray, targets));
        emitter.unwrap_or(hit)
    }

    fn emitter_among(&self, ray: &Ray, targets: &[u32]) -> Option<Hit> {
        let triangles = targets.iter().flat_map(|&k| self.targets[k as usize].triangles());
        let hits = triangles.filter_map(|t| ray.distance(&self.mesh.triangle(t)).map(|d| Hit { t: d, triangle: t }));
        hits.reduce(|best, hit| if hit.before(&best) { hit } else { best })
    }
}

/// The target's own triangles and all coplanar ones whose boxes touch its box.
fn spared_by(mesh: &Mesh, tracer: &AnyTracer, target: &Target) -> Box<[u32]> {
    let own: Vec<Triangle> = target.triangles().map(|t| mesh.triangle(t)).collect();
    let mut spared: Vec<u32> = target.triangles().collect();
    let near = around(&own);
    tracer.within(mesh, &near, |index| {
        let triangle = mesh.triangle(index);
        let (low, high) = bounds(&[triangle]);
        if !near.misses(low, high) && own.iter().any(|own| blocking::coplanar(own, &triangle)) {
            spared.push(index);
        }
        ControlFlow::Continue(())
    });
    spared.sort_unstable();
    spared.dedup();
    spared.into_boxed_slice()
}

/// The bounding box of the triangles, grown by the tolerance of coplanarity.
fn around(triangles: &[Triangle]) -> Region {
    let (low, high) = bounds(triangles);
    let magnitude = triangles.iter().map(Triangle::magnitude).fold(0.0, f64::max);
    let grown = DVec3::splat(blocking::TOLERANCE * magnitude);
    let (low, high) = (low - grown, high + grown);
    let half_spaces = [DVec3::X, DVec3::Y, DVec3::Z]
        .iter()
        .flat_map(|&axis| [(axis, axis.dot(high)), (-axis, -axis.dot(low))])
        .collect();
    Region { origin: DVec3::ZERO, half_spaces }
}

fn bounds(triangles: &[Triangle]) -> (DVec3, DVec3) {
    let all = triangles.iter().flat_map(Triangle::vertices);
    let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    all.fold(none, |(low, high), v| (low.min(v), high.max(v)))
}

/// Which tracer serves a geometry.
enum AnyTracer {
    Hierarchy(Hierarchy),
    BruteForce(BruteForce),
}

impl Tracer for AnyTracer {
    #[inline]
    fn closest(&self, mesh: &Mesh, ray: &Ray) -> Option<Hit> {
        match self {
            Self::Hierarchy(tracer) => tracer.closest(mesh, ray),
            Self::BruteForce(tracer) => tracer.closest(mesh, ray),
        }
    }

    fn closest_of(&self, mesh: &Mesh, rays: &[Ray], hits: &mut [Option<Hit>]) {
        match self {
            Self::Hierarchy(tracer) => tracer.closest_of(mesh, rays, hits),
            Self::BruteForce(tracer) => tracer.closest_of(mesh, rays, hits),
        }
    }

    #[inline]
    fn any(&self, mesh: &Mesh, ray: &Ray, before: f64, blocks: impl Fn(u32) -> bool) -> bool {
        match self {
            Self::Hierarchy(tracer) => tracer.any(mesh, ray, before, blocks),
            Self::BruteForce(tracer) => tracer.any(mesh, ray, before, blocks),
        }
    }

    fn within(&self, mesh: &Mesh, region: &Region, visit: impl FnMut(u32) -> ControlFlow<()>) {
        match self {
            Self::Hierarchy(tracer) => tracer.within(mesh, region, visit),
            Self::BruteForce(tracer) => tracer.within(mesh, region, visit),
        }
    }
}
