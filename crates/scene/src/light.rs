//! Lights: instances of primitives whose material emits.

use std::f64::consts::PI;
use std::ops::Range;

use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::target::{Sides, Target};

use crate::coincident::Seen;
use crate::error::Problem;
use crate::glow::Glow;
use crate::material::Material;
use crate::pairing;
use crate::surface::Surface;
use crate::texture::Texture;
use crate::warnings::Warnings;

/// One instance of one primitive whose material emits, by one radiance or by a texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Name of its surface.
    pub name: String,
    /// Its pieces among the scene's targets, never empty.
    pub targets: Range<u32>,
    /// Emitted radiance `L_e` (linear RGB); of a textured light its mean over the area.
    pub radiance: [f32; 3],
    /// Mean of `L_e` over each of its targets where it is textured, else empty.
    pub means: Vec<[f64; 3]>,
    /// Where light leaves it.
    pub sides: Sides,
    /// Sum of the areas of its targets in square metres, once, whatever the sides.
    pub area: f64,
}

impl Light {
    /// Whether its radiance is that of a texture.
    pub fn is_textured(&self) -> bool {
        !self.means.is_empty()
    }

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
pub(crate) fn find(
    mesh: &Mesh,
    surfaces: &mut [Surface],
    (materials, textures): (&[Material], &[Texture]),
    warnings: &mut Warnings,
) -> Result<Lights, Problem> {
    let (mut found, mut seen) = (Lights::default(), Seen::default());
    for surface in surfaces {
        let material = &materials[surface.material];
        if material.emits() {
            let glow = Glow::of(surface, material, textures)?;
            let triangles = emitting(mesh, surface, glow.as_ref(), &mut seen, warnings);
            let light = found.add(mesh, surface, material, glow.as_ref(), &triangles);
            surface.light = light;
        }
    }
    Ok(found)
}

/// A triangle that emits, with its mean radiance where it is textured.
struct Emitting {
    triangle: u32,
    mean: [f64; 3],
}

impl Lights {
    fn add(
        &mut self,
        mesh: &Mesh,
        surface: &Surface,
        material: &Material,
        glow: Option<&Glow<'_>>,
        emitting: &[Emitting],
    ) -> Option<usize> {
        let sides = if material.double_sided { Sides::Both } else { Sides::Front };
        let first = self.targets.len();
        let triangles: Vec<u32> = emitting.iter().map(|emitting| emitting.triangle).collect();
        self.targets.extend(pairing::targets(mesh, &triangles, sides, glow));
        let targets = &self.targets[first..];
        if targets.is_empty() {
            return None;
        }
        let means: Vec<_> =
            glow.iter().flat_map(|_| targets.iter().map(|target| mean(mesh, target, emitting))).collect();
        let areas: Vec<f64> = targets.iter().map(|target| target.area(mesh)).collect();
        self.lights.push(Light {
            name: surface.name.clone(),
            targets: first as u32..self.targets.len() as u32,
            radiance: if means.is_empty() { material.emission } else { weighted(&means, &areas).map(|c| c as f32) },
            means,
            sides,
            area: areas.iter().sum(),
        });
        Some(self.lights.len() - 1)
    }
}

/// Mean radiance over a target from those over its triangles.
fn mean(mesh: &Mesh, target: &Target, emitting: &[Emitting]) -> [f64; 3] {
    let of = |triangle| emitting.binary_search_by_key(&triangle, |e| e.triangle).map_or([0.0; 3], |i| emitting[i].mean);
    let (means, areas): (Vec<_>, Vec<_>) = target.triangles().map(|t| (of(t), mesh.triangle(t).area())).unzip();
    weighted(&means, &areas)
}

fn weighted(means: &[[f64; 3]], areas: &[f64]) -> [f64; 3] {
    let total: f64 = areas.iter().sum();
    std::array::from_fn(|c| means.iter().zip(areas).map(|(mean, area)| mean[c] * area).sum::<f64>() / total)
}

/// The triangles of a surface that can emit: those with an area, on which its texture is not black, and which no earlier
/// emitter covers.
fn emitting(
    mesh: &Mesh,
    surface: &Surface,
    glow: Option<&Glow<'_>>,
    seen: &mut Seen,
    warnings: &mut Warnings,
) -> Vec<Emitting> {
    let mut emits = |index: u32| {
        let triangle = mesh.triangle(index);
        if triangle.area() == 0.0 {
            warnings.at("emitting triangles without area are dropped as emitters", &surface.name);
            return None;
        }
        let mean = glow.map(|glow| glow.mean(mesh, index));
        if mean == Some([0.0; 3]) {
            warnings.at("emitting triangles on which the texture is black are dropped as emitters", &surface.name);
            return None;
        }
        if !seen.is_first(&triangle) {
            warnings
                .at("emitting triangles that coincide with an earlier emitter are dropped as emitters", &surface.name);
            return None;
        }
        Some(Emitting { triangle: index, mean: mean.unwrap_or_default() })
    };
    surface.triangles.clone().filter_map(&mut emits).collect()
}
