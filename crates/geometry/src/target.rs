//! Targets: what points are drawn on.

use glam::{DVec3, Vec3};

use crate::mesh::Mesh;

/// The sides of a surface from which light leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sides {
    /// Only the front, from which the vertices run counter-clockwise.
    Front,
    /// Front and back (glTF's `doubleSided`).
    Both,
}

/// A piece of a light that points are drawn on: one triangle, or two triangles that share a diagonal and form a
/// parallelogram. Geometry knows no radiance; a target says only where light can come from and to which sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// What stands there.
    pub shape: Shape,
    /// Where light leaves it.
    pub sides: Sides,
}

/// The outline of a target, by triangle indices into the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One triangle of the mesh.
    Triangle(u32),
    /// Two triangles of the mesh. The corners go around counter-clockwise seen from the front, the diagonal runs from
    /// the first corner to the third, and the first triangle has corners 0, 1, 2 (in some rotation), the second 0, 2, 3.
    Parallelogram {
        /// The two triangles.
        triangles: [u32; 2],
        /// Vertex indices of the corners.
        corners: [u32; 4],
    },
}

impl Target {
    /// The triangles of the mesh that make up the target: one or two.
    pub fn triangles(&self) -> impl Iterator<Item = u32> + use<> {
        let (first, second) = match self.shape {
            Shape::Triangle(t) => (t, None),
            Shape::Parallelogram { triangles: [t, u], .. } => (t, Some(u)),
        };
        std::iter::once(first).chain(second)
    }

    /// The triangle whose plane stands for the target's.
    pub fn first(&self) -> u32 {
        match self.shape {
            Shape::Triangle(t) | Shape::Parallelogram { triangles: [t, _], .. } => t,
        }
    }

    /// World positions of the corners, counter-clockwise from the front: three, or four for a parallelogram.
    pub fn corners(&self, mesh: &Mesh) -> Corners {
        match self.shape {
            Shape::Triangle(t) => {
                let triangle = mesh.triangle(t);
                Corners { at: [triangle.a, triangle.b, triangle.c, triangle.c], count: 3 }
            }
            Shape::Parallelogram { corners, .. } => {
                Corners { at: corners.map(|i| mesh.vertices[i as usize]), count: 4 }
            }
        }
    }

    /// Area in square metres, once, whatever the sides.
    pub fn area(&self, mesh: &Mesh) -> f64 {
        self.triangles().map(|t| mesh.triangle(t).area()).sum()
    }

    /// The centroid of the corners, in metres.
    pub fn centroid(&self, mesh: &Mesh) -> DVec3 {
        let corners = self.corners(mesh);
        let corners = corners.as_slice();
        corners.iter().map(|v| v.as_dvec3()).sum::<DVec3>() / corners.len() as f64
    }
}

/// Up to four corners of a target, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corners {
    at: [Vec3; 4],
    count: usize,
}

impl Corners {
    /// The corners in order: three or four.
    pub fn as_slice(&self) -> &[Vec3] {
        &self.at[..self.count]
    }
}
