//! Scenes that a test builds: written as glTF, changed there if need be, and read like any other.

use std::path::Path;

use glam::{Quat, Vec3};
use serde_json::Value;
use twoforms_comparison::image::{Crop, Pixel, PixelFilter, Rendering, Shown};
use twoforms_comparison::place::Place;
use twoforms_comparison::world::World;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::Kind;

use crate::scenes::{Answer, Camera, Material, Part, Receiver, Scene};

/// The world of these parts and receivers, after `change` was made to the document. Its mesh nodes come first, in the
/// order of the parts, then the receivers, and a camera.
///
/// # Panics
/// When it can't be read.
pub fn world(parts: &[Part], receivers: &[Receiver], change: impl FnOnce(&mut Value)) -> World {
    let scene = Scene {
        name: "built".into(),
        description: String::new(),
        parts: parts.to_vec(),
        camera: Camera::look_at(glam::DVec3::new(0.0, 1.0, 3.0), glam::DVec3::ZERO, 0.8),
        receivers: receivers.to_vec(),
        method: |_, _| Answer { irradiance: [0.0; 3], variance: Vec::new(), derivation: String::new() },
    };
    let mut document: Value = scene.to_gltf().parse().expect("a document");
    change(&mut document);
    let scene = twoforms_scene::Scene::from_bytes(document.to_string().as_bytes(), Path::new("built.gltf"));
    World::new(scene.expect("a scene that can be read")).expect("a scene with lights")
}

/// The receivers of a world.
pub fn places(world: &World) -> Vec<Place> {
    world.scene.receivers.iter().map(Place::of_receiver).collect()
}

/// A small image by the scene's camera and `area/uniform`.
///
/// # Panics
/// When a sample is not finite.
pub fn image(world: &World, quantity: Shown, filter: PixelFilter, seed: u64) -> Vec<Pixel> {
    let (width, height) = (32, 32);
    let rendering = Rendering {
        strategy: Strategy::from(Kind::AreaUniform),
        sampler: Sampler::Independent,
        width,
        height,
        crop: Crop { x0: 0, x1: width, y0: 0, y1: height },
        spp: 4,
        light_samples: 4,
        filter,
        cull: false,
        quantity,
        seed,
    };
    rendering.run(world, &world.scene.cameras[0], &|_| ()).expect("finite samples")
}

/// An upright box turned about the vertical through `centre`, which lies on its floor.
pub fn block(name: &'static str, centre: Vec3, size: Vec3, turn: f32) -> Part {
    let rotation = Quat::from_rotation_y(turn);
    let corner = |x: f32, y: f32, z: f32| centre + rotation * (size * Vec3::new(x - 0.5, y, z - 0.5));
    let side = |corners: [[f32; 3]; 4]| corners.map(|[x, y, z]| corner(x, y, z)).to_vec();
    let sides = vec![
        side([[0., 0., 0.], [1., 0., 0.], [1., 0., 1.], [0., 0., 1.]]),
        side([[0., 1., 0.], [0., 1., 1.], [1., 1., 1.], [1., 1., 0.]]),
        side([[0., 0., 0.], [0., 0., 1.], [0., 1., 1.], [0., 1., 0.]]),
        side([[1., 0., 0.], [1., 1., 0.], [1., 1., 1.], [1., 0., 1.]]),
        side([[0., 0., 0.], [0., 1., 0.], [1., 1., 0.], [1., 0., 0.]]),
        side([[0., 0., 1.], [1., 0., 1.], [1., 1., 1.], [0., 1., 1.]]),
    ];
    Part::new(name, Material::diffuse([0.5; 3]), sides)
}

/// A level rectangle at height y that faces down, its corners (x, z).
pub fn ceiling(y: f32, [x0, z0]: [f32; 2], [x1, z1]: [f32; 2]) -> Vec<Vec3> {
    vec![Vec3::new(x0, y, z0), Vec3::new(x1, y, z0), Vec3::new(x1, y, z1), Vec3::new(x0, y, z1)]
}
