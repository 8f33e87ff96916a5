//! What exact light is computed from.

use std::ops::ControlFlow;

use glam::DVec3;

use super::facet::{Facet, Standing, Wide};
use super::group::Group;
use super::shaft::Shaft;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::mesh::Triangle;
use crate::target::Sides;
use crate::tracer::Region;
use crate::veil::Cover;

/// A target in binary64 as x meets it, with every triangle that can stand between. In the frame of x, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Prospect {
    /// The target's number.
    pub target: u32,
    /// How x lies to it.
    pub standing: Standing,
    /// Three corners, or four of a parallelogram, counter-clockwise seen from the front.
    pub corners: Vec<DVec3>,
    /// The triangles that can stand between; none where nothing is lit.
    pub blockers: Vec<[DVec3; 3]>,
    /// Whether these are all of them, or only some of the largest.
    pub complete: bool,
    /// The triangles that are not opaque and can stand between, where `blockers` are complete.
    pub veils: Vec<[DVec3; 3]>,
}

/// What a visitor of prospects needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// What it was given.
    Nothing,
    /// The same prospect, complete.
    Complete,
}

impl Prospect {
    /// The prospect of one target from the origin of `frame`, by one query of the hierarchy. It costs what the pyramid
    /// over the target holds.
    pub fn new(geometry: &Geometry, frame: &Frame, target: u32) -> Self {
        let facet = Facet::wide(geometry, frame, target);
        let (mut blockers, mut veils) = (Vec::new(), Vec::new());
        if facet.lit() {
            let shaft = Shaft::from_x(&facet);
            let _ = shaft.visit(geometry, frame, target, usize::MAX, |triangle, corners| {
                let found = if geometry.cover(triangle) == Cover::Opaque { &mut blockers } else { &mut veils };
                found.extend(shaft.meets(&corners).then_some(corners));
                ControlFlow::Continue(())
            });
        }
        Self { veils, ..Self::of(target, &facet, blockers, true) }
    }

    /// The prospect of a target that stands elsewhere than the scene has it, where `corners` say, in the frame of x, and
    /// whatever `within` finds in a region of world space and lets block: triangles in the frame of x. `plane` is a
    /// triangle of the target in world space.
    pub fn moved(
        frame: &Frame,
        target: u32,
        corners: &[DVec3],
        sides: Sides,
        plane: &Triangle,
        within: impl FnOnce(&Region) -> Vec<[DVec3; 3]>,
    ) -> Self {
        let facet = Wide::new(corners.iter().copied(), sides, plane, frame.x());
        let mut blockers = Vec::new();
        if facet.lit() {
            let shaft = Shaft::from_x(&facet);
            blockers = within(&shaft.region(frame));
            blockers.retain(|corners| shaft.meets(corners));
        }
        Self::of(target, &facet, blockers, true)
    }

    pub(crate) fn of(target: u32, facet: &Wide, blockers: Vec<[DVec3; 3]>, complete: bool) -> Self {
        let (standing, corners) = (facet.standing(), facet.corners().to_vec());
        Self { target, standing, corners, blockers, complete, veils: Vec::new() }
    }
}

/// Visits the prospect of every target from which light can come, and of every one that x lies on with some of it above the
/// horizon, in an order that depends on targets and frame alone. The same as [`Prospect::new`] of each target, but
/// neighbours share one query of the hierarchy, whole clusters that give no light are passed over, and a prospect may come
/// with its largest blockers alone: where these do not settle the matter, the visitor answers [`Need::Complete`] and is given
/// it once more.
pub fn prospects(geometry: &Geometry, frame: &Frame, mut visit: impl FnMut(Prospect) -> Need) {
    geometry.clusters().offer(frame, |targets| {
        if let &[target] = targets {
            let prospect = Prospect::new(geometry, frame, target);
            if matches!(prospect.standing, Standing::Lit | Standing::On) {
                visit(prospect);
            }
            return true;
        }
        Group::of(geometry, frame, targets).is_some_and(|group| {
            group.prospects(&mut visit);
            true
        })
    });
}
