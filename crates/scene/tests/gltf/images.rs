//! Images: formats, places, and what is wrong with them.

use std::fs;
use std::path::PathBuf;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use twoforms_scene::{Problem, Scene, SceneError};

use crate::pictures::{jpeg, png, png_of};
use crate::support::File;

/// A square that emits by image 0, which is `image`.
fn lamp(image: &Value) -> File {
    let mut file = File::new();
    let mesh = file.textured_square(json!({"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}}));
    file.node(json!({"name": "lamp", "mesh": mesh}));
    file.json["textures"] = json!([{"source": 0}]);
    file.json["images"] = json!([image]);
    file
}

/// A square whose base colour is image 0.
fn wall(image: &Value) -> File {
    let mut file = lamp(image);
    let pbr = json!({"metallicFactor": 0, "baseColorTexture": {"index": 0}});
    file.json["materials"][0] = json!({"name": "wall", "pbrMetallicRoughness": pbr});
    file
}

fn data(kind: &str, bytes: &[u8]) -> Value {
    json!({"uri": format!("data:image/{kind};base64,{}", STANDARD.encode(bytes))})
}

/// A folder of its own for the test called `name`.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("twoforms-scene-{name}-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder can be made");
    folder
}

#[test]
fn every_kind_of_png_is_read() {
    use png::{BitDepth, ColorType};
    let grey = [128.0 / 255.0; 3];
    for (kind, depth, bytes, expected) in [
        (ColorType::Rgb, BitDepth::Eight, vec![255, 0, 51], [1.0, 0.0, 0.2]),
        (ColorType::Rgba, BitDepth::Eight, vec![255, 0, 51, 7], [1.0, 0.0, 0.2]),
        (ColorType::Grayscale, BitDepth::Eight, vec![128], grey),
        (ColorType::GrayscaleAlpha, BitDepth::Eight, vec![128, 0], grey),
        (ColorType::Grayscale, BitDepth::One, vec![128], [1.0; 3]),
        (ColorType::Rgb, BitDepth::Sixteen, vec![128, 0, 255, 255, 0, 1], [32768.0 / 65535.0, 1.0, 1.0 / 65535.0]),
        (ColorType::GrayscaleAlpha, BitDepth::Sixteen, vec![128, 0, 1, 1], [32768.0 / 65535.0; 3]),
    ] {
        let mut file = wall(&data("png", &png_of(1, 1, kind, depth, &bytes)));
        let uses = json!({"index": 0});
        file.json["materials"][0]["pbrMetallicRoughness"] = json!({"metallicRoughnessTexture": uses});
        let found = file.scene().appearance_at(0, [0.2, 0.2]);
        assert_eq!([found.roughness, found.metallic], [expected[1], expected[2]], "{kind:?} {depth:?}");
    }
}

#[test]
fn a_jpeg_is_read_texel_by_texel() {
    let scene = wall(&data("jpeg", &jpeg(2, &[10, 100, 200, 255]))).scene();
    assert_eq!((scene.images[0].width, scene.images[0].height, scene.images[0].bytes()), (16, 16, 1024));
    let [dark, light] = [(1, [0.1, 0.1]), (0, [0.1, 0.7])].map(|(t, b)| scene.appearance_at(t, b).base_color);
    let srgb = |code: f64| ((code / 255.0 + 0.055) / 1.055).powf(2.4);
    assert!((f64::from(dark[0]) - 10.0 / 255.0 / 12.92).abs() < 1e-7, "{dark:?}");
    assert_eq!((light, dark[0]), ([1.0; 3], dark[2]));
    let scene = wall(&data("jpeg", &jpeg(1, &[200]))).scene();
    assert!((f64::from(scene.appearance_at(1, [0.3, 0.3]).base_color[1]) - srgb(200.0)).abs() < 1e-6);
}

#[test]
fn images_stand_in_files_data_and_buffers_alike() {
    let bytes = png(2, 1, &[[255, 0, 0, 255], [0, 0, 255, 255]]);
    let expected = wall(&data("png", &bytes)).scene();
    let mut file = wall(&json!({"name": "stripes"}));
    let view = file.view(&bytes);
    file.json["images"][0] = json!({"bufferView": view, "name": "stripes"});
    let held = file.scene();
    assert_eq!(held.images[0].name, "stripes", "and without a mimeType");
    let folder = folder("places");
    fs::write(folder.join("a b.png"), &bytes).expect("a file can be written");
    let file = wall(&json!({"uri": "a%20b.png"}));
    let beside = Scene::from_bytes(&file.text(), &folder.join("wall.gltf")).expect("the image is there");
    fs::remove_dir_all(&folder).expect("it was made here");
    for scene in [&held, &beside] {
        for b in [[0.0, 0.0], [0.3, 0.1], [0.0, 0.9]] {
            assert_eq!(scene.appearance_at(0, b), expected.appearance_at(0, b));
        }
    }
    let own = Scene::from_bytes(&file.text(), &folder.join("wall.gltf")).expect("a wall needs no image");
    assert_ne!(own.sha256, beside.sha256, "the image belongs to the scene");
}

#[test]
fn an_image_that_two_textures_show_is_held_once() {
    let mut file = wall(&data("png", &png(1, 1, &[[255, 128, 64, 255]])));
    file.json["samplers"] = json!([{"magFilter": 9728}]);
    file.json["textures"] = json!([{"source": 0}, {"source": 0, "sampler": 0}]);
    file.json["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = json!({"index": 1});
    let scene = file.scene();
    assert_eq!((scene.images.len(), scene.textures.len(), scene.images[0].bytes()), (1, 2, 4));
    let found = scene.appearance_at(0, [0.1, 0.1]);
    assert_eq!(found.roughness, 128.0 / 255.0, "linear");
    assert!((found.base_color[1] - 0.215_860_5).abs() < 1e-6, "{:?}: sRGB", found.base_color);
}

#[test]
fn what_no_surface_shows_is_not_read() {
    let mut file = wall(&json!({"uri": "no-such.png"}));
    file.json["materials"].as_array_mut().expect("a list").push(json!({}));
    file.json["meshes"][0]["primitives"][0]["material"] = json!(1);
    assert!(file.scene().images.is_empty() && file.scene().is_uniform(0));
    assert!(!file.scene().warnings.iter().any(|line| line.contains("no-such")));
}

/// The message about an image on a light, and the warning about the same image on a wall.
fn both(image: &Value) -> (String, String) {
    let refusal = lamp(image).refusal();
    let scene = wall(image).scene();
    assert_eq!(scene.appearance_at(0, [0.1, 0.1]).base_color, [1.0; 3], "the factor counts");
    let warning = scene.warnings.iter().find(|line| line.contains("cannot be used")).expect("a warning").clone();
    (refusal, warning)
}

#[test]
fn images_that_are_wrong_are_refused_on_lights_and_warned_of_on_walls() {
    let whole = png(4, 4, &[[9; 4]; 16]);
    let huge = [&whole[..16], &[0, 1, 0, 0, 0, 1, 0, 0], &whole[24..]].concat();
    let zero = [&whole[..16], &[0; 8], &whole[24..]].concat();
    for (image, expected) in [
        (json!({"uri": "no%20such.png"}), r#"cannot read images[0], the file "no such.png": "#),
        (json!({"uri": "https://a.b/c.png"}), r#"images[0] has a "https" address; only files beside"#),
        (json!({"uri": "data:image/png,abc"}), "images[0] has a data URI that is not in base64"),
        (data("png", b"GIF89a"), "images[0] is neither PNG nor JPEG, and others are not read; export the scene with"),
        (data("png", b""), "images[0] is neither PNG nor JPEG"),
        (data("png", &whole[..40]), "images[0] is a broken PNG ("),
        (data("png", &resealed(&huge)), "images[0] has 65536 × 65536 texels, and 67108864 are the most that are read"),
        (data("png", &resealed(&zero)), "images[0] is a broken PNG ("),
        (data("jpeg", &jpeg(1, &[1])[..60]), "images[0] is a broken JPEG ("),
        (json!({"name": "empty"}), "images[0] has neither uri nor bufferView"),
        (json!({"bufferView": 99}), "images[0] stands in bufferViews[99], which does not exist"),
    ] {
        let (refusal, warning) = both(&image);
        let start = r#"test.gltf: material "materials[0]" emits by a texture that cannot be used: "#;
        assert!(refusal.starts_with(start) && refusal.contains(expected), "{refusal}");
        assert!(warning.contains(expected) && warning.ends_with(r#": "wall""#), "{warning}");
    }
}

#[test]
fn textures_and_samplers_that_are_wrong_are_named() {
    let good = data("png", &png(1, 1, &[[9; 4]]));
    let change = |list: &str, value: Value| {
        let mut file = lamp(&good);
        file.json[list] = value;
        file.refusal()
    };
    let no_image = change("textures", json!([{"extensions": {"KHR_texture_basisu": {"source": 0}}}]));
    assert!(no_image.contains("textures[0] has no image but in an extension"), "{no_image}");
    let beyond = change("textures", json!([{"source": 7}]));
    assert!(beyond.contains("textures[0] names an image that does not exist"), "{beyond}");
    let sampler = change("textures", json!([{"source": 0, "sampler": 3}]));
    assert!(sampler.contains("textures[0] names a sampler that does not exist"), "{sampler}");
    let mut file = lamp(&good);
    file.json["textures"] = json!([{"source": 0, "sampler": 0}]);
    for bad in [json!({"magFilter": 1}), json!({"wrapS": 5}), json!({"wrapT": 10498})] {
        file.json["samplers"] = json!([bad]);
        assert!(file.refusal().contains("samplers[0] has a value that glTF does not know"));
    }
    let mut file = lamp(&good);
    file.json["materials"][0]["emissiveTexture"]["extensions"] = json!({"KHR_texture_transform": {"scale": [1e39, 1]}});
    assert!(file.refusal().contains("KHR_texture_transform out of range"));
    let mut file = lamp(&json!({"uri": "no-such.png"}));
    file.json["materials"][0]["emissiveFactor"] = json!([0, 0, 0]);
    assert!(file.scene().lights.is_empty(), "what does not emit needs no texture");
}

/// The same PNG with the right checksum of its header.
fn resealed(bytes: &[u8]) -> Vec<u8> {
    let crc = bytes[12..29].iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg()))
    });
    [&bytes[..29], &(!crc).to_be_bytes(), &bytes[33..]].concat()
}

/// Loads a lamp with these bytes as its image; the message where it is refused.
fn outcome(bytes: &[u8]) -> Result<Scene, String> {
    let loaded = lamp(&data("png", bytes)).load();
    loaded.map_err(|SceneError { problem, .. }| match problem {
        Problem::Emission { .. } => problem.to_string(),
        other => panic!("another refusal: {other}"),
    })
}

#[test]
fn images_may_be_cut_anywhere_without_harm() {
    let texels: Vec<[u8; 4]> = (0..64_u8).map(|i| [i, 4 * i, 255 - i, 255]).collect();
    let whole = png(8, 8, &texels);
    assert!(outcome(&whole).is_ok());
    for length in 0..whole.len() - 4 {
        assert!(outcome(&whole[..length]).is_err(), "{length} of {} bytes of a PNG", whole.len());
    }
    let whole = jpeg(2, &[0, 90, 180, 255]);
    assert!(outcome(&whole).is_ok());
    for length in 0..whole.len() - 4 {
        assert!(outcome(&whole[..length]).is_err(), "{length} of {} bytes of a JPEG", whole.len());
    }
}

#[test]
fn any_byte_of_an_image_may_be_wrong_without_harm() {
    let texels: Vec<[u8; 4]> = (0..64_u8).map(|i| [i, 4 * i, 255 - i, 255]).collect();
    for whole in [png(8, 8, &texels), jpeg(2, &[0, 90, 180, 255])] {
        let mut refused = 0;
        for (at, bit) in (0..whole.len()).flat_map(|at| [0, 3, 7].map(|bit| (at, bit))) {
            let mut bytes = whole.clone();
            bytes[at] ^= 1 << bit;
            refused += usize::from(outcome(&bytes).is_err());
        }
        assert!(refused > whole.len() / 4, "most harm is found: {refused} of {}", 3 * whole.len());
    }
}
