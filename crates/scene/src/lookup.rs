//! Questions to a scene: from a triangle to its surface, from a target to its light.

use crate::error::{Problem, SceneError};
use crate::light::Light;
use crate::material::Material;
use crate::scene::Scene;
use crate::surface::Surface;

impl Scene {
    /// The surface that `triangle` of the mesh belongs to.
    pub fn surface_of(&self, triangle: u32) -> &Surface {
        let index = self.surfaces.partition_point(|s| s.triangles.end <= triangle);
        &self.surfaces[index]
    }

    /// The material of `triangle`.
    pub fn material_of(&self, triangle: u32) -> &Material {
        &self.materials[self.surface_of(triangle).material]
    }

    /// The diffuse albedo (linear RGB) of `triangle` by the factors of its material: all of it where [`Scene::is_uniform`].
    pub fn albedo(&self, triangle: u32) -> [f32; 3] {
        self.material_of(triangle).albedo
    }

    /// Index of the light that `target` is a piece of.
    pub fn light_of(&self, target: u32) -> usize {
        self.lights.partition_point(|light| light.targets.end <= target)
    }

    /// The light that `target` is a piece of.
    pub fn target_light(&self, target: u32) -> &Light {
        &self.lights[self.light_of(target)]
    }

    /// The radiance (linear RGB) that leaves `target` on its emitting sides; of a textured one its mean over the area.
    pub fn target_radiance(&self, target: u32) -> [f32; 3] {
        let light = self.target_light(target);
        let mean = light.means.get((target - light.targets.start) as usize);
        mean.map_or(light.radiance, |mean| mean.map(|channel| channel as f32))
    }

    /// Checks that there is a light, for commands that need one.
    ///
    /// # Errors
    /// [`Problem::NoEmitter`], which says what may have become of lights that the author meant to be there.
    pub fn require_emitters(&self) -> Result<(), SceneError> {
        if !self.lights.is_empty() {
            return Ok(());
        }
        let problem = Problem::NoEmitter(self.lost_lights_clause() + &self.punctual_clause());
        Err(SceneError::at(&self.path, problem))
    }

    fn lost_lights_clause(&self) -> String {
        match self.lost_lights.as_slice() {
            [] => String::new(),
            [name] => format!(", but the node {name:?} is empty and named like a light: {BLENDER}"),
            [name, ..] => {
                let count = self.lost_lights.len();
                format!(", but {count} nodes are empty and named like lights ({name:?}, …): {BLENDER}")
            }
        }
    }

    fn punctual_clause(&self) -> String {
        match self.punctual_lights {
            0 => String::new(),
            1 => ", and its punctual light has no area, so that no direction finds it".into(),
            n => format!(", and its {n} punctual lights have no area, so that no direction finds them"),
        }
    }
}

/// What empty nodes named like lights usually come from.
const BLENDER: &str = "did you export Blender area lights? glTF has none, use an emissive plane instead";
