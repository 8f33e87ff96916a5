//! A scene as a glTF 2.0 document with its one buffer inside.
//!
//! The buffer holds all positions (binary32), then all indices (16 bits). Meshes have no normals:
//! glTF then asks for flat shading, which is what these scenes mean.

use base64::{Engine, engine::general_purpose::STANDARD};
use glam::{Quat, Vec3};
use serde_json::{Value, json};

use super::part::Pattern;
use super::{Answer, Material, Part, Receiver, Scene};

const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;
const U16: u32 = 5123;
const F32: u32 = 5126;
const NEAREST: u32 = 9728;
const CLAMP: u32 = 33071;

/// The whole document.
pub fn document(scene: &Scene) -> Value {
    let parts = &scene.parts;
    let mut document = json!({
        "asset": {"version": "2.0", "generator": "twoforms write-scenes"},
        "scene": 0,
        "scenes": [scene_entry(scene)],
        "nodes": nodes(scene),
        "cameras": [camera(scene)],
        "meshes": (0..parts.len()).map(|i| mesh(parts, i)).collect::<Vec<_>>(),
        "materials": (0..parts.len()).map(|i| material(parts, i)).collect::<Vec<_>>(),
        "accessors": accessors(parts),
        "bufferViews": buffer_views(parts),
        "buffers": [buffer(parts)],
    });
    if parts.iter().any(|part| emissive_strength(&part.material) > 1.0) {
        document["extensionsUsed"] = json!(["KHR_materials_emissive_strength"]);
    }
    let patterns: Vec<Pattern> = parts.iter().filter_map(|part| part.pattern).collect();
    if !patterns.is_empty() {
        let texture = |k: usize| json!({"sampler": 0, "source": k});
        document["samplers"] = json!([{"magFilter": NEAREST, "minFilter": NEAREST, "wrapS": CLAMP, "wrapT": CLAMP}]);
        document["textures"] = (0..patterns.len()).map(texture).collect();
        document["images"] = patterns.iter().map(image).collect();
    }
    document
}

fn scene_entry(scene: &Scene) -> Value {
    let count = scene.parts.len() + scene.receivers.len() + 1;
    json!({
        "name": scene.name,
        "nodes": (0..count).collect::<Vec<_>>(),
        "extras": {"description": scene.description},
    })
}

fn nodes(scene: &Scene) -> Vec<Value> {
    let mesh = |(i, part): (usize, &Part)| json!({"name": part.name, "mesh": i});
    let mut nodes: Vec<Value> = scene.parts.iter().enumerate().map(mesh).collect();
    nodes.extend(scene.answers().map(|(receiver, answer)| receiver_node(receiver, &answer)));
    let camera = &scene.camera;
    nodes.push(json!({
        "name": "camera",
        "camera": 0,
        "translation": camera.eye.to_array(),
        "rotation": camera.rotation.to_array(),
    }));
    nodes
}

fn receiver_node(receiver: &Receiver, answer: &Answer) -> Value {
    let mut node = json!({"name": receiver.name, "translation": receiver.position.to_array()});
    if receiver.rotation != Quat::IDENTITY {
        node["rotation"] = json!(receiver.rotation.to_array());
    }
    node["extras"] = extras(receiver, answer);
    node
}

fn extras(receiver: &Receiver, answer: &Answer) -> Value {
    let variance = answer.variance.iter().map(|(strategy, v)| (strategy.to_string(), json!(v)));
    json!({
        "receiver": true,
        "irradiance": answer.irradiance,
        "variance": variance.collect::<serde_json::Map<_, _>>(),
        "derivation": format!("{} {}", receiver.note, answer.derivation).trim(),
    })
}

fn camera(scene: &Scene) -> Value {
    json!({
        "name": "camera",
        "type": "perspective",
        "perspective": {
            "aspectRatio": scene.camera.aspect_ratio,
            "yfov": scene.camera.yfov,
            "znear": 0.01,
        },
    })
}

fn mesh(parts: &[Part], index: usize) -> Value {
    let mut primitive = json!({
        "attributes": {"POSITION": 2 * index},
        "indices": 2 * index + 1,
        "material": index,
    });
    if parts[index].pattern.is_some() {
        primitive["attributes"]["TEXCOORD_0"] = json!(2 * parts.len() + number_of_pattern(parts, index));
    }
    json!({"name": parts[index].name, "primitives": [primitive]})
}

/// Which of the patterns is that of a part.
fn number_of_pattern(parts: &[Part], index: usize) -> usize {
    parts[..index].iter().filter(|part| part.pattern.is_some()).count()
}

/// A pattern as an image of two by two texels.
fn image(pattern: &Pattern) -> Value {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::NoCompression);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&pattern.concat()));
    written.expect("four texels can be written");
    json!({"uri": format!("data:image/png;base64,{}", STANDARD.encode(&bytes))})
}

/// The power of two that scales the radiance to an `emissiveFactor` of at most 1 without rounding.
fn emissive_strength(material: &Material) -> f32 {
    let largest = material.radiance.into_iter().fold(0.0, f32::max);
    let mut strength = 1.0;
    while strength < largest {
        strength *= 2.0;
    }
    strength
}

fn material(parts: &[Part], index: usize) -> Value {
    let part = &parts[index];
    let [r, g, b] = part.material.albedo;
    let mut material = json!({
        "name": part.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": 1.0,
        },
    });
    if part.material.double_sided {
        material["doubleSided"] = json!(true);
    }
    if part.material.emits() {
        let strength = emissive_strength(&part.material);
        material["emissiveFactor"] = json!(part.material.radiance.map(|l| l / strength));
        if part.pattern.is_some() {
            material["emissiveTexture"] = json!({"index": number_of_pattern(parts, index)});
        }
        if strength > 1.0 {
            material["extensions"] = json!({"KHR_materials_emissive_strength": {"emissiveStrength": strength}});
        }
    }
    material
}

fn positions(part: &Part) -> Vec<Vec3> {
    part.polygons.concat()
}

/// Each polygon as a fan of triangles about its first corner.
fn indices(part: &Part) -> Vec<u16> {
    let mut indices = Vec::new();
    let mut first = 0;
    for polygon in &part.polygons {
        let end = first + polygon.len() as u16;
        indices.extend((first + 2..end).flat_map(|i| [first, i - 1, i]));
        first = end;
    }
    indices
}

fn accessors(parts: &[Part]) -> Vec<Value> {
    let (mut positions_offset, mut indices_offset) = (0, 0);
    let mut accessors = Vec::new();
    for part in parts {
        let (positions, indices) = (positions(part), indices(part));
        accessors.push(positions_accessor(&positions, positions_offset));
        accessors.push(json!({
            "bufferView": 1, "byteOffset": indices_offset, "componentType": U16,
            "count": indices.len(), "type": "SCALAR",
        }));
        positions_offset += 12 * positions.len();
        indices_offset += 2 * indices.len();
    }
    let mut coordinates_offset = 0;
    for part in parts.iter().filter(|part| part.pattern.is_some()) {
        let count = positions(part).len();
        accessors.push(json!({
            "bufferView": 2, "byteOffset": coordinates_offset, "componentType": F32, "count": count, "type": "VEC2",
        }));
        coordinates_offset += 8 * count;
    }
    accessors
}

/// The corners of the texture, around each polygon of the parts that have a pattern.
fn coordinate_bytes(parts: &[Part]) -> Vec<u8> {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let polygons = parts.iter().filter(|part| part.pattern.is_some()).flat_map(|part| &part.polygons);
    polygons.flat_map(|_| corners).flatten().flat_map(f32::to_le_bytes).collect()
}

fn positions_accessor(positions: &[Vec3], offset: usize) -> Value {
    let min = positions.iter().copied().fold(Vec3::INFINITY, Vec3::min);
    let max = positions.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
    json!({
        "bufferView": 0, "byteOffset": offset, "componentType": F32,
        "count": positions.len(), "type": "VEC3", "min": min.to_array(), "max": max.to_array(),
    })
}

fn position_bytes(parts: &[Part]) -> Vec<u8> {
    let numbers = parts.iter().flat_map(positions).flat_map(|v| v.to_array());
    numbers.flat_map(f32::to_le_bytes).collect()
}

fn index_bytes(parts: &[Part]) -> Vec<u8> {
    parts.iter().flat_map(indices).flat_map(u16::to_le_bytes).collect()
}

fn buffer_views(parts: &[Part]) -> Value {
    let (vertices, indices) = (position_bytes(parts).len(), index_bytes(parts).len());
    let mut views = json!([
        {"buffer": 0, "byteLength": vertices, "byteStride": 12, "target": VERTICES},
        {"buffer": 0, "byteOffset": vertices, "byteLength": indices, "target": INDICES},
    ]);
    let coordinates = coordinate_bytes(parts).len();
    if let (Some(views), true) = (views.as_array_mut(), coordinates > 0) {
        let offset = vertices + padded(indices);
        let view =
            json!({"buffer": 0, "byteOffset": offset, "byteLength": coordinates, "byteStride": 8, "target": VERTICES});
        views.push(view);
    }
    views
}

/// The next multiple of four, at which numbers of four bytes may begin.
fn padded(length: usize) -> usize {
    length.next_multiple_of(4)
}

fn buffer(parts: &[Part]) -> Value {
    let (mut indices, coordinates) = (index_bytes(parts), coordinate_bytes(parts));
    if !coordinates.is_empty() {
        indices.resize(padded(indices.len()), 0);
    }
    let bytes = [position_bytes(parts), indices, coordinates].concat();
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes));
    json!({"byteLength": bytes.len(), "uri": uri})
}
