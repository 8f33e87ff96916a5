//! Triangles that do not simply block: those that are cut out, and those that stop a share of the light.
//!
//! What they are made of is not known here; a [`Screen`] tells what they stop at a point.

use std::fmt;
use std::sync::Arc;

use crate::mesh::{Mesh, Triangle};
use crate::ray::Ray;
use crate::ray::Shear;
use crate::tracer::meet;

/// How a triangle blocks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cover {
    /// All light, everywhere.
    #[default]
    Opaque,
    /// All light where it is there: its screen says 0 or 1.
    Cut,
    /// A share of the light. It is no end of a ray: it is seen through, and light that passes it is dimmed.
    Blended,
}

/// Tells the share of light, from 0 to 1, that a triangle of the mesh stops at the point (1 − b₁ − b₂) a + b₁ b + b₂ c.
pub type Screen = Arc<dyn Fn(u32, [f64; 2]) -> f32 + Send + Sync>;

/// How the triangles of a mesh block, where not all of them are opaque.
#[derive(Clone)]
pub struct Veil {
    covers: Vec<Cover>,
    screen: Screen,
}

impl fmt::Debug for Veil {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = |cover| self.covers.iter().filter(|&&own| own == cover).count();
        write!(f, "Veil {{ cut: {}, blended: {} }}", count(Cover::Cut), count(Cover::Blended))
    }
}

impl Veil {
    /// How each triangle of the mesh blocks, and what tells the shares of those that are not opaque; none where all are.
    pub fn new(covers: Vec<Cover>, screen: Screen) -> Option<Self> {
        covers.iter().any(|&cover| cover != Cover::Opaque).then_some(Self { covers, screen })
    }

    /// How a triangle blocks.
    pub fn cover(&self, triangle: u32) -> Cover {
        self.covers[triangle as usize]
    }

    /// The share of light that a triangle stops where a ray meets it, and the distance; none where it does not meet it.
    pub(crate) fn met(&self, mesh: &Mesh, ray: &Ray, triangle: u32) -> Option<(f64, f32)> {
        let corners = mesh.triangle(triangle);
        let t = meet(&corners, ray, &Shear::new(ray))?;
        Some((t, self.share(&corners, triangle, ray, t)))
    }

    /// The share of light that a triangle stops at a distance along a ray.
    pub(crate) fn share(&self, corners: &Triangle, triangle: u32, ray: &Ray, t: f64) -> f32 {
        match self.cover(triangle) {
            Cover::Opaque => 1.0,
            Cover::Cut | Cover::Blended => (self.screen)(triangle, corners.barycentrics(ray.at(t))),
        }
    }

    /// The share that a triangle stops at a point of it, by barycentric coordinates.
    pub(crate) fn share_at(&self, triangle: u32, barycentrics: [f64; 2]) -> f32 {
        match self.cover(triangle) {
            Cover::Opaque => 1.0,
            Cover::Cut | Cover::Blended => (self.screen)(triangle, barycentrics),
        }
    }
}
