//! The pyramid from x over a target, and what stands in it.

use std::ops::ControlFlow;

use glam::DVec3;

use super::cone::edge_planes;
use super::facet::Wide;
use super::polygon::Polygon;
use crate::blocking;
use crate::frame::Frame;
use crate::geometry::Geometry;
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
        mut visit: impl FnMut([DVec3; 3]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let (mut candidates, mut flow) = (0, ControlFlow::Continue(()));
        geometry.within(&self.region(frame), |triangle| {
            candidates += 1;
            let blocker = geometry.mesh().triangle(triangle);
            if candidates > most {
                flow = ControlFlow::Break(());
            } else if geometry.may_block(triangle, target) && !blocking::plane_holds(&blocker, frame.x()) {
                flow = visit(blocker.vertices().map(|v| frame.localize(v)));
            }
            flow
        });
        flow
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

    /// The inward normals of the planes through x that bound those directions.
    ///
    /// Along ω the triangle's plane n·y = s lies before the target's m·y = d where s (m·ω) < d (n·ω), that is on one side
    /// of the plane through x with normal d n − s m: needed only for a triangle that crosses the target's plane.
    fn planes(&self, corners: &[DVec3; 3]) -> impl Iterator<Item = DVec3> {
        let crosses = corners.iter().any(|&c| self.depth(c) > self.distance);
        edge_planes(corners).chain(crosses.then(|| in_front(*corners, self.toward, self.distance)))
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

fn in_front([a, b, c]: [DVec3; 3], m: DVec3, d: f64) -> DVec3 {
    let n = (b - a).cross(c - a).normalize_or_zero();
    let s = n.dot(a);
    let (n, s) = if s < 0.0 { (-n, -s) } else { (n, s) };
    d * n - s * m
}
