//! The lights of a scene, as estimators need them.

use twoforms_scene::Scene;

/// What is constant over each target: its area, its radiance, and the light it belongs to.
#[derive(Clone, Debug)]
pub struct Lights {
    radiance: Vec<[f32; 3]>,
    area: Vec<f64>,
    light: Vec<usize>,
    light_area: Vec<f64>,
    power: Vec<f64>,
}

impl Lights {
    /// The lights of `scene`.
    pub fn new(scene: &Scene) -> Self {
        let targets = &scene.targets;
        let indices = 0..targets.len() as u32;
        Self {
            radiance: indices.clone().map(|k| scene.target_radiance(k)).collect(),
            area: targets.iter().map(|target| target.area(&scene.mesh)).collect(),
            light: indices.map(|k| scene.light_of(k)).collect(),
            light_area: scene.lights.iter().map(|light| light.area).collect(),
            power: scene.lights.iter().map(|light| crate::rgb::luminance(light.power())).collect(),
        }
    }

    /// Number of targets.
    pub fn targets(&self) -> usize {
        self.area.len()
    }

    /// L_e of a target, RGB.
    #[inline(always)]
    pub fn radiance(&self, target: u32) -> &[f32; 3] {
        &self.radiance[target as usize]
    }

    /// Area of each target in square metres.
    pub fn areas(&self) -> &[f64] {
        &self.area
    }

    /// The light that each target belongs to.
    pub fn light_of_target(&self) -> &[usize] {
        &self.light
    }

    /// Area of each light in square metres, once, whatever the sides.
    pub fn light_areas(&self) -> &[f64] {
        &self.light_area
    }

    /// Luminous power of each light: π A L for each side that emits.
    pub fn powers(&self) -> &[f64] {
        &self.power
    }
}
