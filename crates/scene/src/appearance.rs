//! What a surface is at a point.

use glam::DVec2;

use crate::attributes::Attributes;
use crate::mapping::Mapping;
use crate::material::{Alpha, Material};
use crate::scene::Scene;
use crate::surface::Surface;

/// What a surface is at a point: factors times textures, as glTF 2.0 multiplies them (section 3.9), and vertex colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Appearance {
    /// Linear RGB: the factor × the texture × the vertex colour.
    pub base_color: [f32; 3],
    /// How much of the light it stops, after `alphaMode`: 1 where opaque, 0 or 1 where masked, else the product of
    /// factor, texture and vertex colour.
    pub alpha: f32,
    /// How far it is a metal, in [0, 1].
    pub metallic: f32,
    /// Perceptual roughness in [0, 1].
    pub roughness: f32,
    /// How much of its highlight it has as a dielectric, in [0, 1].
    pub specular: f32,
    /// What it reflects head-on as a dielectric, linear RGB in [0, 1].
    pub f_0: [f32; 3],
    /// Radiance `L_e` (linear RGB) that leaves it on the sides that emit.
    pub emission: [f32; 3],
}

/// The least roughness that has an f_r to sample: a mirror's is no function.
pub const SMOOTHEST: f32 = 1.0 / 32.0;

impl Appearance {
    /// Whether it has a highlight: f_r then depends on where it is seen from. Where it has none, f_r = ρ/π.
    pub fn is_glossy(&self) -> bool {
        self.metallic > 0.0 || self.specular > 0.0
    }

    /// Diffuse albedo ρ (linear RGB): base colour × (1 − metallic).
    pub fn albedo(&self) -> [f32; 3] {
        self.base_color.map(|base| base * (1.0 - self.metallic))
    }
}

impl Scene {
    /// What the surface is at the point (1 − b₁ − b₂) a + b₁ b + b₂ c of `triangle` = abc of the mesh.
    pub fn appearance_at(&self, triangle: u32, [b1, b2]: [f64; 2]) -> Appearance {
        let surface = self.surface_of(triangle);
        let material = &self.materials[surface.material];
        let Some(attributes) = &surface.attributes else {
            return material.by_factors();
        };
        let (vertices, weights) = (self.vertices_in(surface, triangle), [1.0 - b1 - b2, b1, b2]);
        let texel = |mapping: &Option<Mapping>| self.texel(mapping.as_ref(), attributes, vertices, weights);
        let [_, rough, metal, _] = texel(&material.metallic_roughness_texture);
        let [red, green, blue, _] = texel(&material.emissive_texture);
        let base = self.base_color(material, attributes, vertices, weights);
        let emission = product(material.emission, [red, green, blue]);
        material.appearance(base, [material.metallic * metal, material.roughness * rough], emission)
    }

    /// How much of the light the surface stops at that point of `triangle`: [`Appearance::alpha`].
    pub fn alpha_at(&self, triangle: u32, [b1, b2]: [f64; 2]) -> f32 {
        let surface = self.surface_of(triangle);
        let material = &self.materials[surface.material];
        let weights = [1.0 - b1 - b2, b1, b2];
        let [.., alpha] = match &surface.attributes {
            Some(attributes) => self.base_color(material, attributes, self.vertices_in(surface, triangle), weights),
            None => material.base_color,
        };
        material.alpha.of(alpha)
    }

    /// Factor × texture × vertex colour.
    fn base_color(
        &self,
        material: &Material,
        attributes: &Attributes,
        vertices: [usize; 3],
        weights: [f64; 3],
    ) -> [f32; 4] {
        let texel = self.texel(material.base_color_texture.as_ref(), attributes, vertices, weights);
        let color = attributes.colors(vertices).map_or(WHITE, |colors| mean(&colors, weights));
        product(product(material.base_color, texel), color)
    }

    /// What a texture shows, white where there is none.
    fn texel(
        &self,
        mapping: Option<&Mapping>,
        attributes: &Attributes,
        vertices: [usize; 3],
        weights: [f64; 3],
    ) -> [f32; 4] {
        let Some(mapping) = mapping else { return WHITE };
        let Some(corners) = attributes.coordinates(mapping.set, vertices) else { return WHITE };
        let uv: DVec2 = corners.iter().zip(weights).map(|(&corner, weight)| corner * weight).sum();
        mapping.at(&self.textures, uv)
    }

    /// Whether `triangle` is the same all over: its material shows no texture on it, and its vertices have no colours.
    pub fn is_uniform(&self, triangle: u32) -> bool {
        self.surface_of(triangle).attributes.is_none()
    }

    /// The vertices of `triangle` among those of its surface.
    pub(crate) fn vertices_in(&self, surface: &Surface, triangle: u32) -> [usize; 3] {
        self.mesh.triangles[triangle as usize].map(|vertex| (vertex - surface.vertices.start) as usize)
    }
}

impl Alpha {
    /// How much of the light a surface stops whose factor, texture and vertex colour come to `alpha`.
    pub(crate) fn of(self, alpha: f32) -> f32 {
        match self {
            Self::Opaque => 1.0,
            Self::Mask(cutoff) if alpha >= cutoff => 1.0,
            Self::Mask(_) => 0.0,
            Self::Blend => alpha,
        }
    }
}

const WHITE: [f32; 4] = [1.0; 4];

impl Material {
    /// What the surface is by the factors alone, whatever textures and vertex colours show.
    pub fn by_factors(&self) -> Appearance {
        self.appearance(self.base_color, [self.metallic, self.roughness], self.emission)
    }

    /// Whether it has a highlight somewhere: by its factors, or as far as a texture may say so.
    pub fn may_be_glossy(&self) -> bool {
        self.by_factors().is_glossy() || self.metallic_roughness_texture.is_some()
    }

    fn appearance(
        &self,
        [red, green, blue, alpha]: [f32; 4],
        [metallic, roughness]: [f32; 2],
        emission: [f32; 3],
    ) -> Appearance {
        let (alpha, base_color) = (self.alpha.of(alpha), [red, green, blue]);
        Appearance { base_color, alpha, metallic, roughness, specular: self.specular, f_0: self.f_0, emission }
    }
}

fn product<const N: usize>(a: [f32; N], b: [f32; N]) -> [f32; N] {
    std::array::from_fn(|i| a[i] * b[i])
}

fn mean(corners: &[[f32; 4]; 3], weights: [f64; 3]) -> [f32; 4] {
    let channel = |c: usize| corners.iter().zip(weights).map(|(corner, w)| f64::from(corner[c]) * w).sum::<f64>();
    std::array::from_fn(|c| channel(c) as f32)
}
