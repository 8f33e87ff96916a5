//! A square that emits by a texture of four texels, a small light of one radiance, and a card between.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use super::part::{floor, parallelogram};
use super::receiver::{UP, toward};
use super::view::{View, rgb};
use super::{Answer, Camera, Material, Part, Receiver, Scene};

const GREY: Material = Material::diffuse([0.5; 3]);

/// Red, green, blue and white.
const TEXELS: [[u8; 3]; 4] = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3]];

fn parts() -> Vec<Part> {
    let square = parallelogram(Vec3::new(-1.0, 2.0, -1.0), Vec3::X * 2.0, Vec3::Z * 2.0);
    let lamp = parallelogram(Vec3::new(-2.0, 1.5, 0.5), Vec3::X * 0.25, Vec3::Z * 0.25);
    let card = parallelogram(Vec3::new(0.25, 1.0, -0.5), Vec3::Z * 1.25, Vec3::X * 0.75);
    vec![
        Part::new("floor", GREY, vec![floor([-4.0, -4.0], [4.0, 5.0])]),
        Part::new("card", GREY, vec![card]),
        Part::new("square", Material::emitting([2.0, 1.0, 4.0]), vec![square]).with_pattern(TEXELS),
        Part::new("lamp", Material::emitting([8.0; 3]), vec![lamp]),
    ]
}

/// Each texel of the square is a light of one radiance, and irradiance is the sum over them. A point drawn over the whole
/// square is drawn on one of them by its share of the area.
fn answer(parts: &[Part], receiver: &Receiver) -> Answer {
    let texels: Vec<Part> = parts.iter().flat_map(Part::texels).collect();
    let view = View::new(&texels, receiver);
    let lights: Vec<&Part> = texels.iter().filter(|part| part.material.emits()).collect();
    let power = |part: &Part| part.area() * part.material.luminance() * part.sides();
    let whole = |of: &dyn Fn(&Part) -> f64| lights.iter().map(|light| of(light)).sum::<f64>();
    let of_light = |light: &Part, of: &dyn Fn(&Part) -> f64| -> f64 {
        lights.iter().filter(|other| other.name == light.name).map(|other| of(other)).sum()
    };
    let share = |light: &Part| light.area() / of_light(light, &Part::area);
    let by_area = view.over_lights(|light| light.area() / whole(&Part::area));
    Answer {
        irradiance: rgb(|c| view.irradiance(c)),
        variance: vec![
            ("hemisphere/uniform", rgb(|c| view.over_directions(c, |of| 2.0 * PI * of.m20))),
            ("hemisphere/cosine", rgb(|c| view.over_directions(c, |of| PI * of.m10))),
            ("hemisphere/toward-lights", by_area),
            ("area/uniform", by_area),
            ("area/uniform@uniform", view.over_lights(|light| 0.5 * share(light))),
            ("area/uniform@power", view.over_lights(|light| share(light) * of_light(light, &power) / whole(&power))),
            ("area/luminance", view.over_lights(|light| power(light) / whole(&power))),
        ],
        derivation: format!("The four texels as four lights: {}", view.derivation()),
    }
}

/// The scene.
pub fn scene() -> Scene {
    Scene {
        name: "four-colours".to_string(),
        description: "A square light of side 2, two metres above a floor, that emits by a texture of two by two texels: red, green, blue and white; a small light of one radiance beside it, and a card half way.".to_string(),
        parts: parts(),
        camera: Camera::look_at(DVec3::new(-3.0, 2.5, 6.0), DVec3::new(0.0, 1.0, 0.0), 0.7),
        receivers: vec![
            Receiver::new("near", [0.125, 1.5, 0.25], UP).note("In mid-air, near where the texels meet."),
            Receiver::new("below", [0.0, 0.0, 0.0], UP),
            Receiver::new("penumbra", [0.25, 0.0, 0.25], UP),
            Receiver::new("aside", [-3.0, 0.0, 1.0], UP),
            Receiver::new("tilted", [1.5, 1.0, 0.5], toward(DVec3::new(-1.0, 0.25, -0.125)))
                .note("In mid-air; its horizon cuts the square."),
        ],
        method: answer,
    }
}
