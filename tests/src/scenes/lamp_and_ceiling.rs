//! Two lights, one almost as wide as the sky.

use glam::{DVec3, Vec3};

use super::answer::answer;
use super::part::{floor, parallelogram};
use super::receiver::UP;
use super::{Camera, Material, Part, Receiver, Scene};

const GREY: Material = Material::diffuse([0.5; 3]);
const LAMP: Material = Material::emitting([8.0, 6.0, 4.0]);
const CEILING: Material = Material::emitting([0.375, 0.5, 0.625]);

/// A ceiling of 8 × 8 m at y = 1 that glows, and a lamp that hangs below it at y = 0.75; both face down.
fn parts() -> Vec<Part> {
    let lamp = parallelogram(Vec3::new(1.8125, 0.75, -0.1875), Vec3::X * 0.375, Vec3::Z * 0.375);
    let ceiling = parallelogram(Vec3::new(-4.0, 1.0, -4.0), Vec3::X * 8.0, Vec3::Z * 8.0);
    vec![
        Part::new("floor", GREY, vec![floor([-4.0, -4.0], [4.0, 4.0])]),
        Part::new("lamp", LAMP, vec![lamp]),
        Part::new("ceiling", CEILING, vec![ceiling]),
    ]
}

/// The scene.
pub fn scene() -> Scene {
    Scene {
        name: "lamp-and-ceiling".to_string(),
        description:
            "A ceiling that glows, eight metres wide and one above the floor, and a small bright lamp below it."
                .to_string(),
        parts: parts(),
        camera: Camera::look_at(DVec3::new(0.0, 0.5, 3.75), DVec3::new(0.0, 0.25, 0.0), 0.8),
        receivers: vec![
            Receiver::new("below", [2.125, 0.0, 0.25], UP).note("The ceiling fills most of the sky."),
            Receiver::new("aside", [1.0, 0.0, -0.5], UP).note("The lamp is seen at an angle."),
            Receiver::new("edge", [3.875, 0.0, 0.25], UP).note("The ceiling fills half of the sky."),
        ],
        method: answer,
    }
}
