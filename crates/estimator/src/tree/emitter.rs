//! A target as the tree takes it.

use glam::DVec3;
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::target::{Sides, Target};

/// Where a target lies in world space, in metres, and its power.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Emitter {
    corners: [DVec3; 4],
    count: usize,
    /// Unit normal of the front.
    pub(super) normal: DVec3,
    /// Whether it emits to both sides.
    pub(super) both: bool,
    /// Luminance × area of one side.
    pub(super) power: f64,
}

impl Emitter {
    /// A target of a mesh, of this luminance.
    pub(crate) fn new(target: &Target, mesh: &Mesh, luminance: f64) -> Self {
        let (outline, mut corners) = (target.corners(mesh), [DVec3::ZERO; 4]);
        let outline = outline.as_slice();
        corners.iter_mut().zip(outline).for_each(|(slot, corner)| *slot = corner.as_dvec3());
        let [a, b, c, _] = corners;
        Self {
            corners,
            count: outline.len(),
            normal: (b - a).cross(c - a).normalize_or(DVec3::Z),
            both: target.sides == Sides::Both,
            power: luminance * target.area(mesh),
        }
    }

    /// The corners in order.
    pub(super) fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }

    pub(super) fn middle(&self) -> DVec3 {
        self.corners().iter().sum::<DVec3>() / self.count as f64
    }
}
