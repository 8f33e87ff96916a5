//! The pyramid from x over a target, and what stands in it.

use std::ops::ControlFlow;

use glam::DVec3;

use super::cone::edge_planes;
use super::facet::Wide;
use crate::blocking;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::tracer::Region;

/// The pyramid from x over the part of a target above x's horizon, up to the target's plane.
pub(crate) struct Pyramid<'f> {
    facet: &'f Wide,
    visible: Vec<DVec3>,
    sides: Vec<DVec3>,
}

impl<'f> Pyramid<'f> {
    /// The pyramid over a lit target.
    pub(crate) fn new(facet: &'f Wide) -> Self {
        let visible = above_horizon(facet.corners());
        let sides = edge_planes(&visible).collect();
        Self { facet, visible, sides }
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

    /// Whether a triangle stands between x and the target in some direction.
    ///
    /// Along ω the triangle's plane n·y = s lies before the target's m·y = d where s (m·ω) < d (n·ω), that is on one side
    /// of the plane through x with normal d n − s m: needed only for a triangle that crosses the target's plane.
    pub(crate) fn holds(&self, corners: [DVec3; 3]) -> bool {
        let (m, d) = (self.facet.toward(), self.facet.plane_distance());
        let below_horizon = corners.iter().all(|c| c.z <= 0.0);
        let behind = corners.iter().all(|c| m.dot(*c) >= d);
        let outside = self.sides.iter().any(|inward| corners.iter().all(|c| inward.dot(*c) <= 0.0));
        if below_horizon || behind || outside {
            return false;
        }
        let crosses = corners.iter().any(|c| m.dot(*c) > d);
        let planes: Vec<DVec3> = edge_planes(&corners).chain(crosses.then(|| in_front(corners, m, d))).collect();
        let misses = planes.iter().any(|inward| self.visible.iter().all(|v| inward.dot(*v) <= 0.0));
        !misses
    }

    /// The pyramid in world space.
    fn region(&self, frame: &Frame) -> Region {
        let sides = self.sides.iter().map(|&inward| (frame.to_world(-inward), 0.0));
        let base = (frame.to_world(self.facet.toward()), self.facet.plane_distance());
        Region { origin: frame.x(), half_spaces: sides.chain([base]).collect() }
    }
}

fn in_front([a, b, c]: [DVec3; 3], m: DVec3, d: f64) -> DVec3 {
    let n = (b - a).cross(c - a).normalize_or_zero();
    let s = n.dot(a);
    let (n, s) = if s < 0.0 { (-n, -s) } else { (n, s) };
    d * n - s * m
}

/// The part of a convex polygon above x's horizon (z > 0), by Sutherland and Hodgman 1974.
fn above_horizon(corners: &[DVec3]) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (k, &from) in corners.iter().enumerate() {
        let to = corners[(k + 1) % corners.len()];
        if from.z > 0.0 {
            kept.push(from);
        }
        if (from.z > 0.0) != (to.z > 0.0) {
            kept.push(from.lerp(to, from.z / (from.z - to.z)));
        }
    }
    kept
}
