//! The lights of a scene, as estimators need them.

use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

use glam::DVec3;
use twoforms_geometry::solid_angle::projected_solid_angle;
use twoforms_geometry::target::{Shape, Sides, Target};
use twoforms_geometry::view::View;
use twoforms_scene::{Emission, Light, Pattern, Scene};

use crate::cells::Cells;
use crate::rgb::luminance;
use crate::tree::{Emitter, Tree};

/// What is constant over each target: its area, its mean radiance, and the light it belongs to; and what is not, the radiance
/// of those that emit by a texture.
#[derive(Clone, Debug)]
pub struct Lights {
    radiance: Vec<[f32; 3]>,
    /// What leaves each target, if some emit by a texture; else none.
    emission: Vec<Emission>,
    /// The cells of those that do.
    cells: Vec<Option<Arc<Cells>>>,
    /// Whether what arrives from a target must be looked up point by point.
    varies: bool,
    sides: Vec<Sides>,
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
        let textured = scene.lights.iter().any(Light::is_textured);
        let looked_up = if textured { indices.clone() } else { 0..0 };
        let mut lights = Self {
            emitters: indices.clone().map(emitter).collect(),
            tree: OnceLock::new(),
            emission: looked_up.map(|k| scene.target_emission(k)).collect(),
            cells: Vec::new(),
            sides: targets.iter().map(|target| target.sides).collect(),
            radiance: indices.clone().map(|k| scene.target_radiance(k)).collect(),
            area: targets.iter().map(|target| target.area(&scene.mesh)).collect(),
            varies: textured || scene.veil().is_some(),
            light: indices.map(|k| scene.light_of(k)).collect(),
            light_area: scene.lights.iter().map(|light| light.area).collect(),
            power: scene.lights.iter().map(|light| luminance(light.power())).collect(),
        };
        let cells = (0..lights.emission.len() as u32).map(|k| lights.make_cells(k, &targets[k as usize]));
        lights.cells = cells.collect();
        for (light, own) in scene.lights.iter().enumerate().filter(|(_, own)| own.is_textured()) {
            lights.power[light] = PI * own.targets.clone().map(|k| lights.emitted(k)).sum::<f64>();
        }
        lights
    }

    fn make_cells(&self, target: u32, own: &Target) -> Option<Arc<Cells>> {
        let triangle = matches!(own.shape, Shape::Triangle(_));
        let cells = |pattern| Cells::new(pattern, triangle, self.sides(target), self.targets());
        self.pattern(target).map(cells).map(Arc::new)
    }

    /// Number of targets.
    pub fn targets(&self) -> usize {
        self.area.len()
    }

    /// L_e of a target, RGB: its mean over the area where it emits by a texture.
    #[inline(always)]
    pub fn radiance(&self, target: u32) -> &[f32; 3] {
        &self.radiance[target as usize]
    }

    /// Whether some light emits by a texture.
    #[inline(always)]
    pub fn are_textured(&self) -> bool {
        !self.emission.is_empty()
    }

    /// Whether what x receives from a target must be looked up point by point: some light emits by a texture, or something is
    /// not opaque.
    #[inline(always)]
    pub fn vary(&self) -> bool {
        self.varies
    }

    /// The texture that a target emits by, if it does.
    pub fn pattern(&self, target: u32) -> Option<&Pattern> {
        match self.emission.get(target as usize) {
            Some(Emission::Textured(pattern)) => Some(pattern),
            _ => None,
        }
    }

    /// L_e at a point of a target (world, metres), RGB.
    pub fn radiance_at(&self, target: u32, y: DVec3) -> [f32; 3] {
        match self.emission.get(target as usize) {
            Some(emission) => emission.at_point(y),
            None => *self.radiance(target),
        }
    }

    /// The cells that a target falls into by what it emits, where it emits by a texture.
    pub fn cells(&self, target: u32) -> Option<&Arc<Cells>> {
        self.cells.get(target as usize).and_then(Option::as_ref)
    }

    /// Luminance that a target emits, times its area and the sides that emit: its power over π.
    pub fn emitted(&self, target: u32) -> f64 {
        let luminance = || self.sides(target) * luminance(self.radiance(target).map(f64::from));
        self.area[target as usize] * self.cells(target).map_or_else(luminance, |cells| cells.mean_value())
    }

    /// How many sides of a target emit.
    pub fn sides(&self, target: u32) -> f64 {
        match self.sides[target as usize] {
            Sides::Front => 1.0,
            Sides::Both => 2.0,
        }
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

    /// Luminance of the irradiance at x from each target, were nothing in between, in W/m²: from [`Lights::unoccluded`].
    pub fn contributions(&self, unoccluded: &[f64]) -> Vec<f64> {
        let received = |(open, radiance): (&f64, &[f32; 3])| luminance(radiance.map(f64::from)) * open;
        unoccluded.iter().zip(&self.radiance).map(received).collect()
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
