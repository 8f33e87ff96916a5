//! A closed box that emits inward from everywhere: irradiance is π wherever one looks.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use super::part::parallelogram;
use super::receiver::{MINUS_X, UP, toward};
use super::{Answer, Camera, Material, Part, Receiver, Scene};

const WALL: Material = Material { albedo: [0.5; 3], radiance: [1.0; 3], double_sided: false };

/// The six sides of an upright box, their fronts inside.
fn inside_of_box(low: Vec3, high: Vec3) -> Vec<Vec<Vec3>> {
    let size = high - low;
    let (x, y, z) = (Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z);
    vec![
        parallelogram(low, z, x),
        parallelogram(low, x, y),
        parallelogram(low, y, z),
        parallelogram(high, -x, -z),
        parallelogram(high, -y, -x),
        parallelogram(high, -z, -y),
    ]
}

/// Directions need no geometry here: `L_e` = 1 along each of them. Points on the walls do.
fn answer(parts: &[Part], receiver: &Receiver) -> Answer {
    let mut answer = super::answer::answer(parts, receiver);
    answer.irradiance = [PI; 3];
    for (strategy, variance) in &mut answer.variance {
        match *strategy {
            "hemisphere/uniform" => *variance = [PI * PI / 3.0; 3],
            "hemisphere/cosine" => *variance = [0.0; 3],
            _ => {}
        }
    }
    answer.derivation = DERIVATION.to_string();
    answer
}

const DERIVATION: &str = "L = 1 from every direction, so E = integral of cos(theta) over the hemisphere = pi. hemisphere/cosine: every sample is pi, variance 0. hemisphere/uniform: E[w^2] = 2 pi integral of cos^2(theta) = 4 pi^2 / 3, variance pi^2 / 3. On the walls: A sum M23 / s^2 - pi^2, where A = the walls' area, M23 = integral of cos^2(theta_x) cos^3(theta_y) over a triangle's solid angle (Arvo 1995), s = distance to its plane.";

/// The scene.
pub fn scene() -> Scene {
    let walls = inside_of_box(Vec3::new(-1.0, 0.0, -0.75), Vec3::new(1.0, 1.0, 0.75));
    Scene {
        name: "furnace".to_string(),
        description: "A closed box of 2 x 1 x 1.5 m whose walls emit radiance 1 inward everywhere: no ray may get out, and irradiance is pi at every point and tilt.".to_string(),
        parts: vec![Part::new("walls", WALL, walls)],
        camera: Camera::look_at(DVec3::new(-0.9, 0.6, -0.6), DVec3::new(0.5, 0.4, 0.5), 1.2),
        receivers: vec![
            Receiver::new("floor", [0.25, 0.0, 0.125], UP),
            Receiver::new("wall", [1.0, 0.5, 0.25], MINUS_X),
            Receiver::new("floor-near-corner", [0.875, 0.0, 0.625], UP),
            Receiver::new("centre", [0.0, 0.5, 0.0], UP).note("In mid-air."),
            Receiver::new("tilted", [-0.5, 0.25, 0.25], toward(DVec3::new(0.5, 0.75, -0.25)))
                .note("In mid-air."),
        ],
        method: answer,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edge_sums_over_the_walls_find_the_furnace() {
        let scene = scene();
        for receiver in &scene.receivers {
            let general = super::super::answer::answer(&scene.parts, receiver);
            assert!((general.irradiance[0] - PI).abs() < 1e-13, "{}", receiver.name);
            for (strategy, expected) in [("hemisphere/uniform", PI * PI / 3.0), ("hemisphere/cosine", 0.0)] {
                let [variance, ..] = general.variance(strategy).expect("a listed strategy");
                assert!((variance - expected).abs() < 1e-12, "{} {strategy}", receiver.name);
            }
        }
    }
}
