//! The shaft between a footprint, or x alone, and a target, and what stands in it.

use std::borrow::Cow;
use std::ops::ControlFlow;

use glam::DVec3;

use super::cone::{Cone, Side, edge_planes};
use super::facet::Wide;
use super::polygon::{Few, Polygon, clipped};
use crate::blocking;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::mesh::Triangle;
use crate::tracer::Region;

/// The convex region that holds all segments from a footprint to the part of a target above the horizon, up to the
/// target's plane (Haines and Wallace 1991, "Shaft culling for efficient ray-cast radiosity"). A footprint is a convex
/// polygon in the plane of x, or x alone: the shaft is then the pyramid from x.
#[derive(Clone, Debug)]
pub(crate) struct Shaft {
    /// The target's plane m·y = d.
    m: DVec3,
    d: f64,
    footprint: Cow<'static, [DVec3]>,
    visible: Polygon,
    sides: Few<HalfSpace>,
}

/// Inward normal n and offset: inside is n·y >= offset.
type HalfSpace = (DVec3, f64);

/// How a triangle that meets the shaft lies in it.
struct Stance {
    plane: Plane,
    /// Whether the footprint lies on both sides of it.
    straddled: bool,
    /// +1 if the footprint lies where n·y < s, or some of it does; else −1.
    inward: f64,
    /// Its edges, as p × e and e.
    edges: [(DVec3, DVec3); 3],
    /// The line in which it meets the target's plane, if it crosses that.
    across: Option<(DVec3, DVec3)>,
}

impl Shaft {
    /// The pyramid from x over a lit target, in the frame of x.
    pub(crate) fn from_x(facet: &Wide) -> Self {
        let visible = Polygon::above_horizon(facet.corners());
        let sides = edge_planes(visible.as_slice()).filter(|inward| *inward != DVec3::ZERO).map(|inward| (inward, 0.0));
        let sides = sides.collect();
        Self { m: facet.toward(), d: facet.plane_distance(), footprint: Cow::Borrowed(&[DVec3::ZERO]), visible, sides }
    }

    /// The shaft from a footprint to a lit target, in the frame of x.
    pub(crate) fn from_footprint(facet: &Wide, footprint: &[DVec3]) -> Self {
        let footprint = clipped(footprint, |v| facet.height(v));
        let polygon = Polygon::above_horizon(facet.corners());
        let visible = polygon.as_slice();
        let next = |k: usize| visible[(k + 1) % visible.len()];
        let side = |k: usize| supporting(visible[k], next(k), visible, &footprint);
        let sides = (0..visible.len()).filter_map(side).collect();
        Self { m: facet.toward(), d: facet.plane_distance(), footprint: footprint.into(), visible: polygon, sides }
    }

    /// The part of the target above x's horizon.
    pub(crate) fn visible(&self) -> &[DVec3] {
        self.visible.as_slice()
    }

    /// Visits, in the frame of x, the triangles that may block the target and whose boxes touch the shaft, by one query
    /// of the hierarchy. Breaks off after `most` candidates, or when `visit` says so.
    pub(crate) fn visit(
        &self,
        geometry: &Geometry,
        frame: &Frame,
        target: u32,
        most: usize,
        mut visit: impl FnMut(u32, [DVec3; 3]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let (mut candidates, mut flow) = (0, ControlFlow::Continue(()));
        geometry.within(&self.region(frame), |triangle| {
            candidates += 1;
            let blocker = geometry.mesh().triangle(triangle);
            if candidates > most {
                flow = ControlFlow::Break(());
            } else if geometry.may_block(triangle, target) && !self.held_by(&blocker, frame) {
                flow = visit(triangle, blocker.vertices().map(|v| frame.localize(v)));
            }
            flow
        });
        flow
    }

    /// Whether the footprint lies in a triangle's plane, so that the triangle blocks nothing that it sees.
    fn held_by(&self, triangle: &Triangle, frame: &Frame) -> bool {
        self.footprint.iter().all(|&v| blocking::plane_holds(triangle, frame.x() + frame.to_world(v)))
    }

    /// Whether a triangle meets the shaft, up to triangles that pass it by a corner.
    pub(crate) fn meets(&self, corners: &[DVec3; 3]) -> bool {
        self.stance(corners).is_some()
    }

    /// The cone of lines from the footprint on which a triangle stands before the target, if it meets the shaft at all.
    ///
    /// Its sides are its edges and, for a triangle that crosses the target's plane, the line where it does.
    pub(crate) fn cone(&self, corners: &[DVec3; 3]) -> Option<Cone> {
        let Stance { plane, straddled, inward, edges, across } = self.stance(corners)?;
        let side = |(normal, e)| Side::new(inward * normal, inward * e);
        let cone = Cone::new(edges.into_iter().chain(across).map(side));
        Some(if straddled { cone.straddled(plane.n, plane.s) } else { cone })
    }

    fn stance(&self, corners: &[DVec3; 3]) -> Option<Stance> {
        let below_horizon = corners.iter().all(|c| c.z <= 0.0);
        let behind = corners.iter().all(|c| self.m.dot(*c) >= self.d);
        let outside = |(inward, offset): &HalfSpace| corners.iter().all(|c| inward.dot(*c) <= *offset);
        if below_horizon || behind || self.sides.as_slice().iter().any(outside) {
            return None;
        }
        let &[a, b, c] = corners;
        let plane = Plane::of(corners);
        let near = |v: &DVec3| plane.s - plane.n.dot(*v);
        let before = self.footprint.iter().any(|v| near(v) > 0.0);
        let straddled = before && self.footprint.iter().any(|v| near(v) < 0.0);
        let inward = if before { 1.0 } else { -1.0 };
        let edges = [(a.cross(b), b - a), (b.cross(c), c - b), (c.cross(a), a - c)];
        let across = corners.iter().any(|c| self.m.dot(*c) > self.d).then(|| plane.before(self.m, self.d));
        let missed = || edges.into_iter().chain(across).any(|line| self.misses(line, inward));
        (straddled || !missed()).then_some(Stance { plane, straddled, inward, edges, across })
    }

    /// Whether every line from the footprint to the target passes outside of a side.
    fn misses(&self, (normal, e): (DVec3, DVec3), inward: f64) -> bool {
        let product = |v: DVec3, l: DVec3| normal.dot(l - v) + v.cross(l - v).dot(e);
        self.footprint.iter().all(|&v| self.visible().iter().all(|&l| inward * product(v, l) <= 0.0))
    }

    /// The shaft in world space.
    pub(crate) fn region(&self, frame: &Frame) -> Region {
        let sides = self.sides.as_slice().iter().map(|&(inward, offset)| (frame.to_world(-inward), -offset));
        let base = (frame.to_world(self.m), self.d);
        Region { origin: frame.x(), half_spaces: sides.chain([base]).collect() }
    }
}

/// The plane through an edge a → b of a target and the point of the footprint that leaves all of both on one side. None
/// where the edge points at the footprint.
fn supporting(a: DVec3, b: DVec3, target: &[DVec3], footprint: &[DVec3]) -> Option<HalfSpace> {
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

/// The plane n·y = s of a triangle in the frame of x, n of length one.
struct Plane {
    n: DVec3,
    s: f64,
}

impl Plane {
    fn of(&[a, b, c]: &[DVec3; 3]) -> Self {
        let n = (b - a).cross(c - a).normalize_or_zero();
        Self { n, s: n.dot(a) }
    }

    /// The line in which it meets another plane m·y = d, as p × e and e for a point p of it and its direction e.
    ///
    /// Along ω from x the one plane lies before the other where s (m·ω) < d (n·ω), for s, d > 0: on the positive side of
    /// p × e = d n − s m, where e = n × m.
    fn before(&self, m: DVec3, d: f64) -> (DVec3, DVec3) {
        let Self { n, s } = *self;
        (d * n - s * m, n.cross(m))
    }
}
