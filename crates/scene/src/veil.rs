//! Which triangles are not opaque, and what they stop.

use std::sync::Arc;

use twoforms_geometry::veil::{Cover, Veil};

use crate::material::Alpha;
use crate::scene::Scene;
use crate::surface::Surface;

impl Scene {
    /// What light passes: surfaces that are cut out by a mask, and those that are blended with what is behind them. None where
    /// all surfaces are opaque, as those are too whose alpha is large enough all over.
    pub fn veil(&self) -> Option<Veil> {
        let cover = |surface: &Surface| vec![self.cover(surface); surface.triangles.len()];
        let covers: Vec<Cover> = self.surfaces.iter().flat_map(cover).collect();
        if covers.iter().all(|&cover| cover == Cover::Opaque) {
            return None;
        }
        let kept = Arc::new(self.surfaces_alone());
        Veil::new(covers, Arc::new(move |triangle, at| kept.alpha_at(triangle, at)))
    }

    fn cover(&self, surface: &Surface) -> Cover {
        let material = &self.materials[surface.material];
        if material.alpha.of(self.least_alpha(surface)) >= 1.0 {
            return Cover::Opaque;
        }
        match material.alpha {
            Alpha::Opaque => Cover::Opaque,
            Alpha::Mask(_) => Cover::Cut,
            Alpha::Blend => Cover::Blended,
        }
    }

    /// The least alpha that factor, texture and vertex colours can come to on a surface.
    fn least_alpha(&self, surface: &Surface) -> f32 {
        let material = &self.materials[surface.material];
        let [.., factor] = material.base_color;
        let Some(attributes) = &surface.attributes else { return factor };
        let shown = material.base_color_texture.as_ref().filter(|mapping| attributes.set(mapping.set).is_some());
        let texel = shown.map_or(1.0, |mapping| self.textures[mapping.texture].image.least_alpha());
        factor * texel * attributes.least_alpha()
    }

    /// What surfaces look like, without all else that a scene holds.
    fn surfaces_alone(&self) -> Self {
        let bare = |surface: &Surface| Surface { normals: None, ..surface.clone() };
        Self {
            mesh: self.mesh.clone(),
            surfaces: self.surfaces.iter().map(bare).collect(),
            materials: self.materials.clone(),
            textures: self.textures.clone(),
            ..Self::default()
        }
    }
}
