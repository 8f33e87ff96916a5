//! From a file to a scene, step by step.

use std::path::Path;

use sha2::{Digest, Sha256};

use crate::assembly::Assembly;
use crate::buffer::read_plain;
use crate::document::Document;
use crate::error::Problem;
use crate::light::Lights;
use crate::material::Materials;
use crate::nodes::assemble;
use crate::scene::Scene;
use crate::textures::Gathered;
use crate::warnings::Warnings;
use crate::{camera, extensions, hierarchy, light, lost, material, receiver};

pub(crate) fn from_file(path: &Path) -> Result<Scene, Problem> {
    let unreadable = |error: std::io::Error| Problem::Unreadable { what: "the file".into(), reason: error.to_string() };
    from_bytes(&read_plain(path, u64::MAX).map_err(unreadable)?, path)
}

pub(crate) fn from_bytes(bytes: &[u8], path: &Path) -> Result<Scene, Problem> {
    let document = Document::open(bytes, path)?;
    let mut warnings = Warnings::default();
    extensions::warn(&document.root, &mut warnings);
    if document.animated {
        warnings.say("animations are ignored: nodes stand in their rest pose");
    }
    let (mut scene, files) = read(&document, &mut warnings)?;
    path.clone_into(&mut scene.path);
    scene.sha256 = digest(bytes, &document, &files);
    scene.warnings = warnings.lines();
    Ok(scene)
}

/// The scene and the bytes of the image files that were read.
fn read(document: &Document<'_>, warnings: &mut Warnings) -> Result<(Scene, Vec<Vec<u8>>), Problem> {
    let placed = hierarchy::placed(document, warnings)?;
    let Assembly { mesh, mut surfaces } = assemble(document, &placed, warnings)?;
    let Materials { materials, gathered } = material::read(document, &surfaces, warnings)?;
    let Gathered { textures, images, files } = gathered;
    let shown = (materials.as_slice(), textures.as_slice());
    let Lights { targets, lights } = light::find(&mesh, &mut surfaces, shown, warnings)?;
    let receivers = receiver::read(document, &placed, warnings)?;
    let scene = Scene {
        cameras: camera::read(document, &placed, warnings)?,
        punctual_lights: lost::punctual(document, &placed, warnings),
        lost_lights: lost::empty(document, &placed, &receivers, warnings),
        receivers,
        mesh: mesh.into(),
        surfaces,
        materials,
        textures,
        images,
        targets,
        lights,
        ..Scene::default()
    };
    Ok((scene, files))
}

/// SHA-256 of the file, of the buffer files after it, and of the image files after those.
fn digest(bytes: &[u8], document: &Document<'_>, images: &[Vec<u8>]) -> String {
    let mut digest = Sha256::new();
    digest.update(bytes);
    for buffer in document.buffers.iter().filter(|buffer| buffer.external) {
        digest.update(buffer.bytes.as_deref().unwrap_or_default());
    }
    for image in images {
        digest.update(image);
    }
    digest.finalize().iter().fold(String::new(), |hex, byte| hex + &format!("{byte:02x}"))
}
