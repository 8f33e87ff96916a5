//! Lights: instances of primitives whose material emits.

use std::f64::consts::PI;
use std::ops::Range;

use gltf::json;
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::target::{Sides, Target};

use crate::coincident::Seen;
use crate::error::Problem;
use crate::material::Material;
use crate::pairing;
use crate::surface::Surface;
use crate::warnings::Warnings;

/// One instance of one primitive whose material emits. Its radiance is constant over its targets.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Name of its surface.
    pub name: String,
    /// Its pieces among the scene's targets, never empty.
    pub targets: Range<u32>,
    /// Emitted radiance `L_e` (linear RGB).
    pub radiance: [f32; 3],
    /// Where light leaves it.
    pub sides: Sides,
    /// Sum of the areas of its targets in square metres, once, whatever the sides.
    pub area: f64,
}

impl Light {
    /// Emitted power (linear RGB): Φ = π A `L_e` for each side that emits.
    pub fn power(&self) -> [f64; 3] {
        let sides = match self.sides {
            Sides::Front => 1.0,
            Sides::Both => 2.0,
        };
        self.radiance.map(|channel| PI * self.area * f64::from(channel) * sides)
    }
}

/// The lights of a scene and their pieces.
#[derive(Default)]
pub(crate) struct Lights {
    pub targets: Vec<Target>,
    pub lights: Vec<Light>,
}

/// Makes a light of every surface whose material emits, and notes it there.
pub(crate) fn find(mesh: &Mesh, surfaces: &mut [Surface], materials: &[Material], warnings: &mut Warnings) -> Lights {
    let (mut found, mut seen) = (Lights::default(), Seen::default());
    for surface in surfaces {
        let material = &materials[surface.material];
        if material.emits() {
            let triangles = emitting(mesh, surface, &mut seen, warnings);
            surface.light = found.add(mesh, surface, material, &triangles);
        }
    }
    found
}

impl Lights {
    fn add(&mut self, mesh: &Mesh, surface: &Surface, material: &Material, triangles: &[u32]) -> Option<usize> {
        let sides = if material.double_sided { Sides::Both } else { Sides::Front };
        let first = self.targets.len();
        self.targets.extend(pairing::targets(mesh, triangles, sides));
        let targets = &self.targets[first..];
        if targets.is_empty() {
            return None;
        }
        self.lights.push(Light {
            name: surface.name.clone(),
            targets: first as u32..self.targets.len() as u32,
            radiance: material.emission,
            sides,
            area: targets.iter().map(|target| target.area(mesh)).sum(),
        });
        Some(self.lights.len() - 1)
    }
}

/// The triangles of a surface that can emit: those with an area that no earlier emitter covers.
fn emitting(mesh: &Mesh, surface: &Surface, seen: &mut Seen, warnings: &mut Warnings) -> Vec<u32> {
    let mut emits = |&index: &u32| {
        let triangle = mesh.triangle(index);
        if triangle.area() == 0.0 {
            warnings.at("emitting triangles without area are dropped as emitters", &surface.name);
            return false;
        }
        let first = seen.is_first(&triangle);
        if !first {
            warnings
                .at("emitting triangles that coincide with an earlier emitter are dropped as emitters", &surface.name);
        }
        first
    };
    surface.triangles.clone().filter(|index| emits(index)).collect()
}

/// Refuses emission by a texture: it would be read as constant.
pub(crate) fn refuse_textured(root: &json::Root, surfaces: &[Surface], materials: &[Material]) -> Result<(), Problem> {
    let textured = |surface: &&Surface| {
        let material = root.materials.get(surface.material);
        materials[surface.material].emits() && material.is_some_and(|m| m.emissive_texture.is_some())
    };
    let Some(surface) = surfaces.iter().find(textured) else {
        return Ok(());
    };
    let material = &materials[surface.material].name;
    Err(Problem::Unsupported {
        what: format!("material {material:?} of {:?} emits by an emissiveTexture, which is not read", surface.name),
        remedy: "give it a constant emissiveFactor without the texture".into(),
    })
}
