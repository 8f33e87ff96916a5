//! The scene: all that later stages read.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::target::Target;

use crate::camera::Camera;
use crate::error::SceneError;
use crate::image::Image;
use crate::light::Light;
use crate::load;
use crate::material::Material;
use crate::receiver::Receiver;
use crate::surface::Surface;
use crate::texture::Texture;

/// A scene in world space: metres, radiance as the file gives it (for glTF, cd/m²; any unit proportional to it serves).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// The file it was read from.
    pub path: PathBuf,
    /// SHA-256 in hexadecimal of the file, followed by the buffer files that it names, in order, and by the image files
    /// that were read, in order.
    pub sha256: String,
    /// All triangles. Vertices that a primitive shares stay shared. Counted, since the hierarchy holds it too.
    pub mesh: Arc<Mesh>,
    /// One per instance of a primitive, in scene order (nodes depth first, primitives in order); their runs of
    /// triangles follow one another without a gap.
    pub surfaces: Vec<Surface>,
    /// Materials in file order, then glTF's default material where a surface has none.
    pub materials: Vec<Material>,
    /// What materials show, each image with its sampler and encoding once.
    pub textures: Vec<Texture>,
    /// The images of the textures, in file order.
    pub images: Vec<Arc<Image>>,
    /// The pieces of all lights in scene order, those of one light together.
    pub targets: Vec<Target>,
    /// The lights in scene order.
    pub lights: Vec<Light>,
    /// Perspective cameras in scene order.
    pub cameras: Vec<Camera>,
    /// Named receivers in scene order.
    pub receivers: Vec<Receiver>,
    /// What was read otherwise than the file means it: one line each.
    pub warnings: Vec<String>,
    /// Names of nodes that hold nothing but are named like lights: what an exporter leaves of an area light.
    pub lost_lights: Vec<String>,
    /// Number of point, spot and directional lights, which are ignored.
    pub punctual_lights: usize,
}

impl Scene {
    /// Reads a `.gltf` (buffers and images in data URIs or files beside it) or `.glb` file.
    ///
    /// # Errors
    /// When the file cannot be read, is not glTF 2.0, breaks its rules where that matters here, or needs what is not
    /// read (compressed meshes, emission by images other than PNG and JPEG, unknown required extensions). A scene without a light is no error:
    /// see [`Scene::require_emitters`].
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        load::from_file(path).map_err(|problem| SceneError::at(path, problem))
    }

    /// Reads glTF from `bytes`, text or binary, as if it were the file `path`: messages carry that name, and
    /// buffer and image files are looked for beside it.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn from_bytes(bytes: &[u8], path: &Path) -> Result<Self, SceneError> {
        load::from_bytes(bytes, path).map_err(|problem| SceneError::at(path, problem))
    }
}
