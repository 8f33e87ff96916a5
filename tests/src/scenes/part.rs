//! A surface of one material.

use glam::{DVec3, Vec3};

use super::Material;

/// Flat polygons of one material, stored as one mesh; if the material emits, one light.
#[derive(Clone, Debug)]
pub struct Part {
    /// The name of its node, mesh and material.
    pub name: &'static str,
    /// What it is made of.
    pub material: Material,
    /// Convex polygons; the front is the side from which they run counter-clockwise.
    pub polygons: Vec<Vec<Vec3>>,
    /// What its radiance is multiplied with, over each of its polygons, which are parallelograms.
    pub pattern: Option<Pattern>,
}

/// Two by two texels, each a part of the sRGB code values 0 and 255: the first spans half of a parallelogram's first side and
/// half of its last, the second lies beside it along the first side.
pub type Pattern = [[u8; 3]; 4];

impl Part {
    /// A part of the given polygons.
    pub fn new(name: &'static str, material: Material, polygons: Vec<Vec<Vec3>>) -> Self {
        Self { name, material, polygons, pattern: None }
    }

    /// The same part with a pattern.
    pub fn with_pattern(self, pattern: Pattern) -> Self {
        Self { pattern: Some(pattern), ..self }
    }

    /// A part for each texel of the pattern; the part itself where it has none.
    pub fn texels(&self) -> Vec<Self> {
        let Some(pattern) = &self.pattern else { return vec![self.clone()] };
        let texel = |k: usize, polygon: &Vec<Vec3>| {
            let [u, v] = [polygon[1] - polygon[0], polygon[3] - polygon[0]].map(|side| 0.5 * side);
            parallelogram(polygon[0] + u * (k % 2) as f32 + v * (k / 2) as f32, u, v)
        };
        let part = |(k, codes): (usize, &[u8; 3])| {
            let light = |c: usize| self.material.radiance[c] * f32::from(codes[c] / u8::MAX);
            let material = Material { radiance: [0, 1, 2].map(light), ..self.material };
            Self::new(self.name, material, self.polygons.iter().map(|polygon| texel(k, polygon)).collect())
        };
        pattern.iter().enumerate().map(part).collect()
    }

    /// The triangles that the file holds: each polygon as a fan about its first corner.
    pub fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> {
        let fan = |polygon: &Vec<Vec3>| -> Vec<[DVec3; 3]> {
            let [first, rest @ ..] = polygon.as_slice() else {
                return Vec::new();
            };
            rest.windows(2).map(|w| [first, &w[0], &w[1]].map(|v| v.as_dvec3())).collect()
        };
        self.polygons.iter().flat_map(fan)
    }

    /// Area in square metres; a double-sided part counts once.
    pub fn area(&self) -> f64 {
        self.triangles().map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum()
    }

    /// Number of sides that emit.
    pub fn sides(&self) -> f64 {
        if self.material.double_sided { 2.0 } else { 1.0 }
    }
}

/// The parallelogram spanned by `u` and `v` from `corner`; its front is where `u` x `v` points.
pub fn parallelogram(corner: Vec3, u: Vec3, v: Vec3) -> Vec<Vec3> {
    vec![corner, corner + u, corner + u + v, corner + v]
}

/// The floor y = 0 between two corners (x, z), facing up.
pub fn floor([x0, z0]: [f32; 2], [x1, z1]: [f32; 2]) -> Vec<Vec3> {
    parallelogram(Vec3::new(x0, 0.0, z0), Vec3::Z * (z1 - z0), Vec3::X * (x1 - x0))
}
