//! Small glTF files, made in memory.

use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use twoforms_scene::{Scene, SceneError};

/// Component types.
pub const BYTE: u32 = 5120;
pub const UNSIGNED_BYTE: u32 = 5121;
pub const SHORT: u32 = 5122;
pub const UNSIGNED_SHORT: u32 = 5123;
pub const UNSIGNED_INT: u32 = 5125;
pub const FLOAT: u32 = 5126;

/// The corners of the unit square in the plane y = 0, counter-clockwise seen from above.
pub const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, 0.0]];

/// A file in the making: its JSON and its one buffer.
pub struct File {
    pub json: Value,
    pub bytes: Vec<u8>,
}

impl File {
    /// A file with one empty scene.
    pub fn new() -> Self {
        let json = json!({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "extensionsUsed": [], "buffers": [],
            "bufferViews": [], "accessors": [], "materials": [], "meshes": [], "nodes": [], "cameras": [],
        });
        Self { json, bytes: Vec::new() }
    }

    /// Appends to a list of the file; returns the index.
    pub fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json[list].as_array_mut().expect("it is a list");
        list.push(value);
        list.len() - 1
    }

    /// Adds a buffer view with these bytes.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend(bytes);
        self.push("bufferViews", json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}))
    }

    /// Adds an accessor for `count` elements.
    pub fn accessor(&mut self, kind: &str, component: u32, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        let accessor = json!({"bufferView": view, "type": kind, "componentType": component, "count": count});
        self.push("accessors", accessor)
    }

    /// Adds an accessor of binary32 vectors.
    pub fn vectors<const N: usize>(&mut self, vectors: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = vectors.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor(&format!("VEC{N}"), FLOAT, vectors.len(), &bytes)
    }

    /// Adds an accessor of 16-bit indices.
    pub fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        self.accessor("SCALAR", UNSIGNED_SHORT, indices.len(), &bytes)
    }

    /// Adds a mesh of one primitive.
    pub fn mesh(&mut self, primitive: &Value) -> usize {
        self.push("meshes", json!({"primitives": [primitive]}))
    }

    /// Adds a mesh of triangles over `positions`, with a material where one is given.
    pub fn triangles(&mut self, positions: &[[f32; 3]], indices: &[u16], material: Option<usize>) -> usize {
        let (positions, indices) = (self.vectors(positions), self.indices(indices));
        let mut primitive = json!({"attributes": {"POSITION": positions}, "indices": indices});
        if let Some(material) = material {
            primitive["material"] = json!(material);
        }
        self.mesh(&primitive)
    }

    /// Adds a square of two triangles.
    pub fn square(&mut self, material: Option<usize>) -> usize {
        self.triangles(&SQUARE, &[0, 1, 2, 0, 2, 3], material)
    }

    /// Adds a square with this material and `TEXCOORD_0`: (0, 0) and (1, 0) at its far corners, v toward +Z.
    pub fn textured_square(&mut self, material: Value) -> usize {
        let material = self.push("materials", material);
        let positions = self.vectors(&SQUARE);
        let coordinates = self.vectors(&SQUARE.map(|[x, _, z]| [x, z]));
        let indices = self.indices(&[0, 1, 2, 0, 2, 3]);
        let attributes = json!({"POSITION": positions, "TEXCOORD_0": coordinates});
        self.mesh(&json!({"attributes": attributes, "indices": indices, "material": material}))
    }

    /// Adds a material that emits.
    pub fn emitter(&mut self, emission: [f64; 3]) -> usize {
        self.push("materials", json!({"emissiveFactor": emission, "pbrMetallicRoughness": {"metallicFactor": 0}}))
    }

    /// Adds a node to the file and to the scene.
    pub fn node(&mut self, node: Value) -> usize {
        let index = self.push("nodes", node);
        let roots = self.json["scenes"][0]["nodes"].as_array_mut().expect("it is a list");
        roots.push(json!(index));
        index
    }

    /// The file as text, its buffer in a data URI.
    pub fn text(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&self.bytes));
        json["buffers"] = json!([{"byteLength": self.bytes.len(), "uri": uri}]);
        json.to_string().into_bytes()
    }

    /// The file as a binary container.
    pub fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = json!([{"byteLength": self.bytes.len()}]);
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut blob = self.bytes.clone();
        blob.resize(blob.len().next_multiple_of(4), 0);
        let chunk = |kind: &[u8], data: &[u8]| [&(data.len() as u32).to_le_bytes(), kind, data].concat();
        let chunks = [chunk(b"JSON", &text), chunk(b"BIN\0", &blob)].concat();
        let length = (12 + chunks.len()) as u32;
        [b"glTF".as_slice(), &2_u32.to_le_bytes(), &length.to_le_bytes(), &chunks].concat()
    }

    /// Reads the file.
    pub fn load(&self) -> Result<Scene, SceneError> {
        Scene::from_bytes(&self.text(), Path::new("test.gltf"))
    }

    /// The scene of a file that is right.
    pub fn scene(&self) -> Scene {
        self.load().expect("the file is right")
    }

    /// The message about a file that is wrong.
    pub fn refusal(&self) -> String {
        self.load().expect_err("the file is wrong").to_string()
    }
}
