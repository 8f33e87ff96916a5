//! Materials: base colour, metallic and roughness, emission and alpha.

use std::collections::BTreeSet;

use gltf::json;
use gltf::json::material::AlphaMode;
use gltf::json::texture::Info;
use gltf::json::validation::Checked::Valid;

use crate::appearance::SMOOTHEST;
use crate::document::Document;
use crate::error::{Problem, malformed};
use crate::image::Encoding;
use crate::mapping::Mapping;
use crate::surface::Surface;
use crate::textures::{Gathered, Textures};
use crate::warnings::Warnings;

/// What a surface does with light and what light it gives: factors, and textures that they are multiplied with.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the file, or its place there.
    pub name: String,
    /// Diffuse albedo ρ (linear RGB) by the factors alone: base colour × (1 − metallic). The BRDF is ρ/π.
    pub albedo: [f32; 3],
    /// Linear red, green, blue and alpha; black where the material is unlit.
    pub base_color: [f32; 4],
    /// How far it is a metal, in [0, 1].
    pub metallic: f32,
    /// Perceptual roughness in [0, 1].
    pub roughness: f32,
    /// How much of its highlight a dielectric has, in [0, 1]: `specularFactor`. Where the file does not say, 1; but 0 for a
    /// dielectric of roughness 1, which is then Lambertian.
    pub specular: f32,
    /// What a dielectric reflects head-on, linear RGB in [0, 1]: 0.04 × `specularColorFactor`.
    pub f_0: [f32; 3],
    /// Emitted radiance `L_e` (linear RGB): emissiveFactor × emissiveStrength.
    pub emission: [f32; 3],
    /// Whether both sides emit, or the front alone.
    pub double_sided: bool,
    /// What alpha means.
    pub alpha: Alpha,
    /// Multiplied with `base_color`.
    pub base_color_texture: Option<Mapping>,
    /// Its green multiplied with `roughness`, its blue with `metallic`.
    pub metallic_roughness_texture: Option<Mapping>,
    /// Multiplied with `emission`.
    pub emissive_texture: Option<Mapping>,
}

/// What the alpha of a material means (glTF's `alphaMode`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Alpha {
    /// Nothing.
    Opaque,
    /// There where it is at least the cutoff, not there where it is less.
    Mask(f32),
    /// The share of light that it stops.
    Blend,
}

impl Material {
    /// Whether it emits in some channel, as far as the factors tell.
    pub fn emits(&self) -> bool {
        self.emission.iter().any(|&channel| channel > 0.0)
    }
}

/// The materials of a scene and what they show.
pub(crate) struct Materials {
    pub materials: Vec<Material>,
    pub gathered: Gathered,
}

/// The materials of the file in order, then glTF's default one where a surface has none; warns about what the surfaces
/// lose. Textures are read where a surface shows them.
pub(crate) fn read(
    document: &Document<'_>,
    surfaces: &[Surface],
    warnings: &mut Warnings,
) -> Result<Materials, Problem> {
    let root = &document.root;
    let named = |(i, material): (usize, &json::Material)| {
        let name = material.name.clone().unwrap_or_else(|| format!("materials[{i}]"));
        convert(material, name)
    };
    let mut materials = root.materials.iter().enumerate().map(named).collect::<Result<Vec<_>, _>>()?;
    let mut textures = Textures::of(document);
    let used: BTreeSet<usize> = surfaces.iter().map(|surface| surface.material).collect();
    for &index in &used {
        if let Some(material) = root.materials.get(index) {
            warn(material, &mut materials[index], warnings);
            texture(&mut materials[index], material, &mut textures, warnings)?;
        }
    }
    if used.contains(&root.materials.len()) {
        materials.push(convert(&json::Material::default(), "default".into())?);
    }
    Ok(Materials { materials, gathered: textures.gathered() })
}

fn convert(material: &json::Material, name: String) -> Result<Material, Problem> {
    let pbr = &material.pbr_metallic_roughness;
    let (mut base_color, mut metallic, roughness) =
        (pbr.base_color_factor.0, pbr.metallic_factor.0, pbr.roughness_factor.0);
    if !base_color.iter().chain([&metallic, &roughness]).all(|factor| (0.0..=1.0).contains(factor)) {
        return Err(fault(&name, "has a baseColorFactor, roughnessFactor or metallicFactor outside [0, 1]"));
    }
    let (mut specular, f_0) = highlight(material, &name)?;
    let mut emission = [0.0; 3];
    if is_unlit(material) {
        base_color[..3].fill(0.0);
        (metallic, specular) = (0.0, 0.0);
    } else {
        emission = self::emission(material, &name)?;
    }
    let [red, green, blue, _] = base_color;
    Ok(Material {
        albedo: [red, green, blue].map(|base| base * (1.0 - metallic)),
        alpha: alpha(material, &name)?,
        name,
        base_color,
        metallic,
        roughness,
        specular,
        f_0,
        emission,
        double_sided: material.double_sided,
        base_color_texture: None,
        metallic_roughness_texture: None,
        emissive_texture: None,
    })
}

/// What a dielectric of refractive index 1.5 reflects head-on.
const F_0: f32 = 0.04;

/// The highlight of a material as a dielectric: how much of it there is, and what it reflects head-on.
fn highlight(material: &json::Material, name: &str) -> Result<(f32, [f32; 3]), Problem> {
    let pbr = &material.pbr_metallic_roughness;
    let Some(specular) = material.extensions.as_ref().and_then(|extensions| extensions.specular.as_ref()) else {
        let dull =
            pbr.metallic_factor.0 == 0.0 && pbr.roughness_factor.0 == 1.0 && pbr.metallic_roughness_texture.is_none();
        return Ok((if dull { 0.0 } else { 1.0 }, [F_0; 3]));
    };
    let (factor, color) = (specular.specular_factor.0, specular.specular_color_factor.0);
    if (0.0..=1.0).contains(&factor) && color.iter().all(|channel| channel.is_finite() && *channel >= 0.0) {
        return Ok((factor, color.map(|channel| (F_0 * channel).min(1.0))));
    }
    Err(fault(name, "has a specularFactor outside [0, 1], or a specularColorFactor that is negative or not finite"))
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

fn alpha(material: &json::Material, name: &str) -> Result<Alpha, Problem> {
    let cutoff = material.alpha_cutoff.unwrap_or_default().0;
    match material.alpha_mode {
        Valid(AlphaMode::Mask) if cutoff >= 0.0 => Ok(Alpha::Mask(cutoff)),
        Valid(AlphaMode::Mask) => Err(fault(name, "has an alphaCutoff below zero")),
        Valid(AlphaMode::Blend) => Ok(Alpha::Blend),
        _ => Ok(Alpha::Opaque),
    }
}

/// Reads the textures of a material that a surface has. Without the one that it emits by, it would be another light;
/// without the others it is the surface that its factors make it.
fn texture(
    material: &mut Material,
    json: &json::Material,
    textures: &mut Textures<'_>,
    warnings: &mut Warnings,
) -> Result<(), Problem> {
    let pbr = &json.pbr_metallic_roughness;
    let mut optional = |info: &Option<Info>, encoding| {
        let mapping = textures.mapping(info.as_ref()?, encoding);
        let text = |problem| format!("a texture cannot be used and its factor alone counts ({problem})");
        mapping.map_err(|problem| warnings.at(&text(problem), &material.name)).ok()
    };
    material.base_color_texture = optional(&pbr.base_color_texture, Encoding::Srgb);
    material.metallic_roughness_texture = optional(&pbr.metallic_roughness_texture, Encoding::Linear);
    if let Some(info) = json.emissive_texture.as_ref().filter(|_| material.emits()) {
        let of_light = |problem| Problem::Emission { material: material.name.clone(), problem: Box::new(problem) };
        material.emissive_texture = Some(textures.mapping(info, Encoding::Srgb).map_err(of_light)?);
    }
    Ok(())
}

fn fault(name: &str, fault: &str) -> Problem {
    malformed(format!("material {name:?}"), fault)
}

/// Whether a material of a file is unlit: it has a colour of its own, whatever the light.
pub(crate) fn is_unlit(material: &json::Material) -> bool {
    material.extensions.as_ref().is_some_and(|extensions| extensions.unlit.is_some())
}

/// Warns about what a material loses. A surface that emits and is blended is taken to be opaque.
fn warn(json: &json::Material, material: &mut Material, warnings: &mut Warnings) {
    let pbr = &json.pbr_metallic_roughness;
    let blended = material.emits() && material.alpha == Alpha::Blend;
    let specular = json.extensions.as_ref().and_then(|extensions| extensions.specular.as_ref());
    let textured_highlight = specular
        .is_some_and(|specular| specular.specular_texture.is_some() || specular.specular_color_texture.is_some());
    let mirror = pbr.roughness_factor.0 < SMOOTHEST;
    let losses = [
        (is_unlit(json), "an unlit material is black and emits nothing"),
        (json.normal_texture.is_some(), "normal textures are ignored, surfaces are flat"),
        (json.occlusion_texture.is_some(), "occlusion textures are ignored, what blocks is what is there"),
        (textured_highlight, "textures of highlights are ignored, factors alone count"),
        (mirror && !is_unlit(json), "a mirror has no f_r and is taken as rough as 1/32"),
        (blended, "a surface that emits is opaque, though it is to be blended"),
    ];
    for (_, text) in losses.iter().filter(|(lost, _)| *lost) {
        warnings.at(text, &material.name);
    }
    if blended {
        material.alpha = Alpha::Opaque;
    }
}
