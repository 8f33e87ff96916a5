//! The Cornell box from its measured data (Cornell University Program of Computer Graphics,
//! "Cornell Box Data"), in metres, with the hole that the light leaves in the ceiling.

use glam::{DQuat, DVec3, Vec3};

use super::answer::answer;
use super::receiver::{DOWN, MINUS_Z, PLUS_X, UP, toward};
use super::{Camera, Material, Part, Receiver, Scene};

const WHITE: Material = Material::diffuse([0.73, 0.73, 0.73]);
const RED: Material = Material::diffuse([0.65, 0.05, 0.05]);
const GREEN: Material = Material::diffuse([0.12, 0.45, 0.15]);
const LIGHT: Material = Material::emitting([17.0, 12.0, 4.0]);

/// Height of the ceiling in millimetres.
const H: f64 = 548.8;

/// A quadrilateral given in millimetres.
type Quad = [[f64; 3]; 4];

const FLOOR: Quad = [[552.8, 0., 0.], [0., 0., 0.], [0., 0., 559.2], [549.6, 0., 559.2]];
const BACK: Quad = [[549.6, 0., 559.2], [0., 0., 559.2], [0., H, 559.2], [556., H, 559.2]];
const RIGHT: Quad = [[0., 0., 559.2], [0., 0., 0.], [0., H, 0.], [0., H, 559.2]];
const LEFT: Quad = [[552.8, 0., 0.], [549.6, 0., 559.2], [556., H, 559.2], [556., H, 0.]];
const LAMP: Quad = [[343., H, 227.], [343., H, 332.], [213., H, 332.], [213., H, 227.]];

const SHORT_BLOCK: [Quad; 5] = [
    [[130., 165., 65.], [82., 165., 225.], [240., 165., 272.], [290., 165., 114.]],
    [[290., 0., 114.], [290., 165., 114.], [240., 165., 272.], [240., 0., 272.]],
    [[130., 0., 65.], [130., 165., 65.], [290., 165., 114.], [290., 0., 114.]],
    [[82., 0., 225.], [82., 165., 225.], [130., 165., 65.], [130., 0., 65.]],
    [[240., 0., 272.], [240., 165., 272.], [82., 165., 225.], [82., 0., 225.]],
];

const TALL_BLOCK: [Quad; 5] = [
    [[423., 330., 247.], [265., 330., 296.], [314., 330., 456.], [472., 330., 406.]],
    [[423., 0., 247.], [423., 330., 247.], [472., 330., 406.], [472., 0., 406.]],
    [[472., 0., 406.], [472., 330., 406.], [314., 330., 456.], [314., 0., 456.]],
    [[314., 0., 456.], [314., 330., 456.], [265., 330., 296.], [265., 0., 296.]],
    [[265., 0., 296.], [265., 330., 296.], [423., 330., 247.], [423., 0., 247.]],
];

/// Millimetres to metres, once rounded to binary32.
fn metres(point: [f64; 3]) -> Vec3 {
    point.map(|v| (v * 1e-3) as f32).into()
}

fn part(name: &'static str, material: Material, quads: &[Quad]) -> Part {
    Part::new(name, material, quads.iter().map(|quad| quad.map(metres).to_vec()).collect())
}

/// The ceiling, 556 × 559.2, around the light: four rectangles that face down.
fn ceiling() -> Part {
    let rectangle = |x0, x1, z0, z1| [[x1, H, z0], [x1, H, z1], [x0, H, z1], [x0, H, z0]];
    let quads = [
        rectangle(0., 556., 0., 227.),
        rectangle(0., 556., 332., 559.2),
        rectangle(0., 213., 227., 332.),
        rectangle(343., 556., 227., 332.),
    ];
    part("ceiling", WHITE, &quads)
}

fn room() -> Vec<Part> {
    vec![
        part("floor", WHITE, &[FLOOR]),
        ceiling(),
        part("back-wall", WHITE, &[BACK]),
        part("right-wall", GREEN, &[RIGHT]),
        part("left-wall", RED, &[LEFT]),
        part("light", LIGHT, &[LAMP]),
    ]
}

/// At (278, 273, -800) mm, looking along +Z; 25 mm of film behind a lens of 35 mm.
fn camera() -> Camera {
    Camera {
        eye: DVec3::new(0.278, 0.273, -0.8),
        rotation: DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0),
        yfov: 2.0 * libm::atan(12.5 / 35.0),
        aspect_ratio: 1.0,
    }
}

fn at(name: &'static str, millimetres: [f64; 3], rotation: glam::Quat) -> Receiver {
    Receiver::new(name, metres(millimetres).to_array(), rotation)
}

fn back_wall() -> Receiver {
    at("on-back-wall", [150., 200., 559.2], MINUS_Z)
}

fn right_wall() -> Receiver {
    at("on-right-wall", [0., 300., 250.], PLUS_X)
}

/// On the upper triangle of the red wall, which is neither upright nor quite flat.
fn left_wall() -> Receiver {
    let [a, b, c] = [LEFT[0], LEFT[2], LEFT[3]].map(|v| metres(v).as_dvec3());
    let normal = (b - a).cross(c - a);
    let position = nearby_on_plane(a, normal, metres([555.0, 380.0, 170.0]));
    Receiver::new("on-left-wall", position.to_array(), toward(normal))
}

/// The first point above `start`, by binary32 steps of y, that lies within 10⁻¹⁰ m of the plane
/// along x when its x is rounded to binary32.
fn nearby_on_plane(a: DVec3, normal: DVec3, start: Vec3) -> Vec3 {
    let x = |y: f32| a.x - (normal.y * (f64::from(y) - a.y) + normal.z * (f64::from(start.z) - a.z)) / normal.x;
    let mut y = start.y;
    while (x(y) - f64::from(x(y) as f32)).abs() > 1e-10 {
        y = y.next_up();
    }
    Vec3::new(x(y) as f32, y, start.z)
}

/// The box with its two blocks and nine receivers.
pub fn with_blocks() -> Scene {
    let mut parts = room();
    parts.insert(5, part("short-block", WHITE, &SHORT_BLOCK));
    parts.insert(6, part("tall-block", WHITE, &TALL_BLOCK));
    Scene {
        name: "cornell-box".to_string(),
        description: "The Cornell box with its two blocks, from the measured data, in metres. The ceiling has a hole where the light is, so the two never coincide.".to_string(),
        parts,
        camera: camera(),
        receivers: vec![
            at("floor-lit", [460., 0., 100.], UP),
            at("floor-penumbra", [250., 0., 30.], UP),
            at("behind-tall-block", [350., 0., 524.], UP),
            at("between-blocks", [268., 0., 280.], UP),
            at("on-short-block", [186., 165., 168.], UP),
            at("on-tall-block", [368., 330., 340.], UP),
            back_wall(),
            left_wall(),
            right_wall(),
        ],
        method: answer,
    }
}

/// The box without blocks.
pub fn empty() -> Scene {
    Scene {
        name: "cornell-box-empty".to_string(),
        description: "The Cornell box without its blocks: no receiver is in shadow.".to_string(),
        parts: room(),
        camera: camera(),
        receivers: vec![
            at("floor-centre", [278., 0., 270.], UP),
            at("floor-corner", [20., 0., 540.], UP),
            back_wall(),
            left_wall(),
            right_wall(),
            at("on-ceiling", [100., H, 100.], DOWN).note("In the plane of the light."),
        ],
        method: answer,
    }
}
