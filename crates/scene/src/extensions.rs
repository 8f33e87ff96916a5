//! Extensions: which are read, which are ignored with a warning, which are refused.

use gltf::json::Root;

use crate::error::Problem;
use crate::warnings::Warnings;

/// How to get rid of compression.
pub(crate) const UNPACK: &str = "`npx @gltf-transform/cli copy in.glb out.glb` writes the scene without compression";

pub(crate) const QUANTIZATION: &str = "KHR_mesh_quantization";

/// Read, or without effect on what is read. Unlit materials and punctual lights warn where they stand.
const READ: [&str; 7] = [
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_texture_transform",
    QUANTIZATION,
];

/// Ignored, each with its warning: how a surface reflects beyond metal, roughness and highlight, and images in other formats.
const IGNORED: [(&str, &str); 9] = [
    ("KHR_materials_anisotropy", GLOSS),
    ("KHR_materials_clearcoat", GLOSS),
    ("KHR_materials_ior", GLOSS),
    ("KHR_materials_iridescence", GLOSS),
    ("KHR_materials_sheen", GLOSS),
    ("KHR_materials_transmission", OPAQUE),
    ("KHR_materials_volume", OPAQUE),
    ("KHR_texture_basisu", IMAGES),
    ("EXT_texture_webp", IMAGES),
];

const GLOSS: &str = "surfaces reflect by metal and roughness alone";
const OPAQUE: &str = "surfaces are opaque";
const IMAGES: &str = "images other than PNG and JPEG are not read";

/// Compression: refused where a file requires it.
const COMPRESSION: [&str; 2] = ["KHR_draco_mesh_compression", "EXT_meshopt_compression"];

/// Refuses a file that requires what is not read.
pub(crate) fn check(root: &Root) -> Result<(), Problem> {
    let refused = root.extensions_required.iter().find(|name| !known(name));
    refused.map_or(Ok(()), |name| Err(refusal(name)))
}

/// Warns about what the file uses and this crate ignores.
pub(crate) fn warn(root: &Root, warnings: &mut Warnings) {
    for name in &root.extensions_used {
        match IGNORED.iter().find(|(ignored, _)| ignored == name) {
            Some((_, effect)) => warnings.at(&format!("an extension is ignored, {effect}"), name),
            None if READ.contains(&name.as_str()) => {}
            None => warnings.at("an extension is ignored, it is not known here", name),
        }
    }
}

/// Whether the file says that some of its data are compressed.
pub(crate) fn compressed(root: &Root) -> bool {
    COMPRESSION.iter().any(|extension| uses(root, extension))
}

/// Whether the file says that it uses `extension`.
pub(crate) fn uses(root: &Root, extension: &str) -> bool {
    root.extensions_used.iter().any(|name| name == extension)
}

fn known(name: &str) -> bool {
    READ.contains(&name) || IGNORED.iter().any(|(ignored, _)| *ignored == name)
}

fn refusal(name: &str) -> Problem {
    let remedy = if COMPRESSION.contains(&name) { UNPACK } else { "export the scene without it" };
    let what = format!("the file requires the extension {name:?}, which is not read");
    Problem::Unsupported { what, remedy: remedy.into() }
}
