//! The lights of a scene, as estimators need them.

use std::sync::{Arc, OnceLock};

use twoforms_geometry::solid_angle::projected_solid_angle;
use twoforms_geometry::view::View;
use twoforms_scene::Scene;

use crate::rgb::luminance;
use crate::tree::{Emitter, Tree};

/// What is constant over each target: its area, its radiance, and the light it belongs to.
#[derive(Clone, Debug)]
pub struct Lights {
    radiance: Vec<[f32; 3]>,
    area: Vec<f64>,
    light: Vec<usize>,
    light_area: Vec<f64>,
    power: Vec<f64>,
    emitters: Vec<Emitter>,
    tree: OnceLock<Arc<Tree>>,
}

impl Lights {
    /// The lights of `scene`.
    pub fn new(scene: &Scene) -> Self {
        let targets = &scene.targets;
        let indices = 0..targets.len() as u32;
        let emitter = |k: u32| {
            let radiance = luminance(scene.target_radiance(k).map(f64::from));
            Emitter::new(&targets[k as usize], &scene.mesh, radiance)
        };
        Self {
            emitters: indices.clone().map(emitter).collect(),
            tree: OnceLock::new(),
            radiance: indices.clone().map(|k| scene.target_radiance(k)).collect(),
            area: targets.iter().map(|target| target.area(&scene.mesh)).collect(),
            light: indices.map(|k| scene.light_of(k)).collect(),
            light_area: scene.lights.iter().map(|light| light.area).collect(),
            power: scene.lights.iter().map(|light| luminance(light.power())).collect(),
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

    /// What each light's targets add up to.
    pub fn sums(&self, of_targets: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.light_area.len()];
        self.light.iter().zip(of_targets).for_each(|(&light, part)| sums[light] += part);
        sums
    }

    /// ∫ cosθ_x dω over each target above the horizon, were nothing in between; zero for one that x does not face.
    pub fn unoccluded(&self, view: &View) -> Vec<f64> {
        (0..self.targets() as u32).map(|k| view.facing(k, projected_solid_angle).unwrap_or(0.0)).collect()
    }

    /// Luminance of the irradiance at x from each target, were nothing in between, in W/m².
    pub fn contributions(&self, view: &View) -> Vec<f64> {
        let received = |(open, radiance): (f64, &[f32; 3])| luminance(radiance.map(f64::from)) * open;
        self.unoccluded(view).into_iter().zip(&self.radiance).map(received).collect()
    }

    /// Area of each light in square metres, once, whatever the sides.
    pub fn light_areas(&self) -> &[f64] {
        &self.light_area
    }

    /// The tree over the targets, of which there must be one; built when it is first asked for.
    pub fn tree(&self) -> &Arc<Tree> {
        self.tree.get_or_init(|| Arc::new(Tree::new(&self.emitters, &self.area)))
    }

    /// Luminous power of each light: π A L for each side that emits.
    pub fn powers(&self) -> &[f64] {
        &self.power
    }
}
