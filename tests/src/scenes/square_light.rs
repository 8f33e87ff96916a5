//! One unit square above a floor, with a card that hides half of it from one point.

use glam::{DVec3, Vec3};

use super::answer::answer;
use super::part::{floor, parallelogram};
use super::receiver::{UP, toward};
use super::{Camera, Material, Part, Receiver, Scene};

const GREY: Material = Material::diffuse([0.5; 3]);

/// The square at y = 2, facing down; the card at y = 1 covers 0 < x < 2.
fn parts() -> Vec<Part> {
    let light = parallelogram(Vec3::new(-0.5, 2.0, -0.5), Vec3::X, Vec3::Z);
    let card = parallelogram(Vec3::new(0.0, 1.0, -1.0), Vec3::Z * 2.0, Vec3::X * 2.0);
    vec![
        Part::new("floor", GREY, vec![floor([-4.0, -4.0], [4.0, 5.0])]),
        Part::new("card", GREY, vec![card]),
        Part::new("light", Material::emitting([1.0; 3]), vec![light]),
    ]
}

/// The scene.
pub fn scene() -> Scene {
    Scene {
        name: "square-light".to_string(),
        description: "A square light of side 1 and radiance 1, two metres above a floor, and a card half way that hides half of it from the point below its centre.".to_string(),
        parts: parts(),
        camera: Camera::look_at(DVec3::new(-2.5, 2.0, 6.0), DVec3::new(0.0, 0.8, 0.0), 0.7),
        receivers: vec![
            Receiver::new("near", [0.0, 1.9, 0.0], UP)
                .note("In mid-air, a tenth of the side below the centre."),
            Receiver::new("half-side-below", [0.0, 1.5, 0.0], UP)
                .note("In mid-air, half a side below the centre."),
            Receiver::new("on-card", [0.25, 1.0, 0.125], UP),
            Receiver::new("half-hidden", [0.0, 0.0, 0.0], UP)
                .note("By symmetry half of what the whole square would give."),
            Receiver::new("penumbra", [0.25, 0.0, 0.125], UP),
            Receiver::new("umbra", [0.875, 0.0, 0.125], UP),
            Receiver::new("far", [-3.0, 0.0, 1.0], UP),
            Receiver::new("tilted", [-1.0, 1.25, 0.5], toward(DVec3::new(1.0, 0.0, -0.25)))
                .note("In mid-air; its horizon passes below the light."),
            Receiver::new("horizon", [0.25, 1.5, 0.25], toward(DVec3::new(1.0, 0.125, 0.0)))
                .note("In mid-air; its horizon cuts the light."),
        ],
        method: answer,
    }
}
