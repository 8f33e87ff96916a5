//! The geometry of a scene: y = vp(x, Ψ) and V(x, y).

use std::cell::{Cell, RefCell};
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
use crate::veil::{Cover, Veil};

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
    /// How triangles block, where not all of them are opaque.
    veil: Option<Veil>,
}

/// A surface that a line of sight meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Which, and where.
    pub hit: Hit,
    /// The share of the light from behind that it stops: more than 0, at most 1.
    pub share: f32,
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
        Self { mesh, targets, clusters, tracer, target_of, spared, flush, veil: None }
    }

    /// The same geometry with triangles that are not opaque.
    pub fn with_veil(self, veil: Option<Veil>) -> Self {
        Self { veil, ..self }
    }

    /// How a triangle blocks.
    #[inline]
    pub fn cover(&self, triangle: u32) -> Cover {
        self.veil.as_ref().map_or(Cover::Opaque, |veil| veil.cover(triangle))
    }

    /// Whether some triangles are not opaque.
    pub fn is_veiled(&self) -> bool {
        self.veil.is_some()
    }

    /// Whether some of a target is cut out.
    pub fn is_cut(&self, target: u32) -> bool {
        self.is_veiled() && self.targets[target as usize].triangles().any(|t| self.cover(t) == Cover::Cut)
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

    /// y = vp(x, Ψ): the first surface that the ray meets and does not pass. Where an emitter is coplanar with it and the ray
    /// meets both, the emitter. None too where the direction is not finite, or zero.
    #[inline]
    pub fn vp(&self, ray: &Ray) -> Option<Hit> {
        match &self.veil {
            None => self.tracer.closest(&self.mesh, ray).map(|hit| self.emitter_or(ray, hit)),
            Some(veil) => self.first_that_ends(veil, ray),
        }
    }

    /// y = vp(x, Ψ) of each ray, as [`Self::vp`] gives them: sooner where neighbours run alike, as those of a camera do.
    pub fn vp_of(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        if self.is_veiled() {
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
        if let Some(veil) = &self.veil {
            let ends = |triangle| self.may_block(triangle, target) && self.ends(veil, ray, triangle);
            return !self.tracer.any(&self.mesh, ray, before, ends);
        }
        !self.tracer.any(&self.mesh, ray, before, |triangle| self.may_block(triangle, target))
    }

    /// Whether the ray meets any surface at a distance below `before`.
    pub fn blocked(&self, ray: &Ray, before: f64) -> bool {
        self.tracer.any(&self.mesh, ray, before, |_| true)
    }

    /// The share of light from the point at distance `before` along the ray, on target `target`, that passes what is
    /// blended in between: Π (1 − share).
    pub fn transmittance(&self, ray: &Ray, before: f64, target: u32) -> f64 {
        let Some(veil) = &self.veil else { return 1.0 };
        let met = RefCell::new(Vec::new());
        self.tracer.any(&self.mesh, ray, before, |triangle| {
            if veil.cover(triangle) == Cover::Blended && self.may_block(triangle, target) {
                met.borrow_mut().push(triangle);
            }
            false
        });
        let mut met = met.into_inner();
        met.sort_unstable();
        met.dedup();
        let shares = met.into_iter().filter_map(|triangle| veil.met(&self.mesh, ray, triangle));
        shares.map(|(_, share)| 1.0 - f64::from(share)).product()
    }

    /// Whether a point of a target's plane (world, metres) lies where the target is not there.
    pub fn is_hole(&self, target: u32, y: DVec3) -> bool {
        let Some(veil) = &self.veil else { return false };
        let within = |triangle: u32| {
            let [b, c] = self.mesh.triangle(triangle).barycentrics(y);
            (b.min(c).min(1.0 - b - c), triangle, [b, c])
        };
        let triangles = self.targets[target as usize].triangles().map(within);
        let innermost = triangles.reduce(|one, other| if other.0 > one.0 { other } else { one });
        innermost
            .is_some_and(|(_, triangle, at)| veil.cover(triangle) == Cover::Cut && veil.share_at(triangle, at) == 0.0)
    }

    /// The surfaces that a line of sight meets and shows, from the nearest on, up to the first that stops all light. An
    /// emitter comes instead of what it is coplanar with.
    pub fn layers(&self, ray: &Ray) -> Vec<Layer> {
        let Some(veil) = &self.veil else {
            return self.vp(ray).map(|hit| Layer { hit, share: 1.0 }).into_iter().collect();
        };
        let mut layers = self.all_met(ray, |triangle| veil.cover(triangle) != Cover::Opaque);
        layers.retain(|layer| layer.share > 0.0);
        let last = self.vp(ray);
        layers.retain(|layer| last.is_none_or(|last| layer.hit.t < last.t));
        layers.extend(last.map(|hit| Layer { hit, share: 1.0 }));
        layers
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

    /// Every triangle that a ray meets and for which `asked` holds, with the share that it stops, from the nearest on.
    fn all_met(&self, ray: &Ray, asked: impl Fn(u32) -> bool) -> Vec<Layer> {
        let Some(veil) = &self.veil else { return Vec::new() };
        let met = RefCell::new(Vec::new());
        self.tracer.any(&self.mesh, ray, f64::INFINITY, |triangle| {
            if asked(triangle) {
                let layer =
                    veil.met(&self.mesh, ray, triangle).map(|(t, share)| Layer { hit: Hit { t, triangle }, share });
                met.borrow_mut().extend(layer);
            }
            false
        });
        let mut met = met.into_inner();
        met.sort_by(|a, b| a.hit.t.total_cmp(&b.hit.t).then(a.hit.triangle.cmp(&b.hit.triangle)));
        met.dedup();
        met
    }

    /// Whether a ray that meets a triangle ends there.
    fn ends(&self, veil: &Veil, ray: &Ray, triangle: u32) -> bool {
        match veil.cover(triangle) {
            Cover::Opaque => true,
            Cover::Blended => false,
            Cover::Cut => veil.met(&self.mesh, ray, triangle).is_some_and(|(_, share)| share > 0.0),
        }
    }

    /// The first surface that a ray does not pass: the nearest of all, or where it passes that the nearest of the others.
    #[cold]
    fn first_that_ends(&self, veil: &Veil, ray: &Ray) -> Option<Hit> {
        let nearest = self.tracer.closest(&self.mesh, ray)?;
        let hit = if self.ends(veil, ray, nearest.triangle) { nearest } else { self.first_behind(veil, ray)? };
        let emitter = self.emitter_or(ray, hit);
        Some(if self.ends(veil, ray, emitter.triangle) { emitter } else { hit })
    }

    fn first_behind(&self, veil: &Veil, ray: &Ray) -> Option<Hit> {
        let best: Cell<Option<Hit>> = Cell::new(None);
        self.tracer.any(&self.mesh, ray, f64::INFINITY, |triangle| {
            if self.ends(veil, ray, triangle) {
                let hit = veil.met(&self.mesh, ray, triangle).map(|(t, _)| Hit { t, triangle });
                let nearer = hit.filter(|hit| best.get().is_none_or(|best| hit.before(&best)));
                best.set(nearer.or(best.get()));
            }
            false
        });
        best.get()
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
