//! What things are made of: glTF 2.0 to surfaces, lights, cameras and named receivers.
//!
//! [`Scene::load`] is the way in. What it reads, warns about and refuses:
//!
//! - **Read**: triangles of every mode, indexed or not; node transforms; meshes used by several nodes and
//!   `EXT_mesh_gpu_instancing`; `KHR_mesh_quantization`; sparse accessors; `KHR_materials_emissive_strength`; factors of
//!   `KHR_materials_specular` (where a file has none of it, a dielectric of roughness 1 is Lambertian); textures of
//!   base colour, metallic and roughness, and emission, from PNG and JPEG, with all wraps, any set of coordinates and
//!   `KHR_texture_transform`; vertex colours; alpha modes. Textures are looked up at points, nearest or bilinearly as
//!   `magFilter` says: there are no reduced images. What a surface is at a point is [`Scene::appearance_at`], what leaves
//!   a target [`Scene::target_emission`], what light passes [`Scene::veil`].
//! - **Read otherwise, with a line in [`Scene::warnings`]**: unlit materials (black), mirrors (a little rough), emitters that are
//!   blended (opaque), textures that cannot be used, normal and occlusion textures, punctual lights, points and lines, skins,
//!   morph targets and animations.
//! - **Refused, with a [`SceneError`]**: whatever would make a light or a surface other than the file means it: broken
//!   buffers and indices, NaN, compressed meshes, broken textures on emitters, unknown required extensions.

mod accessor;
mod allowances;
mod appearance;
mod assembly;
mod attributes;
mod buffer;
mod camera;
mod coincident;
mod container;
mod decode;
mod document;
mod emission;
mod error;
mod extensions;
mod footprint;
mod glow;
mod hierarchy;
mod image;
mod instances;
mod light;
mod limit;
mod load;
mod lookup;
mod lost;
mod mapping;
mod material;
mod nodes;
mod numbers;
mod pairing;
mod primitive;
mod receiver;
mod sampler;
mod scene;
mod surface;
mod texture;
mod textures;
mod transform;
mod veil;
mod view;
mod warnings;

pub use appearance::{Appearance, SMOOTHEST};
pub use attributes::Attributes;
pub use camera::Camera;
pub use emission::{Emission, Pattern};
pub use error::{Problem, SceneError};
pub use image::{Encoding, Image};
pub use light::Light;
pub use mapping::Mapping;
pub use material::{Alpha, Material};
pub use receiver::{KnownAnswer, Receiver};
pub use sampler::{Filter, Sampler, Wrap};
pub use scene::Scene;
pub use surface::Surface;
pub use texture::Texture;
