//! `inspect`: what a scene holds.

use serde_json::json;

use crate::support::{has_all, twoforms};

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
