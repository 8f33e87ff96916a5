//! The project's scenes: their geometry, their receivers, and the answers known without chance.
//!
//! The files in `scenes/` are written from here by the `write-scenes` program, and a test holds
//! the two to the same bytes. Lengths are metres, Y is up, radiance is in an arbitrary unit.

mod answer;
mod camera;
mod cornell;
mod cubature;
mod four_colours;
mod furnace;
mod gltf;
mod json;
mod lamp_and_ceiling;
mod material;
mod moments;
mod nori;
mod part;
mod receiver;
#[cfg(test)]
mod reference;
mod sight;
mod square_light;
mod tiny_far_light;
mod two_lights;
mod view;

pub use answer::Answer;
pub use camera::Camera;
pub use material::Material;
pub use part::Part;
pub use receiver::Receiver;

/// One scene: what stands in it, from where it is looked at, and where irradiance is asked for.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The file's name without `.gltf`.
    pub name: String,
    /// One sentence or two, stored in the file.
    pub description: String,
    /// The surfaces; each that emits is one light.
    pub parts: Vec<Part>,
    /// The view from which the scene is rendered.
    pub camera: Camera,
    /// The points at which irradiance is known.
    pub receivers: Vec<Receiver>,
    /// How the answer at a receiver is found.
    pub method: fn(&[Part], &Receiver) -> Answer,
}

impl Scene {
    /// The name of the scene's file.
    pub fn file_name(&self) -> String {
        format!("{}.gltf", self.name)
    }

    /// The whole text of the scene's glTF file, ending in a newline.
    pub fn to_gltf(&self) -> String {
        json::pretty(&gltf::document(self))
    }

    /// The receivers, each with its known answer.
    pub fn answers(&self) -> impl Iterator<Item = (&Receiver, Answer)> {
        let answer = |receiver| (receiver, (self.method)(&self.parts, receiver));
        self.receivers.iter().map(answer)
    }

    /// How many triangles the scene holds.
    pub fn triangle_count(&self) -> usize {
        self.parts.iter().map(|part| part.triangles().count()).sum()
    }
}

/// Every scene of the project, in the order of `scenes/README.md`.
pub fn all() -> Vec<Scene> {
    let mut scenes = vec![cornell::with_blocks(), cornell::empty(), square_light::scene()];
    scenes.extend(nori::scenes());
    scenes.extend([two_lights::scene(), lamp_and_ceiling::scene()]);
    scenes.extend([furnace::scene(), tiny_far_light::scene(), four_colours::scene()]);
    scenes
}
