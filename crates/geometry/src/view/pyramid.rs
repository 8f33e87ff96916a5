//! The pyramid from x over a target, and what stands in it.

use std::ops::ControlFlow;

use glam::DVec3;

use super::cone::edge_planes;
use super::facet::Wide;
use super::polygon::Polygon;
use crate::blocking;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::mesh::Triangle;
use crate::tracer::Region;

/// The pyramid from x over the part of a flat polygon above x's horizon, up to the polygon's plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pyramid {
    toward: DVec3,
    distance: f64,
    visible: Polygon,
    sides: Polygon,
}

impl Pyramid {
    /// The pyramid over a lit target.
    pub(crate) fn new(facet: &Wide) -> Self {
        let visible = Polygon::above_horizon(facet.corners());
        let sides = edge_planes(visible.as_slice()).collect();
        Self { toward: facet.toward(), distance: facet.plane_distance(), visible, sides }
    }

    /// The part of the polygon above x's horizon.
    pub(crate) fn visible(&self) -> &[DVec3] {
        self.visible.as_slice()
    }

    /// Visits, in the frame of x, the triangles that may block the target and whose boxes touch the pyramid, by one query
    /// of the hierarchy. Breaks off after `most` candidates, or when `visit` says so.
    pub(crate) fn visit(
        &self,
        geometry: &Geometry,
        frame: &Frame,
        target: u32,
        most: usize,
        visit: impl FnMut([DVec3; 3]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let held = |blocker: &Triangle| blocking::plane_holds(blocker, frame.x());
        visit_blockers(geometry, frame, &self.region(frame), target, most, held, visit)
    }

    /// Whether a triangle meets the pyramid, up to triangles that pass it by a corner.
    pub(crate) fn meets(&self, corners: &[DVec3; 3]) -> bool {
        let below_horizon = corners.iter().all(|c| c.z <= 0.0);
        let behind = corners.iter().all(|&c| self.depth(c) >= self.distance);
        let outside = |inward: &DVec3| corners.iter().all(|c| inward.dot(*c) <= 0.0);
        if below_horizon || behind || self.sides.as_slice().iter().any(outside) {
            return false;
        }
        self.planes(corners).all(|inward| self.visible().iter().any(|v| inward.dot(*v) > 0.0))
    }

    /// The inward normals of the planes through x that bound those directions: that of the line where the triangle meets
    /// the target's plane is needed only for a triangle that crosses it.
    fn planes(&self, corners: &[DVec3; 3]) -> impl Iterator<Item = DVec3> {
        let crosses = corners.iter().any(|&c| self.depth(c) > self.distance);
        let before = || {
            let plane = Plane::of(*corners);
            plane.before(self.toward, self.distance).0 * 1.0_f64.copysign(plane.s)
        };
        edge_planes(corners).chain(crosses.then(before))
    }

    fn depth(&self, point: DVec3) -> f64 {
        self.toward.dot(point)
    }

    /// The pyramid in world space.
    pub(crate) fn region(&self, frame: &Frame) -> Region {
        let sides = self.sides.as_slice().iter().map(|&inward| (frame.to_world(-inward), 0.0));
        let base = (frame.to_world(self.toward), self.distance);
        Region { origin: frame.x(), half_spaces: sides.chain([base]).collect() }
    }
}

/// Visits, in the frame of x, the triangles whose boxes touch a region and that may block a target, but for those that
/// hold x. Breaks off after `most` candidates, or when `visit` says so.
pub(crate) fn visit_blockers(
    geometry: &Geometry,
    frame: &Frame,
    region: &Region,
    target: u32,
    most: usize,
    held: impl Fn(&Triangle) -> bool,
    mut visit: impl FnMut([DVec3; 3]) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let (mut candidates, mut flow) = (0, ControlFlow::Continue(()));
    geometry.within(region, |triangle| {
        candidates += 1;
        let blocker = geometry.mesh().triangle(triangle);
        if candidates > most {
            flow = ControlFlow::Break(());
        } else if geometry.may_block(triangle, target) && !held(&blocker) {
            flow = visit(blocker.vertices().map(|v| frame.localize(v)));
        }
        flow
    });
    flow
}

/// The plane n·y = s of a triangle in the frame of x, n of length one.
pub(crate) struct Plane {
    pub(crate) n: DVec3,
    pub(crate) s: f64,
}

impl Plane {
    pub(crate) fn of([a, b, c]: [DVec3; 3]) -> Self {
        let n = (b - a).cross(c - a).normalize_or_zero();
        Self { n, s: n.dot(a) }
    }

    /// The line in which it meets another plane m·y = d, as p × e and e for a point p of it and its direction e.
    ///
    /// Along ω from x the one plane lies before the other where s (m·ω) < d (n·ω), for s, d > 0: on the positive side of
    /// p × e = d n − s m, where e = n × m.
    pub(crate) fn before(&self, m: DVec3, d: f64) -> (DVec3, DVec3) {
        let Self { n, s } = *self;
        (d * n - s * m, n.cross(m))
    }
}
