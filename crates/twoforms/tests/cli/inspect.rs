//! `inspect`: what a scene holds.

use serde_json::{Value, json};

use crate::support::{folder, has_all, twoforms, written};

#[test]
fn the_text_lists_triangles_lights_cameras_and_receivers() {
    let text = twoforms("inspect @cornell-box").printed();
    let says = [
        "38 triangles in 8 surfaces, 2 of them emitting",
        "1 light, 1 target",
        "light: area 0.013650 m², radiance (17, 12, 4)",
        "1 camera, and auto",
        "9 receivers",
        "known irradiance",
    ];
    has_all(&text, &says);
    assert!(!text.contains("-0.000"), "{text}");
}

#[test]
fn the_document_holds_the_same_for_scripts() {
    let document = twoforms("inspect @two-lights --format json").json();
    assert_eq!(document["schema"], "twoforms.inspect/1");
    assert_eq!(document["scene_sha256"].as_str().map(str::len), Some(64));
    assert_eq!(document["lights"].as_array().map(Vec::len), Some(2));
    let light = &document["lights"][0];
    let area = light["area"].as_f64().expect("a number");
    // A one-sided diffuse emitter of radiance L and area A has the power π A L.
    let radiance = light["radiance"][0].as_f64().expect("a number");
    let power = light["power"][0].as_f64().expect("a number");
    assert_eq!(light["sides"], "front");
    assert!((power / (std::f64::consts::PI * area * radiance) - 1.0).abs() < 1e-9, "{light}");
    assert_eq!(document["auto_camera"]["name"], "auto");
    assert_eq!(document["warnings"], json!([]));
}

/// A PNG of two texels, red and black.
const IMAGE: &str = "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAADElEQVR4nGP4zwACAAYBAQB/9VxdAAAAAElFTkSuQmCC";

/// Positions, texture coordinates and indices of the unit square.
const SQUARE: &str = "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAIA/AACAPwAAAAAAAAAAAAAAAAAAAAAAAAAAAACAPwAAgD8AAIA/AACAPwAAAAAAAAEA\
    AgAAAAIAAwA=";

/// A square that emits by the image.
fn sign() -> Value {
    let accessor = |view: u32, component: u32, count: u32, kind: &str| json!({"bufferView": view, "componentType": component, "count": count, "type": kind});
    let view = |offset: u32, length: u32| json!({"buffer": 0, "byteOffset": offset, "byteLength": length});
    json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "sign"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
        "materials": [{"name": "neon", "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0},
            "pbrMetallicRoughness": {"metallicFactor": 0}}],
        "textures": [{"source": 0}],
        "images": [{"name": "stripes", "uri": format!("data:image/png;base64,{IMAGE}")}],
        "buffers": [{"byteLength": 92, "uri": format!("data:application/octet-stream;base64,{SQUARE}")}],
        "bufferViews": [view(0, 48), view(48, 32), view(80, 12)],
        "accessors": [accessor(0, 5126, 4, "VEC3"), accessor(1, 5126, 4, "VEC2"), accessor(2, 5123, 6, "SCALAR")],
    })
}

#[test]
fn textured_lights_and_their_images_are_shown_and_estimated() {
    let path = written(&folder("sign"), "sign.gltf", &sign().to_string());
    let text = twoforms(&format!("inspect {path}")).printed();
    has_all(&text, &["sign: area 1.000000 m², textured, mean radiance (0.5, 0, 0)", "1 texture, 1 image, 0.00 MiB"]);
    has_all(&text, &["stripes: 2 × 1, 0.00 MiB"]);
    let document = twoforms(&format!("inspect {path} --format json")).json();
    assert_eq!(document["images"], json!([{"name": "stripes", "width": 2, "height": 1, "bytes": 8}]));
    assert_eq!((&document["textures"], &document["lights"][0]["textured"]), (&json!(1), &json!(true)));
    // Red falls off to black as it rises elsewhere: half of what the square would give if it were red all over.
    let exact = twoforms(&format!("exact {path} --at 0.5,1,0.5,0,-1,0 --format json")).json();
    let irradiance = &exact["receivers"][0]["irradiance"]["rgb"];
    assert!(
        (irradiance[0].as_f64().expect("a number") / (0.5 * 0.752_274_688_454_107_4) - 1.0).abs() < 1e-9,
        "{irradiance}"
    );
    assert_eq!((&irradiance[1], &irradiance[2]), (&json!(0.0), &json!(0.0)));
    let compared = twoforms(&format!("compare {path} --at 0.5,1,0.5,0,-1,0 --samples 16 --replicates 50 --check"));
    assert_eq!(compared.code, Some(0));
}
