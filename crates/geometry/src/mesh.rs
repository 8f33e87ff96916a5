//! Triangle meshes in world space.

use glam::{DVec3, Vec3};

/// An indexed triangle mesh. Vertices are world positions in metres, binary32, and are exact by definition: everything
/// that follows computes with these very numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// World positions in metres.
    pub vertices: Vec<Vec3>,
    /// Three indices into `vertices` per triangle; counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The three world vertices of triangle `index`.
    pub fn triangle(&self, index: u32) -> Triangle {
        let [a, b, c] = self.triangles[index as usize].map(|i| self.vertices[i as usize]);
        Triangle { a, b, c }
    }

    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether the mesh has no triangle.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Smallest and largest corner of the box that holds all triangles, in metres; `None` without triangles.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let mut corners = self.triangles.iter().flatten().map(|&i| self.vertices[i as usize]);
        let first = corners.next()?;
        Some(corners.fold((first, first), |(low, high), v| (low.min(v), high.max(v))))
    }
}

/// One triangle in world space, metres; its front is the side from which a, b, c run counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// First vertex.
    pub a: Vec3,
    /// Second vertex.
    pub b: Vec3,
    /// Third vertex.
    pub c: Vec3,
}

impl Triangle {
    /// The vertices in binary64, which holds them exactly.
    pub fn vertices(&self) -> [DVec3; 3] {
        [self.a.as_dvec3(), self.b.as_dvec3(), self.c.as_dvec3()]
    }

    /// (b − a) × (c − a): twice the area along the front normal, in square metres.
    pub fn cross(&self) -> DVec3 {
        let [a, b, c] = self.vertices();
        (b - a).cross(c - a)
    }

    /// Area in square metres.
    pub fn area(&self) -> f64 {
        0.5 * self.cross().length()
    }

    /// The b₁ and b₂ of the point (1 − b₁ − b₂) a + b₁ b + b₂ c of its plane that is nearest to `point` (world, metres); not
    /// finite where the triangle has no area.
    pub fn barycentrics(&self, point: DVec3) -> [f64; 2] {
        let [a, b, c] = self.vertices();
        let normal = (b - a).cross(c - a);
        let per_square = 1.0 / normal.length_squared();
        let dual = |side: DVec3| side.dot(point - a) * per_square;
        [dual((c - a).cross(normal)), dual(normal.cross(b - a))]
    }

    /// The largest magnitude among the nine coordinates, the scale of the blocking rule's tolerance.
    pub fn magnitude(&self) -> f64 {
        let largest = self.a.abs().max(self.b.abs()).max(self.c.abs());
        f64::from(largest.max_element())
    }
}
