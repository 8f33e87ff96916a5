//! What exact light is computed from.

use std::ops::ControlFlow;

use glam::DVec3;

use super::facet::Facet;
use super::pyramid::Pyramid;
use crate::frame::Frame;
use crate::geometry::Geometry;

/// A target in binary64 as x meets it, with every triangle that can stand between. In the frame of x, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Prospect {
    /// Three corners, or four of a parallelogram, counter-clockwise seen from the front.
    pub corners: Vec<DVec3>,
    /// Whether light can come from it: x on a side that emits, and some of the target above x's horizon.
    pub lit: bool,
    /// The triangles that can stand between; none where nothing is lit.
    pub blockers: Vec<[DVec3; 3]>,
}

impl Prospect {
    /// The prospect of one target from the origin of `frame`, by one query of the hierarchy. It costs what the pyramid
    /// over the target holds.
    pub fn new(geometry: &Geometry, frame: &Frame, target: u32) -> Self {
        let facet = Facet::wide(geometry, frame, target);
        let mut blockers = Vec::new();
        if facet.lit() {
            let pyramid = Pyramid::new(&facet);
            let _ = pyramid.visit(geometry, frame, target, usize::MAX, |corners| {
                blockers.extend(pyramid.holds(corners).then_some(corners));
                ControlFlow::Continue(())
            });
        }
        Self { corners: facet.corners().to_vec(), lit: facet.lit(), blockers }
    }
}
