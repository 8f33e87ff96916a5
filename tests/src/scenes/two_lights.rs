//! Two lights that have little in common, and a card.

use glam::{DVec3, Vec3};

use super::answer::answer;
use super::part::{floor, parallelogram};
use super::receiver::{UP, toward};
use super::{Camera, Material, Part, Receiver, Scene};

const GREY: Material = Material::diffuse([0.5; 3]);
const LAMP: Material = Material::emitting([20.0, 14.0, 8.0]);
const PANEL: Material = Material::emitting([0.5, 0.75, 1.0]).double_sided();

/// A small warm lamp at y = 2 facing down, a large cool panel standing at x = -1 that emits from both
/// sides, and a card at y = 1 whose edge lies below the middle of the lamp.
fn parts() -> Vec<Part> {
    let lamp = parallelogram(Vec3::new(0.625, 2.0, -0.125), Vec3::X * 0.25, Vec3::Z * 0.25);
    let panel = parallelogram(Vec3::new(-1.0, 0.5, -1.0), Vec3::Y, Vec3::Z * 2.0);
    let card = parallelogram(Vec3::new(0.0, 1.0, -0.5), Vec3::Z * 0.75, Vec3::X * 0.75);
    vec![
        Part::new("floor", GREY, vec![floor([-4.0, -4.0], [4.0, 5.0])]),
        Part::new("card", GREY, vec![card]),
        Part::new("lamp", LAMP, vec![lamp]),
        Part::new("panel", PANEL, vec![panel]),
    ]
}

/// The scene.
pub fn scene() -> Scene {
    Scene {
        name: "two-lights".to_string(),
        description: "A small bright warm lamp and a large dim cool panel that emits from both sides, above a floor, with a card in between.".to_string(),
        parts: parts(),
        camera: Camera::look_at(DVec3::new(1.5, 2.0, 6.0), DVec3::new(-0.25, 0.9, 0.0), 0.7),
        receivers: vec![
            Receiver::new("both", [1.5, 0.0, 1.0], UP),
            Receiver::new("half-hidden", [0.75, 0.0, 0.0], UP)
                .note("The card hides exactly half of the lamp."),
            Receiver::new("card-shadow", [0.25, 0.0, -0.125], UP)
                .note("The card hides all of the lamp."),
            Receiver::new("behind-panel", [-2.0, 0.0, 0.5], UP)
                .note("The panel hides the lamp and emits from its back."),
            Receiver::new("beside-panel", [-0.75, 0.0, 0.25], UP)
                .note("Close to the panel's plane."),
            Receiver::new("tilted", [-0.5, 0.25, 0.25], toward(DVec3::new(-1.0, 0.5, 0.25)))
                .note("In mid-air; its horizon passes between the lights."),
        ],
        method: answer,
    }
}
