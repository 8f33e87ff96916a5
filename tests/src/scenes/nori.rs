//! The five triangle lights of the renderer nori (`scenes/pa5/tests/test-direct.xml`).

use glam::{DVec3, Vec3};

use super::answer::answer;
use super::part::floor;
use super::receiver::UP;
use super::{Camera, Material, Part, Receiver, Scene};

/// Corners of each light.
const LIGHTS: [[[f32; 3]; 3]; 5] = [
    [[-0.443_432, 0.596_366, 0.495_985], [-0.320_397, 0.067_769_9, -0.229_359], [0.034_119_7, 0.114_15, -0.343_049]],
    [[0.461_963, 0.397_843, 0.412_747], [-0.038_158_2, 0.851_323, -0.156_872], [0.195_443, 0.891_957, -0.260_672]],
    [[0.100_871, 0.289_075, -0.422_609], [-0.308_386, 0.629_587, 0.423_966], [-0.373_132, 0.237_287, 0.351_592]],
    [[-0.175_75, 0.639_397, 0.151_268], [0.318_604, 0.732_996, 0.459_771], [0.139_095, 0.294_498, 0.478_556]],
    [[-0.174_87, 0.447_916, 0.367_201], [-0.405_259, 0.249_607, -0.354_079], [0.356_029, 0.091_898_4, -0.132_271]],
];

/// The radiance that nori's file states for each, ρ E / π with ρ = 1/2.
const STATED: [&str; 5] = [
    "nori states rho E / pi = 0.0898394 for rho = 1/2.",
    "nori states rho E / pi = 0.02292 for rho = 1/2.",
    "nori states rho E / pi = 0.0534198 for rho = 1/2 (its vertices are rounded, which moves the sixth digit).",
    "nori states rho E / pi = 0.0205314 for rho = 1/2.",
    "nori states rho E / pi = 0.26174 for rho = 1/2.",
];

/// The corners in the order that turns the front toward the origin.
fn facing_origin(corners: [[f32; 3]; 3]) -> Vec<Vec3> {
    let [a, b, c] = corners.map(Vec3::from);
    let (from_a, from_b, from_c) = (a.as_dvec3(), b.as_dvec3(), c.as_dvec3());
    let faces_away = (from_b - from_a).cross(from_c - from_a).dot(from_a) > 0.0;
    if faces_away { vec![a, c, b] } else { vec![a, b, c] }
}

fn scene(number: usize) -> Scene {
    let corners = LIGHTS[number - 1];
    let light = facing_origin(corners);
    Scene {
        name: format!("nori-light-{number}"),
        description: format!(
            "Triangle light {number} of 5 from nori's test of direct light: radiance 1 above a floor of albedo 1/2, seen from the origin."
        ),
        parts: vec![
            Part::new("floor", Material::diffuse([0.5; 3]), vec![floor([-2.0, -2.0], [2.0, 3.0])]),
            Part::new("light", Material::emitting([1.0; 3]), vec![light]),
        ],
        camera: Camera::look_at(DVec3::new(0.0, 1.2, 3.0), DVec3::new(0.0, 0.3, 0.0), 0.6),
        receivers: vec![Receiver::new("origin", [0.0; 3], UP).note(STATED[number - 1])],
        method: answer,
    }
}

/// The five scenes, one light each.
pub fn scenes() -> impl Iterator<Item = Scene> {
    (1..=LIGHTS.len()).map(scene)
}
