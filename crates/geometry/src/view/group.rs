//! Neighbouring targets that share one query of the hierarchy.

use std::cmp::Reverse;
use std::ops::ControlFlow;

use glam::DVec3;

use super::facet::{Facet, Standing, Wide};
use super::prospect::{Need, Prospect};
use super::shaft::Shaft;
use super::window::Window;
use crate::blocking;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::tracer::Region;
use crate::veil::Cover;

/// Most targets of a group.
const MOST: usize = 128;
/// Blockers that a target is shown with first: most targets that are hidden among many triangles are hidden by a few of the
/// largest.
const LARGEST: usize = 6;
/// A group's window is at most this many times as large as those of its targets together.
const SPREAD: f64 = 1.5;

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
    /// What is lit has a shaft from x, and its window.
    lit: Option<(Shaft, Window)>,
}

/// Triangles that may stand before some of them, and the windows in which they stand.
struct Candidates {
    windows: Vec<Window>,
    triangles: Vec<(u32, [DVec3; 3])>,
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
        let centre: DVec3 = lit().flat_map(|(shaft, _)| shaft.visible()).sum();
        let axes = Frame::new(DVec3::ZERO, centre.normalize_or(DVec3::Z));
        let mut window = Window::NONE;
        let mut sum = 0.0;
        for member in &mut members {
            if let Some((shaft, own)) = &mut member.lit {
                *own = Window::around(&axes, shaft.visible())?;
                window = window.union(own);
                sum += own.size();
            }
        }
        let near = sum == 0.0 || window.size() <= SPREAD * sum;
        near.then_some(Self { geometry, frame, members, axes, window })
    }

    /// Visits the group's targets, by one query of the hierarchy.
    pub(crate) fn prospects(&self, visit: &mut impl FnMut(Prospect) -> Need) {
        let candidates = &self.candidates();
        for Member { target, facet, lit } in &self.members {
            let mut blockers = Vec::new();
            let before =
                |opaque| lit.iter().flat_map(move |lit| candidates.before(lit, *target, self.geometry, opaque));
            let veils = || if self.geometry.is_veiled() { before(false).collect() } else { Vec::new() };
            let mut rest = before(true);
            blockers.extend(rest.by_ref().take(LARGEST));
            let complete = blockers.len() < LARGEST;
            let first = Prospect::of(*target, facet, blockers.clone(), complete);
            let first = if complete { Prospect { veils: veils(), ..first } } else { first };
            if visit(first) == Need::Complete && !complete {
                blockers.extend(rest);
                visit(Prospect { veils: veils(), ..Prospect::of(*target, facet, blockers, true) });
            }
        }
    }

    /// What stands in the window, the largest first.
    fn candidates(&self) -> Candidates {
        let Self { geometry, frame, axes, window, .. } = self;
        let mut found = Vec::new();
        if window.size() > 0.0 {
            geometry.within(&self.region(), |index| {
                let triangle = geometry.mesh().triangle(index);
                let corners = triangle.vertices().map(|v| frame.localize(v));
                let own = Window::before(axes, &corners);
                if own.meets(window) && !blocking::plane_holds(&triangle, frame.x()) {
                    found.push((own, (index, corners)));
                }
                ControlFlow::Continue(())
            });
        }
        let size = |own: &Window| own.shared(window).size();
        // Numbers from zero up are in the order of their bits.
        let mut order: Vec<(u64, u32)> = found.iter().zip(0..).map(|((own, _), k)| (size(own).to_bits(), k)).collect();
        order.sort_unstable_by_key(|&key| Reverse(key));
        let (windows, triangles) = order.into_iter().map(|(_, k)| found[k as usize]).unzip();
        Candidates { windows, triangles }
    }

    /// Above x's horizon, within the window and up to its far end, in world space.
    fn region(&self) -> Region {
        let world = |outward| self.frame.to_world(self.axes.to_world(outward));
        let sides = self.window.sides().map(|outward| (world(outward), 0.0));
        let ends = [(-self.frame.n_x(), 0.0), (world(DVec3::Z), self.window.far())];
        Region { origin: self.frame.x(), half_spaces: sides.into_iter().chain(ends).collect() }
    }
}

impl Candidates {
    /// The triangles that stand before a lit target: those that are opaque, or the others.
    fn before(
        &self,
        (shaft, window): &(Shaft, Window),
        target: u32,
        geometry: &Geometry,
        opaque: bool,
    ) -> impl Iterator<Item = [DVec3; 3]> {
        let near = self.windows.iter().zip(&self.triangles).filter(|(own, _)| own.meets(window));
        let stands = move |(triangle, corners): &(u32, [DVec3; 3])| {
            let asked = (geometry.cover(*triangle) == Cover::Opaque) == opaque;
            (asked && geometry.may_block(*triangle, target) && shaft.meets(corners)).then_some(*corners)
        };
        near.filter_map(move |(_, candidate)| stands(candidate))
    }
}

impl Member {
    fn of(geometry: &Geometry, frame: &Frame, target: u32) -> Option<Self> {
        let facet = Facet::wide(geometry, frame, target);
        match facet.standing() {
            Standing::Dark | Standing::OnBack => None,
            Standing::On => Some(Self { target, facet, lit: None }),
            Standing::Lit => Some(Self { target, facet, lit: Some((Shaft::from_x(&facet), Window::NONE)) }),
        }
    }
}
