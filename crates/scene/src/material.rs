//! Materials, in the Lambertian model: albedo and emission.

use std::collections::BTreeSet;

use gltf::json;
use gltf::json::material::AlphaMode;
use gltf::json::validation::Checked::Valid;

use crate::error::{Problem, malformed};
use crate::surface::Surface;
use crate::warnings::Warnings;

/// What a surface does with light and what light it gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the file, or its place there.
    pub name: String,
    /// Diffuse albedo ρ (linear RGB): base colour × (1 − metallic). The BRDF is ρ/π.
    pub albedo: [f32; 3],
    /// Emitted radiance `L_e` (linear RGB): emissiveFactor × emissiveStrength.
    pub emission: [f32; 3],
    /// Whether both sides emit, or the front alone.
    pub double_sided: bool,
}

impl Material {
    /// Whether it emits in some channel.
    pub fn emits(&self) -> bool {
        self.emission.iter().any(|&channel| channel > 0.0)
    }
}

/// The materials of the file in order, then glTF's default one where a surface has none; warns about what the surfaces
/// lose.
pub(crate) fn read(root: &json::Root, surfaces: &[Surface], warnings: &mut Warnings) -> Result<Vec<Material>, Problem> {
    let named = |(i, material): (usize, &json::Material)| {
        let name = material.name.clone().unwrap_or_else(|| format!("materials[{i}]"));
        convert(material, name)
    };
    let mut materials = root.materials.iter().enumerate().map(named).collect::<Result<Vec<_>, _>>()?;
    let used: BTreeSet<usize> = surfaces.iter().map(|surface| surface.material).collect();
    for &index in &used {
        if let Some(material) = root.materials.get(index) {
            warn(material, &materials[index].name, warnings);
        }
    }
    if used.contains(&root.materials.len()) {
        warnings.say("surfaces without a material are black: glTF's default is a metal");
        materials.push(convert(&json::Material::default(), "default".into())?);
    }
    Ok(materials)
}

fn convert(material: &json::Material, name: String) -> Result<Material, Problem> {
    let (albedo, emission) =
        if is_unlit(material) { ([0.0; 3], [0.0; 3]) } else { (albedo(material, &name)?, emission(material, &name)?) };
    Ok(Material { name, albedo, emission, double_sided: material.double_sided })
}

fn albedo(material: &json::Material, name: &str) -> Result<[f32; 3], Problem> {
    let [red, green, blue, _] = material.pbr_metallic_roughness.base_color_factor.0;
    let metallic = material.pbr_metallic_roughness.metallic_factor.0;
    if [red, green, blue, metallic].iter().all(|factor| (0.0..=1.0).contains(factor)) {
        return Ok([red, green, blue].map(|base| base * (1.0 - metallic)));
    }
    Err(fault(name, "has a baseColorFactor or metallicFactor outside [0, 1]"))
}

fn emission(material: &json::Material, name: &str) -> Result<[f32; 3], Problem> {
    let strength = material.extensions.as_ref().and_then(|e| e.emissive_strength.as_ref());
    let strength = strength.map_or(1.0, |strength| strength.emissive_strength.0);
    let emission = material.emissive_factor.0.map(|factor| factor * strength);
    if strength >= 0.0 && emission.iter().all(|&channel| channel >= 0.0 && channel.is_finite()) {
        return Ok(emission);
    }
    Err(fault(name, "has an emissiveFactor or emissiveStrength that is negative or not finite"))
}

fn fault(name: &str, fault: &str) -> Problem {
    malformed(format!("material {name:?}"), fault)
}

fn is_unlit(material: &json::Material) -> bool {
    material.extensions.as_ref().is_some_and(|extensions| extensions.unlit.is_some())
}

fn warn(material: &json::Material, name: &str, warnings: &mut Warnings) {
    let pbr = &material.pbr_metallic_roughness;
    let textured = pbr.base_color_texture.is_some()
        || pbr.metallic_roughness_texture.is_some()
        || material.normal_texture.is_some()
        || material.occlusion_texture.is_some();
    let metal = pbr.metallic_factor.0 > 0.0;
    let opaque = material.alpha_mode == Valid(AlphaMode::Opaque);
    let losses = [
        (is_unlit(material), "an unlit material is black and emits nothing"),
        (textured, "textures are ignored, factors alone count"),
        (metal && !is_unlit(material), "a metal is black as far as it is metallic"),
        (!opaque, "alpha is ignored, surfaces are opaque"),
    ];
    for (_, text) in losses.iter().filter(|(lost, _)| *lost) {
        warnings.at(text, name);
    }
}
