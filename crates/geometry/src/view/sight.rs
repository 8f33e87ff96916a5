//! What x sees of one target, and what may stand between.

use std::ops::ControlFlow;

use glam::DVec3;

use super::Effort;
use super::cone::{Cone, edge_planes};
use super::facet::{Facet, ROW, Wide};
use crate::blocking;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::tracer::Region;

/// Most triangles between x and a target that are held against planes; beyond, rays are cast.
const MANY_BLOCKERS: usize = 64;
/// Most candidates looked at before gathering is given up.
const MANY_CANDIDATES: usize = 8 * MANY_BLOCKERS;

/// One target as x sees it.
#[derive(Clone, Debug)]
pub struct Sight {
    facet: Wide,
    row: [f32; ROW],
    lit: bool,
    outline: Cone,
    between: Between,
}

/// What stands between x and a target.
#[derive(Clone, Debug)]
pub enum Between {
    /// All that can block it, as cones from x.
    Gathered(Vec<Cone>),
    /// Too much to gather, or not worth it: cast rays.
    Unknown,
}

impl Sight {
    pub(crate) fn new(geometry: &Geometry, frame: &Frame, target: u32, effort: Effort) -> Self {
        let facet = Facet::wide(geometry, frame, target);
        let lit = facet.faces_x() && facet.corners().iter().any(|corner| corner.z > 0.0);
        let between = match effort {
            Effort::Gather if lit => gather(geometry, frame, target, &facet),
            Effort::Gather => Between::Gathered(Vec::new()),
            Effort::Cast => Between::Unknown,
        };
        Self { facet, row: facet.row(), lit, outline: facet.outline(), between }
    }

    /// Whether light can come from it at all: x on a side that emits, some of it above x's horizon.
    pub fn lit(&self) -> bool {
        self.lit
    }

    /// The directions from x to the target.
    pub fn outline(&self) -> &Cone {
        &self.outline
    }

    /// What stands between.
    pub fn between(&self) -> &Between {
        &self.between
    }

    pub(crate) fn facet(&self) -> &Wide {
        &self.facet
    }

    pub(crate) fn row(&self) -> [f32; ROW] {
        self.row
    }
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

/// Everything that can stand between x and the visible part of a target: one query with the pyramid over it, then each
/// candidate against the pyramid and the pyramid against it.
fn gather(geometry: &Geometry, frame: &Frame, target: u32, facet: &Wide) -> Between {
    let visible = above_horizon(facet.corners());
    let pyramid: Vec<DVec3> = edge_planes(&visible).collect();
    let mut cones = Vec::new();
    let mut candidates = 0;
    let mut too_many = false;
    geometry.within(&region(frame, facet, &pyramid), |triangle| {
        candidates += 1;
        if geometry.may_block(triangle, target) {
            let blocker = geometry.mesh().triangle(triangle);
            if !blocking::plane_holds(&blocker, frame.x()) {
                let corners = blocker.vertices().map(|v| frame.localize(v));
                cones.extend(between(corners, facet, &pyramid, &visible));
            }
        }
        too_many = cones.len() > MANY_BLOCKERS || candidates > MANY_CANDIDATES;
        if too_many { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    if too_many { Between::Unknown } else { Between::Gathered(cones) }
}

/// The pyramid from x over the visible part, up to the target's plane, in world space.
fn region(frame: &Frame, facet: &Wide, pyramid: &[DVec3]) -> Region {
    let sides = pyramid.iter().map(|&inward| (frame.to_world(-inward), 0.0));
    let base = (frame.to_world(facet.toward()), facet.plane_distance());
    Region { origin: frame.x(), half_spaces: sides.chain([base]).collect() }
}

/// The cone of directions in which a triangle stands between x and the target, if it meets the pyramid at all.
///
/// Along ω the triangle's plane n·y = s lies before the target's m·y = d where s (m·ω) < d (n·ω), that is on one side of
/// the plane through x with normal d n − s m: needed only for a triangle that crosses the target's plane.
fn between(corners: [DVec3; 3], facet: &Wide, pyramid: &[DVec3], visible: &[DVec3]) -> Option<Cone> {
    let (m, d) = (facet.toward(), facet.plane_distance());
    let below_horizon = corners.iter().all(|c| c.z <= 0.0);
    let behind = corners.iter().all(|c| m.dot(*c) >= d);
    let outside = pyramid.iter().any(|inward| corners.iter().all(|c| inward.dot(*c) <= 0.0));
    if below_horizon || behind || outside {
        return None;
    }
    let mut planes: Vec<DVec3> = edge_planes(&corners).collect();
    if corners.iter().any(|c| m.dot(*c) > d) {
        planes.push(in_front(corners, m, d));
    }
    let misses = planes.iter().any(|inward| visible.iter().all(|v| inward.dot(*v) <= 0.0));
    (!misses).then(|| Cone::new(planes))
}

fn in_front([a, b, c]: [DVec3; 3], m: DVec3, d: f64) -> DVec3 {
    let n = (b - a).cross(c - a).normalize_or_zero();
    let s = n.dot(a);
    let (n, s) = if s < 0.0 { (-n, -s) } else { (n, s) };
    d * n - s * m
}
