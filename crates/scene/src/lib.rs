//! What things are made of: glTF 2.0 to surfaces, lights, cameras and named receivers.
//!
//! [`Scene::load`] is the way in. What it reads, warns about and refuses:
//!
//! - **Read**: triangles of every mode, indexed or not; node transforms; meshes used by several nodes and
//!   `EXT_mesh_gpu_instancing`; `KHR_mesh_quantization`; sparse accessors; `KHR_materials_emissive_strength`.
//! - **Read otherwise, with a line in [`Scene::warnings`]**: textures, alpha, vertex colours, metals and unlit materials (black),
//!   punctual lights, points and lines, skins, morph targets and animations.
//! - **Refused, with a [`SceneError`]**: whatever would make a light or a surface other than the file means it: broken
//!   buffers and indices, NaN, compressed meshes, textures on emitters, unknown required extensions.

mod accessor;
mod allowances;
mod assembly;
mod buffer;
mod camera;
mod coincident;
mod container;
mod document;
mod error;
mod extensions;
mod hierarchy;
mod instances;
mod light;
mod limit;
mod load;
mod lookup;
mod lost;
mod material;
mod nodes;
mod numbers;
mod pairing;
mod primitive;
mod receiver;
mod scene;
mod surface;
mod transform;
mod view;
mod warnings;

pub use camera::Camera;
pub use error::{Problem, SceneError};
pub use light::Light;
pub use material::Material;
pub use receiver::{KnownAnswer, Receiver};
pub use scene::Scene;
pub use surface::Surface;
