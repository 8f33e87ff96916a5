//! A light that is nearly a point: the hemisphere hardly ever finds it.

use glam::{DVec3, Vec3};

use super::answer::answer;
use super::part::{floor, parallelogram};
use super::receiver::{UP, toward};
use super::{Camera, Material, Part, Receiver, Scene};

/// The scene.
pub fn scene() -> Scene {
    let light = parallelogram(Vec3::new(-0.005, 10.0, -0.005), Vec3::X * 0.01, Vec3::Z * 0.01);
    Scene {
        name: "tiny-far-light".to_string(),
        description: "A square light of side 1 cm and radiance 10000, ten metres above a floor.".to_string(),
        parts: vec![
            Part::new("floor", Material::diffuse([0.5; 3]), vec![floor([-4.0, -4.0], [4.0, 5.0])]),
            Part::new("light", Material::emitting([1e4; 3]), vec![light]),
        ],
        camera: Camera::look_at(DVec3::new(0.0, 3.0, 8.0), DVec3::new(0.0, 0.0, 0.0), 0.8),
        receivers: vec![
            Receiver::new("below", [0.0, 0.0, 0.0], UP).note("L A / h^2 to leading order, A = area, h = height."),
            Receiver::new("aside", [3.0, 0.0, -2.0], UP),
            Receiver::new("tilted", [1.0, 1.0, 1.0], toward(DVec3::new(1.0, 0.5, 0.25)))
                .note("In mid-air, the light near its horizon."),
        ],
        method: answer,
    }
}
