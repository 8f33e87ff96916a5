//! How a surface emits by a texture.

use glam::{DAffine2, DVec2};
use twoforms_geometry::blocking::TOLERANCE;
use twoforms_geometry::mesh::Mesh;

use crate::error::{Problem, malformed};
use crate::footprint;
use crate::material::Material;
use crate::surface::Surface;
use crate::texture::Texture;

/// The emission of a surface: `scale` times a texture, by coordinates that its vertices carry.
#[derive(Clone, Copy)]
pub(crate) struct Glow<'a> {
    pub texture: &'a Texture,
    pub scale: [f32; 3],
    coordinates: &'a [[f32; 2]],
    transform: DAffine2,
    /// The surface's first vertex in the mesh.
    first: u32,
}

impl<'a> Glow<'a> {
    /// How `surface` emits; `None` where its material emits the same everywhere or nothing.
    pub fn of(surface: &'a Surface, material: &Material, textures: &'a [Texture]) -> Result<Option<Self>, Problem> {
        let Some(mapping) = &material.emissive_texture else {
            return Ok(None);
        };
        let missing =
            || malformed(format!("{:?}", surface.name), "has no coordinates for the texture that it emits by");
        let coordinates = surface.attributes.as_ref().and_then(|attributes| attributes.set(mapping.set));
        Ok(Some(Self {
            texture: &textures[mapping.texture],
            scale: material.emission,
            coordinates: coordinates.ok_or_else(missing)?,
            transform: mapping.transform,
            first: surface.vertices.start,
        }))
    }

    /// Where the vertices of the mesh stand in the texture.
    pub fn uv<const N: usize>(&self, vertices: [u32; N]) -> [DVec2; N] {
        let uv = |vertex: u32| DVec2::from(self.coordinates[(vertex - self.first) as usize].map(f64::from));
        vertices.map(|vertex| self.transform.transform_point2(uv(vertex)))
    }

    /// Mean radiance over a triangle of the surface.
    pub fn mean(&self, mesh: &Mesh, triangle: u32) -> [f64; 3] {
        let mean = footprint::mean(self.texture, self.uv(mesh.triangles[triangle as usize]));
        std::array::from_fn(|channel| f64::from(self.scale[channel]) * mean[channel])
    }

    /// Whether the parallelogram abcd, made of the triangles abc and a'c'd, shows its texture by one affine map, within
    /// the rounding of coordinates to binary32.
    pub fn is_affine(&self, [a, b, c, d]: [u32; 4], [other_a, other_c]: [u32; 2]) -> bool {
        let [a, b, c, d, other_a, other_c] = self.uv([a, b, c, d, other_a, other_c]);
        let largest = [a, b, c, d].map(|uv| uv.abs().max_element()).into_iter().fold(0.0, f64::max);
        [a - other_a, c - other_c, a + c - b - d].into_iter().all(|gap| gap.abs().max_element() <= TOLERANCE * largest)
    }
}
