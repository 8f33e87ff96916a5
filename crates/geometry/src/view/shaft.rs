//! The shaft between a footprint and a target, and what stands in it.

use std::ops::ControlFlow;

use glam::DVec3;

use super::cone::{Cone, Side};
use super::facet::Wide;
use super::polygon::{Polygon, clipped};
use super::pyramid::{Plane, visit_blockers};
use crate::blocking;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::mesh::Triangle;
use crate::tracer::Region;

/// The convex region that holds all segments from a footprint to the part of a target above the horizon, up to the
/// target's plane (Haines and Wallace 1991, "Shaft culling for efficient ray-cast radiosity"). A footprint is a convex
/// polygon in the plane of x, or x alone.
pub(crate) struct Shaft<'f> {
    facet: &'f Wide,
    footprint: Vec<DVec3>,
    visible: Vec<DVec3>,
    /// Inward normals n and offsets: inside is n·y >= offset.
    sides: Vec<(DVec3, f64)>,
}

impl<'f> Shaft<'f> {
    /// The shaft to a lit target, in the frame of x.
    pub(crate) fn new(facet: &'f Wide, footprint: &[DVec3]) -> Self {
        let footprint = clipped(footprint, |v| facet.height(v));
        let visible = Polygon::above_horizon(facet.corners()).as_slice().to_vec();
        let next = |k: usize| visible[(k + 1) % visible.len()];
        let side = |k: usize| supporting(visible[k], next(k), &visible, &footprint);
        let sides = (0..visible.len()).filter_map(side).collect();
        Self { facet, footprint, visible, sides }
    }

    /// Visits, in the frame of x, the triangles that may block the target and whose boxes touch the shaft, by one query
    /// of the hierarchy. Breaks off after `most` candidates, or when `visit` says so.
    pub(crate) fn visit(
        &self,
        geometry: &Geometry,
        frame: &Frame,
        target: u32,
        most: usize,
        visit: impl FnMut([DVec3; 3]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        visit_blockers(geometry, frame, &self.region(frame), target, most, |t| self.held_by(t, frame), visit)
    }

    /// Whether the footprint lies in a triangle's plane, so that the triangle blocks nothing that it sees.
    fn held_by(&self, triangle: &Triangle, frame: &Frame) -> bool {
        self.footprint.iter().all(|&v| blocking::plane_holds(triangle, frame.x() + frame.to_world(v)))
    }

    /// The cone of lines from the footprint on which a triangle stands before the target, if it meets the shaft at all.
    ///
    /// Its sides are its edges and, for a triangle that crosses the target's plane, the line where it does.
    pub(crate) fn cone(&self, corners: [DVec3; 3]) -> Option<Cone> {
        let (m, d) = (self.facet.toward(), self.facet.plane_distance());
        let below_horizon = corners.iter().all(|c| c.z <= 0.0);
        let behind = corners.iter().all(|c| m.dot(*c) >= d);
        let outside = self.sides.iter().any(|(inward, offset)| corners.iter().all(|c| inward.dot(*c) <= *offset));
        if below_horizon || behind || outside {
            return None;
        }
        let [a, b, c] = corners;
        let plane = Plane::of(corners);
        let near = |v: &DVec3| plane.s - plane.n.dot(*v);
        let straddled = self.footprint.iter().any(|v| near(v) < 0.0) && self.footprint.iter().any(|v| near(v) > 0.0);
        let inward = if straddled || self.footprint.iter().any(|v| near(v) > 0.0) { 1.0 } else { -1.0 };
        let crosses = corners.iter().any(|c| m.dot(*c) > d);
        let edges = [(a.cross(b), b - a), (b.cross(c), c - b), (c.cross(a), a - c)];
        let lines: Vec<(DVec3, DVec3)> = edges.into_iter().chain(crosses.then(|| plane.before(m, d))).collect();
        if !straddled && lines.iter().any(|&line| self.misses(line, inward)) {
            return None;
        }
        let cone = Cone::new(lines.into_iter().map(|(normal, e)| Side::new(inward * normal, inward * e)));
        Some(if straddled { cone.straddled(plane.n, plane.s) } else { cone })
    }

    /// Whether every line from the footprint to the target passes outside of a side.
    fn misses(&self, (normal, e): (DVec3, DVec3), inward: f64) -> bool {
        let product = |v: DVec3, l: DVec3| normal.dot(l - v) + v.cross(l - v).dot(e);
        self.footprint.iter().all(|&v| self.visible.iter().all(|&l| inward * product(v, l) <= 0.0))
    }

    /// The shaft in world space.
    fn region(&self, frame: &Frame) -> Region {
        let sides = self.sides.iter().map(|&(inward, offset)| (frame.to_world(-inward), -offset));
        let base = (frame.to_world(self.facet.toward()), self.facet.plane_distance());
        Region { origin: frame.x(), half_spaces: sides.chain([base]).collect() }
    }
}

/// The plane through an edge a → b of a target and the point of the footprint that leaves all of both on one side: its
/// inward normal n and the offset of n·y >= offset. None where the edge points at the footprint.
fn supporting(a: DVec3, b: DVec3, target: &[DVec3], footprint: &[DVec3]) -> Option<(DVec3, f64)> {
    let plane = |v: &DVec3| {
        let normal = (a - *v).cross(b - *v).normalize_or_zero();
        let away: f64 = target.iter().map(|l| normal.dot(*l - a)).sum();
        let inward = normal * 1.0_f64.copysign(away);
        let least = footprint.iter().map(|w| inward.dot(*w - a)).fold(0.0, f64::min);
        (inward, least)
    };
    let (inward, least) = footprint.iter().map(plane).max_by(|p, q| p.1.total_cmp(&q.1))?;
    (inward != DVec3::ZERO).then(|| (inward, inward.dot(a) + least))
}
