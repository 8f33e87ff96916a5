//! Files that are refused, each with a sentence that says what, where and what to do.

use std::path::Path;

use crate::support::{BYTE, FLOAT, File, SHORT, UNSIGNED_INT, UNSIGNED_SHORT};
use serde_json::{Value, json};
use twoforms_scene::Scene;

fn lit_square() -> File {
    let mut file = File::new();
    let material = file.emitter([1.0; 3]);
    let mesh = file.square(Some(material));
    file.node(json!({"name": "lamp", "mesh": mesh}));
    file
}

/// The message after `pointer` of a file that is right is set to `value`.
fn after(pointer: &str, value: Value) -> String {
    let mut file = lit_square();
    let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
    let parent = file.json.pointer_mut(parent).expect("it is there");
    match key.parse::<usize>() {
        Ok(index) => parent[index] = value,
        Err(_) => parent[key] = value,
    }
    let message = file.refusal();
    assert!(message.starts_with("test.gltf: ") && !message.contains('\n'), "{message}");
    message
}

fn of_bytes(bytes: &[u8]) -> String {
    Scene::from_bytes(bytes, Path::new("test.glb")).expect_err("it is wrong").to_string()
}

#[test]
fn the_square_itself_is_right() {
    assert_eq!(lit_square().scene().lights.len(), 1);
}

#[test]
fn breaches_are_refused_with_their_place() {
    for (pointer, value, expected) in [
        ("/asset/version", json!("1.0"), r#"not glTF 2.0: its asset.version is "1.0"; export"#),
        ("/asset/minVersion", json!("2.1"), r#"its asset.minVersion is "2.1""#),
        ("/nodes", json!({}), "its JSON does not follow glTF 2.0 (invalid type: map"),
        ("/accessors/0/componentType", json!(UNSIGNED_INT), "accessors[0] does not hold binary32; repair"),
        ("/accessors/0/componentType", json!(BYTE), "accessors[0] does not hold binary32"),
        ("/accessors/0/componentType", json!(1), "accessors[0].componentType has a value that glTF does not know"),
        ("/accessors/0/type", json!("SCALAR"), "accessors[0] is not a VEC3"),
        ("/accessors/0/type", json!("VEC9"), "accessors[0].type has a value that glTF does not know"),
        ("/accessors/0/count", json!(5), "accessors[0] stands in bufferViews[0], which ends before it"),
        ("/accessors/0/count", json!(u64::MAX), "accessors[0] takes the scene beyond 33554432 vertices"),
        ("/accessors/0/byteOffset", json!(u64::MAX), "which ends before it"),
        ("/accessors/0/bufferView", json!(9), "accessors[0].bufferView names something that does not exist"),
        ("/accessors/1/componentType", json!(SHORT), "accessors[1] does not hold unsigned integers"),
        ("/accessors/1/count", json!(7), "accessors[1] stands in bufferViews[1], which ends before it"),
        ("/bufferViews/0/byteStride", json!(8), "which has a byteStride of 8 for 12 bytes"),
        ("/bufferViews/0/byteStride", json!(2), "bufferViews[0].byteStride has a value that glTF does not know"),
        ("/bufferViews/0/byteLength", json!(u64::MAX), "bufferViews[0], which reaches beyond its buffer"),
        ("/bufferViews/0/byteOffset", json!(u64::MAX), "bufferViews[0], which reaches beyond its buffer"),
        ("/bufferViews/0/buffer", json!(1), "bufferViews[0].buffer names something that does not exist"),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(7), "primitives[0] names an accessor that does not exist"),
        ("/meshes/0/primitives/0/attributes", json!({}), r#"attributes["POSITION"] is missing"#),
        ("/meshes/0/primitives/0/attributes/NORMAL", json!(1), "accessors[1] is not a VEC3"),
        ("/meshes/0/primitives/0/indices", json!(7), "primitives[0].indices names something that does not exist"),
        ("/meshes/0/primitives/0/mode", json!(7), "primitives[0].mode has a value that glTF does not know"),
        ("/meshes/0/primitives/0/material", json!(7), "primitives[0].material names something that does not exist"),
        ("/nodes/0/mesh", json!(7), "nodes[0].mesh names something that does not exist"),
        ("/nodes/0/children", json!([7]), "nodes[0].children[0] names something that does not exist"),
        ("/nodes/0/children", json!([0]), r#"node "lamp" is its own ancestor"#),
        ("/nodes/0/rotation", json!([0, 0, 0, 2]), r#"node "lamp" has a rotation of length 2 where a unit"#),
        ("/nodes/0/matrix", json!(vec![1; 16]), r#"node "lamp" has a matrix whose last row is not 0, 0, 0, 1"#),
        ("/nodes/0/scale", json!([1e300, 1, 1]), r#""lamp" has vertex 2 at a place that is not finite in binary32"#),
        ("/scene", json!(3), "scene names something that does not exist"),
        ("/scenes/0/nodes", json!([0, 0]), r#"scenes[0] lists "lamp", which is not a root or stands there twice"#),
        ("/materials/0/emissiveFactor", json!([0, -1, 0]), r#"material "materials[0]" has an emissiveFactor or"#),
        ("/materials/0/emissiveFactor", json!([0, 1e39, 0]), "negative or not finite"),
        ("/materials/0/pbrMetallicRoughness/metallicFactor", json!(1.5), "metallicFactor outside [0, 1]"),
        (
            "/extensionsRequired",
            json!(["ACME_dust"]),
            r#"requires the extension "ACME_dust", which is not read; export"#,
        ),
        ("/extensionsRequired", json!(["KHR_draco_mesh_compression"]), "`npx @gltf-transform/cli copy in.glb out.glb`"),
        ("/extensionsRequired", json!(["EXT_meshopt_compression"]), "`npx @gltf-transform/cli copy in.glb out.glb`"),
    ] {
        let message = after(pointer, value);
        assert!(message.contains(expected), "{pointer}: {message}");
    }
}

#[test]
fn transforms_that_are_ambiguous_or_infinite_are_refused() {
    let mut file = lit_square();
    file.json["nodes"][0]["matrix"] = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    assert_eq!(file.scene().mesh, lit_square().scene().mesh);
    file.json["nodes"][0]["translation"] = json!([1, 0, 0]);
    assert!(file.refusal().contains(r#"node "lamp" has a matrix beside a translation"#));
    let mut chain = File::new();
    chain.push("nodes", json!({"name": "deep", "scale": [1e300, 1e300, 1e300]}));
    chain.node(json!({"children": [0], "scale": [1e300, 1e300, 1e300]}));
    assert!(chain.refusal().contains(r#"node "deep" stands at a place, or in a size, that is not finite"#));
}

#[test]
fn trees_are_trees() {
    let mut file = File::new();
    file.push("nodes", json!({"name": "child"}));
    file.node(json!({"children": [0]}));
    file.node(json!({"children": [0]}));
    assert!(file.refusal().contains(r#"node "child" has several parents"#));
    file.json["nodes"][2] = json!({});
    file.json["scenes"][0]["nodes"] = json!([0]);
    assert!(file.refusal().contains(r#"scenes[0] lists "child", which is not a root"#));
}

#[test]
fn a_long_chain_of_nodes_is_no_danger() {
    let mut file = File::new();
    file.node(json!({"children": [1]}));
    for child in 2..20_000 {
        file.push("nodes", json!({"children": [child]}));
    }
    file.push("nodes", json!({"name": "receiver"}));
    assert_eq!(file.scene().receivers.len(), 1);
}

#[test]
fn numbers_that_are_none_are_refused() {
    for bad in [f32::NAN, f32::INFINITY] {
        let mut file = File::new();
        let mesh = file.triangles(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, bad, 0.0]], &[0, 1, 2], None);
        file.node(json!({"mesh": mesh}));
        assert!(file.refusal().contains("accessors[0] is NaN or infinite at element 2"));
    }
}

#[test]
fn indices_stay_below_the_number_of_vertices() {
    for (index, count) in [(4, 4), (u16::MAX, 4)] {
        let mut file = File::new();
        let mesh = file.triangles(&crate::support::SQUARE, &[0, 1, index], None);
        file.node(json!({"mesh": mesh}));
        assert!(file.refusal().contains(&format!("accessors[1] has index {index} for {count} vertices")));
    }
}

#[test]
fn instances_are_counted_before_they_are_made() {
    let mut file = lit_square();
    let translations = json!({"type": "VEC3", "componentType": FLOAT, "count": (1 << 23) + 1});
    let translations = file.push("accessors", translations);
    let extension = json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": translations}}});
    file.json["nodes"][0]["extensions"] = extension;
    assert!(
        file.refusal().contains(r#""lamp" takes the scene beyond 33554432 vertices or triangles; export a smaller"#)
    );
}

#[test]
fn compressed_data_that_is_not_required_is_asked_for_without_compression() {
    let mut file = lit_square();
    file.json["accessors"][0].as_object_mut().expect("object").remove("bufferView");
    assert_eq!(file.scene().mesh.bounds(), Some((glam::Vec3::ZERO, glam::Vec3::ZERO)), "glTF means zeros");
    file.json["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    assert!(file.refusal().contains("accessors[0] has no data but compressed; `npx @gltf-transform/cli copy"));
}

#[test]
fn files_that_are_something_else_are_refused() {
    for (bytes, expected) in [
        (&b""[..], "test.glb: not glTF 2.0: the file is empty; export the scene as .gltf or .glb, version 2.0"),
        (b"solid cube", "it is not JSON (expected value at line 1"),
        (br#"{"asset":"#, "it is not JSON (EOF while parsing"),
        (b"{}", "its JSON does not follow glTF 2.0 (missing field `asset`"),
        (b"glTF", "the binary container is broken, its header is cut short"),
        (b"glTF\x02\0\0\0\0\0\0\0", "its header gives a length of 0 bytes"),
        (b"glTF\x02\0\0\0\x40\0\0\0", "its header promises 64 bytes, but it holds 12"),
        (b"glTF\x03\0\0\0\x0C\0\0\0", "the binary container is broken, unsupported version"),
    ] {
        let message = of_bytes(bytes);
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn a_container_may_be_cut_anywhere_without_harm() {
    let whole = lit_square().glb();
    assert!(Scene::from_bytes(&whole, Path::new("test.glb")).is_ok());
    for length in 0..whole.len() {
        assert!(of_bytes(&whole[..length]).contains("not glTF 2.0"));
    }
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let message = |path: &Path| Scene::load(path).expect_err("it is not there").to_string();
    let missing = message(Path::new("no-such.gltf"));
    assert!(missing.starts_with("no-such.gltf: cannot read the file: "), "{missing}");
    assert!(missing.ends_with("; check the name and the permissions"), "{missing}");
    assert!(message(&std::env::temp_dir()).contains("cannot read the file: it is a folder"));
    #[cfg(unix)]
    assert!(message(Path::new("/dev/zero")).contains("it is not a plain file"));
}

#[test]
fn buffers_that_cannot_be_read_are_named() {
    let refusal = |buffer: Value| {
        let mut json = lit_square().json;
        json["buffers"] = json!([buffer]);
        of_bytes(json.to_string().as_bytes())
    };
    let data = "data:application/octet-stream;base64,AAAA";
    for (buffer, expected) in [
        (json!({"byteLength": 4, "uri": data}), "buffers[0] promises 4 bytes, but only 3 are there"),
        (json!({"byteLength": 3, "uri": "data:;base64,####"}), "buffers[0] has broken base64 data (Invalid symbol"),
        (json!({"byteLength": 3, "uri": "data:,abc"}), "buffers[0] has a data URI that is not in base64"),
        (json!({"byteLength": 3, "uri": "no such.bin"}), r#"cannot read buffers[0], the file "no such.bin": "#),
        (json!({"byteLength": 3, "uri": "https://a.b/c"}), r#"buffers[0] has a "https" address; only files beside"#),
        (json!({"byteLength": 3, "uri": "%FF.bin"}), r#"buffers[0] has an address that is no text ("%FF.bin")"#),
        (json!({"byteLength": 3}), "bufferViews[0], which stands in a buffer without data"),
    ] {
        let message = refusal(buffer);
        assert!(message.contains(expected), "{message}");
    }
    let mut short = lit_square();
    let index = short.json["accessors"][1]["componentType"] == json!(UNSIGNED_SHORT);
    assert!(index, "the square has short indices");
    short.bytes.pop();
    assert!(short.refusal().contains("bufferViews[1], which reaches beyond its buffer"));
}
