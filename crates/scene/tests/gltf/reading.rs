//! Geometry: what stands where in the world.

use std::path::Path;

use crate::support::{BYTE, FLOAT, File, SHORT, SQUARE, UNSIGNED_BYTE, UNSIGNED_INT, UNSIGNED_SHORT};
use glam::{DVec3, Vec3};
use serde_json::json;
use twoforms_scene::Scene;

const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

fn placed(node: serde_json::Value) -> Scene {
    let mut file = File::new();
    let mesh = file.triangles(&TRIANGLE, &[0, 1, 2], None);
    let mut node = node;
    node["mesh"] = json!(mesh);
    file.node(node);
    file.scene()
}

#[test]
fn vertices_are_transformed_in_binary64_and_rounded_once() {
    let scene = placed(json!({"translation": [0.1, 0.2, 1e8], "scale": [3.0, 1.0, 1.0]}));
    let expected = [Vec3::new(0.1, 0.2, 1e8), Vec3::new((0.1_f64 + 3.0) as f32, 0.2, 1e8), Vec3::new(0.1, 1.2, 1e8)];
    assert_eq!(scene.mesh.vertices, expected);
}

#[test]
fn a_matrix_is_read_by_columns() {
    let scene = placed(json!({"matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]}));
    assert_eq!(scene.mesh.vertices, [Vec3::new(5., 6., 7.), Vec3::new(5., 7., 7.), Vec3::new(4., 6., 7.)]);
}

#[test]
fn children_follow_their_parents_in_scene_order() {
    let mut file = File::new();
    let mesh = file.triangles(&TRIANGLE, &[0, 1, 2], None);
    let leaf = file.push("nodes", json!({"name": "leaf", "mesh": mesh, "translation": [0, 1, 0]}));
    file.node(json!({"name": "first", "mesh": mesh, "children": [leaf], "scale": [2, 2, 2]}));
    file.node(json!({"name": "last", "mesh": mesh}));
    let scene = file.scene();
    let names: Vec<_> = scene.surfaces.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["first", "leaf", "last"]);
    assert_eq!(scene.mesh.vertices[3..6], [Vec3::new(0., 2., 0.), Vec3::new(2., 2., 0.), Vec3::new(0., 4., 0.)]);
    assert_eq!(scene.surfaces[1].triangles, 1..2);
    assert_eq!([0, 1, 2].map(|t| scene.surface_of(t).name.clone()), ["first", "leaf", "last"]);
}

#[test]
fn a_mirror_turns_the_winding_and_keeps_the_front() {
    let plain = placed(json!({}));
    let mirrored = placed(json!({"scale": [-1, 1, 1]}));
    assert_eq!(plain.mesh.triangles, [[0, 1, 2]]);
    assert_eq!(mirrored.mesh.triangles, [[0, 2, 1]]);
    assert_eq!(mirrored.mesh.triangle(0).cross(), DVec3::Z);
    let twice = placed(json!({"scale": [-1, -1, 1]}));
    assert_eq!(twice.mesh.triangles, [[0, 1, 2]]);
}

#[test]
fn shared_vertices_stay_shared_and_indices_may_have_any_width() {
    for (component, bytes) in [
        (UNSIGNED_BYTE, vec![0, 1, 2, 0, 2, 3]),
        (UNSIGNED_SHORT, [0_u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()).collect()),
        (UNSIGNED_INT, [0_u32, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()).collect()),
    ] {
        let mut file = File::new();
        let (positions, indices) = (file.vectors(&SQUARE), file.accessor("SCALAR", component, 6, &bytes));
        let mesh = file.mesh(&json!({"attributes": {"POSITION": positions}, "indices": indices}));
        file.node(json!({"mesh": mesh}));
        let scene = file.scene();
        assert_eq!(scene.mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(scene.mesh.vertices, SQUARE.map(Vec3::from));
    }
}

#[test]
fn modes_are_told_apart_and_points_and_lines_skipped() {
    let triangles = |mode: u32| {
        let mut file = File::new();
        let positions = file.vectors(&SQUARE);
        let mesh = file.mesh(&json!({"attributes": {"POSITION": positions}, "mode": mode}));
        file.node(json!({"name": "thing", "mesh": mesh}));
        let scene = file.scene();
        (scene.mesh.triangles.clone(), scene.warnings)
    };
    for mode in 0..4 {
        let (triangles, warnings) = triangles(mode);
        assert_eq!(triangles, [[0; 3]; 0]);
        assert_eq!(warnings, [r#"points and lines have no area and are skipped: "thing""#]);
    }
    assert_eq!(triangles(4).0, [[0, 1, 2]]);
    assert!(triangles(4).1.contains(&r#"vertices that make no whole triangle are left over: "thing""#.to_string()));
    assert_eq!(triangles(5).0, [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(triangles(6).0, [[1, 2, 0], [2, 3, 0]]);
}

#[test]
fn quantized_positions_are_read_with_the_extension_alone() {
    let mut file = File::new();
    let shorts = [0_i16, 0, 0, 32767, 0, 0, 0, -32768, 0].iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>();
    let positions = file.accessor("VEC3", SHORT, 3, &shorts);
    let normals = file.accessor("VEC3", BYTE, 3, &[0, 0, 127, 0, 0, 127, 0, 0, 127]);
    file.json["accessors"][normals]["normalized"] = json!(true);
    let mesh = file.mesh(&json!({"attributes": {"POSITION": positions, "NORMAL": normals}}));
    file.node(json!({"mesh": mesh}));
    assert!(file.refusal().contains("accessors[0] does not hold binary32"));
    file.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let scene = file.scene();
    assert_eq!(scene.mesh.vertices[1..], [Vec3::new(32767., 0., 0.), Vec3::new(0., -32768., 0.)]);
    assert_eq!(scene.surfaces[0].normals, Some(vec![Vec3::Z; 3]));
    file.json["accessors"][positions]["normalized"] = json!(true);
    assert_eq!(file.scene().mesh.vertices[1..], [Vec3::X, -Vec3::Y]);
}

#[test]
fn interleaved_and_sparse_accessors_are_read() {
    let mut file = File::new();
    let rows: Vec<u8> = TRIANGLE.iter().flat_map(|p| [p[0], p[1], p[2], f32::NAN]).flat_map(f32::to_le_bytes).collect();
    let positions = file.accessor("VEC3", FLOAT, 3, &rows);
    file.json["bufferViews"][0]["byteStride"] = json!(16);
    let mesh = file.mesh(&json!({"attributes": {"POSITION": positions}}));
    file.node(json!({"mesh": mesh}));
    assert_eq!(file.scene().mesh.vertices, TRIANGLE.map(Vec3::from));
    let at = file.view(&[2]);
    let values = file.view(&[1.0_f32, 2.0, 3.0].map(f32::to_le_bytes).concat());
    file.json["accessors"][positions]["sparse"] = json!({"count": 1, "values": {"bufferView": values},
        "indices": {"bufferView": at, "componentType": UNSIGNED_BYTE}});
    assert_eq!(file.scene().mesh.vertices, [Vec3::ZERO, Vec3::X, Vec3::new(1., 2., 3.)]);
    file.json["accessors"][positions].as_object_mut().expect("object").remove("bufferView");
    assert_eq!(file.scene().mesh.vertices, [Vec3::ZERO, Vec3::ZERO, Vec3::new(1., 2., 3.)]);
}

#[test]
fn instances_stand_where_their_accessors_say() {
    let mut file = File::new();
    let mesh = file.triangles(&TRIANGLE, &[0, 1, 2], None);
    let translations = file.vectors(&[[10.0, 0.0, 0.0], [20.0, 0.0, 0.0]]);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let rotations = file.vectors(&[[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, half, half]]);
    let scales = file.vectors(&[[-1.0, 1.0, 1.0], [2.0, 2.0, 2.0]]);
    let attributes = json!({"TRANSLATION": translations, "ROTATION": rotations, "SCALE": scales});
    let extension = json!({"EXT_mesh_gpu_instancing": {"attributes": attributes}});
    file.node(json!({"name": "tree", "mesh": mesh, "translation": [0, 0, 1], "extensions": extension}));
    let scene = file.scene();
    assert_eq!(scene.surfaces.iter().map(|s| s.name.as_str()).collect::<Vec<_>>(), ["tree[0]", "tree[1]"]);
    assert_eq!(scene.mesh.triangles, [[0, 2, 1], [3, 4, 5]]);
    let expected = [[10., 0., 1.], [9., 0., 1.], [10., 1., 1.], [20., 0., 1.], [20., 2., 1.], [18., 0., 1.]];
    assert_eq!(scene.mesh.vertices, expected.map(Vec3::from));
    let short = file.vectors(&[[1.0, 1.0, 1.0]]);
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = json!(short);
    assert!(file.refusal().contains(r#"node "tree" has instances whose translations"#));
}

#[test]
fn smooth_normals_are_carried_and_missing_ones_are_flat() {
    let mut file = File::new();
    let positions = file.vectors(&TRIANGLE);
    let normals = file.vectors(&[[1.0, 0.0, 0.0], [0.0, 0.0, 2.0], [0.0, 1.0, 1.0]]);
    let mesh = file.mesh(&json!({"attributes": {"POSITION": positions, "NORMAL": normals}}));
    file.node(json!({"mesh": mesh, "scale": [1, 1, 0.5]}));
    let normals = file.scene().surfaces[0].normals.clone().expect("they are given");
    assert_eq!(normals[..2], [Vec3::X, Vec3::Z]);
    assert!(normals[2].abs_diff_eq(Vec3::new(0.0, 1.0, 2.0).normalize(), 1e-7));
    assert_eq!(placed(json!({})).surfaces[0].normals, None);
    file.json["nodes"][0]["scale"] = json!([0, 0, 0]);
    let flat = file.scene();
    assert_eq!(flat.surfaces[0].normals, None);
    assert!(flat.warnings.iter().any(|line| line.starts_with("a surface is shaded flat")));
}

#[test]
fn the_first_scene_stands_in_for_a_missing_default_and_all_nodes_for_a_missing_scene() {
    let mut file = File::new();
    let mesh = file.triangles(&TRIANGLE, &[0, 1, 2], None);
    file.node(json!({"mesh": mesh}));
    file.push("nodes", json!({"mesh": mesh}));
    file.push("scenes", json!({"nodes": [0, 1]}));
    let count = |file: &File| file.scene().surfaces.len();
    assert_eq!(count(&file), 1);
    file.json["scene"] = json!(1);
    assert_eq!(count(&file), 2);
    let document = file.json.as_object_mut().expect("object");
    document.remove("scene");
    assert_eq!(count(&file), 1);
    file.json.as_object_mut().expect("object").remove("scenes");
    assert_eq!(count(&file), 2);
}

#[test]
fn text_and_container_and_buffer_files_give_one_scene() {
    let mut file = File::new();
    let mesh = file.square(None);
    file.node(json!({"mesh": mesh}));
    let text = file.scene();
    let container = Scene::from_bytes(&file.glb(), Path::new("test.glb")).expect("it is right");
    let folder = std::env::temp_dir().join(format!("twoforms-scene-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("two words.bin"), &file.bytes).expect("a buffer");
    file.json["buffers"] = json!([{"byteLength": file.bytes.len(), "uri": "two%20words.bin"}]);
    let path = folder.join("scene.gltf");
    std::fs::write(&path, file.json.to_string()).expect("a scene");
    let beside = Scene::load(&path);
    std::fs::remove_dir_all(&folder).expect("the folder goes");
    let beside = beside.expect("it is right");
    assert_eq!([&container.mesh, &beside.mesh], [&text.mesh; 2]);
    assert_eq!((beside.path, beside.sha256.len()), (path, 64));
    assert_ne!(container.sha256, text.sha256);
}
