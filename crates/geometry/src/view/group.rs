//! Neighbouring targets that share one query of the hierarchy.

use std::ops::ControlFlow;

use glam::DVec3;

use super::facet::{Facet, Standing, Wide};
use super::prospect::Prospect;
use super::pyramid::Pyramid;
use super::window::Window;
use crate::blocking;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::tracer::Region;

/// Most targets of a group.
const MOST: usize = 64;
/// A group's window is at most this many times as large as those of its targets together.
const SPREAD: f64 = 8.0;

/// Some neighbouring targets as x meets them, and the window through which x sees them all.
pub(crate) struct Group<'a> {
    geometry: &'a Geometry,
    frame: &'a Frame,
    members: Vec<Member>,
    /// The axes of the window, in the frame of x: it opens along the third.
    axes: Frame,
    window: Window,
}

/// One target of a group.
struct Member {
    target: u32,
    facet: Wide,
    /// What is lit has a pyramid, and its window.
    lit: Option<(Pyramid, Window)>,
}

/// A triangle that may stand before some of them.
struct Candidate {
    triangle: u32,
    corners: [DVec3; 3],
    window: Window,
}

impl<'a> Group<'a> {
    /// The group of those targets that light can come from or that x lies on; `None` where they are too many, or so far
    /// apart as x sees them that a query for each is cheaper.
    pub(crate) fn of(geometry: &'a Geometry, frame: &'a Frame, targets: &[u32]) -> Option<Self> {
        if targets.len() > MOST {
            return None;
        }
        let mut members: Vec<Member> =
            targets.iter().filter_map(|&target| Member::of(geometry, frame, target)).collect();
        let lit = || members.iter().filter_map(|member| member.lit.as_ref());
        let centre: DVec3 = lit().flat_map(|(pyramid, _)| pyramid.visible()).sum();
        let axes = Frame::new(DVec3::ZERO, centre.normalize_or(DVec3::Z));
        let mut window = Window::NONE;
        let mut sum = 0.0;
        for member in &mut members {
            if let Some((pyramid, own)) = &mut member.lit {
                *own = Window::around(&axes, pyramid.visible())?;
                window = window.union(own);
                sum += own.size();
            }
        }
        let near = sum == 0.0 || window.size() <= SPREAD * sum;
        near.then_some(Self { geometry, frame, members, axes, window })
    }

    /// The prospects of the group's targets, by one query of the hierarchy.
    pub(crate) fn prospects(&self, visit: &mut impl FnMut(Prospect)) {
        let candidates = self.candidates();
        for member in &self.members {
            let mut blockers = Vec::new();
            if let Some((pyramid, window)) = &member.lit {
                let meeting = candidates.iter().filter(|c| {
                    c.window.meets(window)
                        && self.geometry.may_block(c.triangle, member.target)
                        && pyramid.meets(&c.corners)
                });
                blockers.extend(meeting.map(|c| c.corners));
            }
            visit(Prospect::of(member.target, &member.facet, blockers));
        }
    }

    /// What stands in the window.
    fn candidates(&self) -> Vec<Candidate> {
        let Self { geometry, frame, .. } = self;
        let mut candidates = Vec::new();
        if self.window.size() <= 0.0 {
            return candidates;
        }
        geometry.within(&self.region(), |index| {
            let triangle = geometry.mesh().triangle(index);
            if !blocking::plane_holds(&triangle, frame.x()) {
                let corners = triangle.vertices().map(|v| frame.localize(v));
                let window = Window::before(&self.axes, &corners);
                if window.meets(&self.window) {
                    candidates.push(Candidate { triangle: index, corners, window });
                }
            }
            ControlFlow::Continue(())
        });
        candidates
    }

    /// Above x's horizon, within the window and up to its far end, in world space.
    fn region(&self) -> Region {
        let world = |outward| self.frame.to_world(self.axes.to_world(outward));
        let sides = self.window.sides().map(|outward| (world(outward), 0.0));
        let ends = [(-self.frame.n_x(), 0.0), (world(DVec3::Z), self.window.far())];
        Region { origin: self.frame.x(), half_spaces: sides.into_iter().chain(ends).collect() }
    }
}

impl Member {
    fn of(geometry: &Geometry, frame: &Frame, target: u32) -> Option<Self> {
        let facet = Facet::wide(geometry, frame, target);
        match facet.standing() {
            Standing::Dark | Standing::OnBack => None,
            Standing::On => Some(Self { target, facet, lit: None }),
            Standing::Lit => Some(Self { target, facet, lit: Some((Pyramid::new(&facet), Window::NONE)) }),
        }
    }
}
