//! A scene of any size: hills under one square light, as a binary glTF file.
//!
//! The ground is a height field over a square of 16 × 16 m, cut into n × n cells of two triangles each; its shape does not
//! depend on n. The light, 2 m wide, hangs 5 m up, off the middle. The receivers are vertices of the ground: `receiver-open`
//! on a summit, from which nothing hides the light, and `receiver-hidden` behind a ridge that hides part of it (of coarse
//! ground, as much as there is of a ridge).

use glam::{DVec3, Vec3};
use serde_json::{Value, json};

use crate::scenes::Camera;

/// Half the side of the ground in metres.
const HALF: f64 = 8.0;
/// Component types of accessors, as glTF numbers them.
const U32: u32 = 5125;
const F32: u32 = 5126;
const U16: u32 = 5123;

/// The light's corners, in the order in which their front looks down.
const LIGHT: [[f32; 3]; 4] = [[3.0, 5.0, -1.0], [5.0, 5.0, -1.0], [5.0, 5.0, 1.0], [3.0, 5.0, 1.0]];
const LIGHT_TRIANGLES: [u16; 6] = [0, 1, 2, 0, 2, 3];

/// Ground of n × n cells.
#[derive(Clone, Copy, Debug)]
pub struct Terrain {
    cells: u32,
}

impl Terrain {
    /// Ground of about so many triangles: twice the square of a whole number, at least 2.
    pub fn of(triangles: u32) -> Self {
        Self::of_cells((f64::from(triangles) / 2.0).sqrt().round().max(1.0) as u32)
    }

    /// Ground of so many cells along a side, at least 1.
    pub const fn of_cells(cells: u32) -> Self {
        Self { cells }
    }

    /// How many triangles the scene holds, the light's two included.
    pub fn triangle_count(self) -> u64 {
        2 * u64::from(self.cells).pow(2) + 2
    }

    /// The whole scene as the bytes of a `.glb` file.
    pub fn to_glb(self) -> Vec<u8> {
        let mut text = self.document().to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let binary = self.buffer();
        let length = 12 + 8 + text.len() + 8 + binary.len();
        let mut glb = Vec::with_capacity(length);
        glb.extend(*b"glTF");
        glb.extend([2, length as u32].map(u32::to_le_bytes).concat());
        for (kind, chunk) in [(b"JSON", text), (b"BIN\0", binary)] {
            glb.extend((chunk.len() as u32).to_le_bytes());
            glb.extend(kind);
            glb.extend(chunk);
        }
        glb
    }

    /// The vertex in row `z`, column `x` of the grid, rounded to binary32.
    fn vertex(self, x: u32, z: u32) -> Vec3 {
        let [x, z] = [x, z].map(|k| HALF * (2.0 * f64::from(k) / f64::from(self.cells) - 1.0));
        DVec3::new(x, height(x, z), z).as_vec3()
    }

    /// The vertex that lies nearest to a place of the plane.
    fn nearest(self, [x, z]: [f64; 2]) -> Vec3 {
        let [x, z] = [x, z].map(|c| ((c + HALF) / (2.0 * HALF) * f64::from(self.cells)).round() as u32);
        self.vertex(x, z)
    }

    /// All vertices of the ground, row by row.
    fn vertices(self) -> impl Iterator<Item = Vec3> {
        (0..=self.cells).flat_map(move |z| (0..=self.cells).map(move |x| self.vertex(x, z)))
    }

    /// The triangles of all cells, their fronts up.
    fn triangles(self) -> impl Iterator<Item = [u32; 3]> {
        let row = self.cells + 1;
        let corners = (0..self.cells).flat_map(move |z| (0..self.cells).map(move |x| z * row + x));
        corners.flat_map(move |a| [[a, a + row, a + 1], [a + 1, a + row, a + row + 1]])
    }

    /// Vertices of ground and light, then triangles of both.
    fn buffer(self) -> Vec<u8> {
        let vertices = self.vertices().map(|vertex| vertex.to_array()).chain(LIGHT);
        let mut bytes: Vec<u8> = vertices.flatten().flat_map(f32::to_le_bytes).collect();
        bytes.extend(self.triangles().flatten().flat_map(u32::to_le_bytes));
        bytes.extend(LIGHT_TRIANGLES.into_iter().flat_map(u16::to_le_bytes));
        bytes.resize(bytes.len().next_multiple_of(4), 0);
        bytes
    }

    fn document(self) -> Value {
        let (vertices, indices) = ((u64::from(self.cells) + 1).pow(2), 6 * u64::from(self.cells).pow(2));
        let (light_at, triangles_at) = (12 * vertices, 12 * (vertices + 4));
        let length = (triangles_at + 4 * indices + 12).next_multiple_of(4);
        let (low, high) = self.bounds();
        let accessor = |view: u32, at: u64, kind: u32, count: u64, shape: &str| json!({"bufferView": view, "byteOffset": at, "componentType": kind, "count": count, "type": shape});
        let mut accessors = [
            accessor(0, 0, F32, vertices, "VEC3"),
            accessor(1, 0, U32, indices, "SCALAR"),
            accessor(0, light_at, F32, 4, "VEC3"),
            accessor(1, 4 * indices, U16, 6, "SCALAR"),
        ];
        accessors[0]["min"] = json!(low.to_array());
        accessors[0]["max"] = json!(high.to_array());
        accessors[2]["min"] = json!(LIGHT[0]);
        accessors[2]["max"] = json!(LIGHT[2]);
        json!({
            "asset": {"version": "2.0", "generator": "twoforms write-terrain"},
            "extensionsUsed": ["KHR_materials_emissive_strength"],
            "scene": 0,
            "scenes": [{"name": "terrain", "nodes": [0, 1, 2, 3, 4]}],
            "nodes": self.nodes(),
            "cameras": [{"name": "camera", "type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.01}}],
            "meshes": [mesh("ground", 0), mesh("light", 1)],
            "materials": [
                {"name": "ground", "doubleSided": true, "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1.0], "metallicFactor": 0.0}},
                {"name": "light", "pbrMetallicRoughness": {"metallicFactor": 0.0}, "emissiveFactor": [1.0, 1.0, 1.0], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 16.0}}},
            ],
            "accessors": accessors,
            "bufferViews": [
                {"buffer": 0, "byteLength": triangles_at, "byteStride": 12},
                {"buffer": 0, "byteOffset": triangles_at, "byteLength": length - triangles_at},
            ],
            "buffers": [{"byteLength": length}],
        })
    }

    fn nodes(self) -> Value {
        let camera = Camera::look_at(DVec3::new(0.0, 9.0, 18.0), DVec3::ZERO, 0.8);
        let receiver = |name: &str, place| json!({"name": name, "translation": self.nearest(place).to_array(), "extras": {"receiver": true}});
        json!([
            {"name": "ground", "mesh": 0},
            {"name": "light", "mesh": 1},
            {"name": "camera", "camera": 0, "translation": camera.eye.to_array(), "rotation": camera.rotation.to_array()},
            receiver("receiver-open", OPEN),
            receiver("receiver-hidden", HIDDEN),
        ])
    }

    fn bounds(self) -> (Vec3, Vec3) {
        let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        self.vertices().fold(none, |(low, high), vertex| (low.min(vertex), high.max(vertex)))
    }
}

/// Where the receivers stand, (x, z) in metres.
const OPEN: [f64; 2] = [1.0, 0.0];
const HIDDEN: [f64; 2] = [-4.5, 3.0];

/// Height of the ground in metres: waves of five lengths, each half as long as the one before and less than half as high.
fn height(x: f64, z: f64) -> f64 {
    let wave = |k: u32| {
        let (scale, turn) = (f64::from(1 << k), f64::from(k));
        let (x, z) = (x * libm::cos(turn) - z * libm::sin(turn), x * libm::sin(turn) + z * libm::cos(turn));
        0.9 * libm::pow(0.4, turn) * libm::cos(scale * (0.9 * x - 0.9)) * libm::cos(0.6 * scale * z)
    };
    (0..5).map(wave).sum()
}

fn mesh(name: &str, index: u32) -> Value {
    let primitive = json!({"attributes": {"POSITION": 2 * index}, "indices": 2 * index + 1, "material": index});
    json!({"name": name, "primitives": [primitive]})
}
