//! What x sees of one target, and what may stand between.

use std::ops::ControlFlow;

use glam::DVec3;

use super::Effort;
use super::cone::Cone;
use super::facet::{Facet, ROW, Wide};
use super::shaft::Shaft;
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::veil::Cover;

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
    /// What x sees of a target.
    pub(crate) fn new(geometry: &Geometry, frame: &Frame, target: u32, effort: Effort) -> Self {
        let facet = Facet::wide(geometry, frame, target);
        Self::of(geometry, frame, target, facet, || Shaft::from_x(&facet), effort)
    }

    /// What all of a footprint sees of a target, a convex polygon in the plane of x; none where it lies on both sides of one
    /// that emits to both.
    pub(crate) fn over(geometry: &Geometry, frame: &Frame, footprint: &[DVec3], target: u32) -> Option<Self> {
        let sides = geometry.targets()[target as usize].sides;
        let facet = Facet::wide(geometry, frame, target).over(sides, footprint)?;
        let shaft = || Shaft::from_footprint(&facet, footprint);
        Some(Self::of(geometry, frame, target, facet, shaft, Effort::Gather))
    }

    fn of(
        geometry: &Geometry,
        frame: &Frame,
        target: u32,
        facet: Wide,
        shaft: impl FnOnce() -> Shaft,
        effort: Effort,
    ) -> Self {
        let lit = facet.lit();
        let between = match effort {
            Effort::Gather if lit => gather(geometry, frame, target, &shaft()),
            Effort::Gather => Between::Gathered(Vec::new()),
            Effort::Cast => Between::Unknown,
        };
        Self { facet, row: facet.row(), lit, outline: facet.outline(), between }
    }

    /// Whether light can come from it at all: x on a side that emits, some of it above x's horizon.
    #[inline(always)]
    pub fn lit(&self) -> bool {
        self.lit
    }

    /// The directions from x to the target.
    #[inline(always)]
    pub fn outline(&self) -> &Cone {
        &self.outline
    }

    /// What stands between.
    #[inline(always)]
    pub fn between(&self) -> &Between {
        &self.between
    }

    pub(crate) fn facet(&self) -> &Wide {
        &self.facet
    }

    #[inline(always)]
    pub(crate) fn row(&self) -> &[f32; ROW] {
        &self.row
    }
}

/// Everything that can end a line in the shaft to a target, as cones; what is blended ends none. Where some of it is cut out,
/// rays must tell.
fn gather(geometry: &Geometry, frame: &Frame, target: u32, shaft: &Shaft) -> Between {
    let mut cones = Vec::new();
    let flow = shaft.visit(geometry, frame, target, MANY_CANDIDATES, |triangle, corners| {
        let cover = geometry.cover(triangle);
        if cover != Cover::Blended {
            cones.extend(shaft.cone(&corners).filter(|_| cover == Cover::Opaque));
        }
        let cut = cover == Cover::Cut && shaft.meets(&corners);
        if cut || cones.len() > MANY_BLOCKERS { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    if flow.is_break() { Between::Unknown } else { Between::Gathered(cones) }
}
