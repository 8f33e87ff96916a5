//! Scenes and answers in the data files.

use glam::DVec3;
use serde_json::Value as Json;

use crate::support::{Lamp, Scene, Triangle};

pub fn cases(text: &str) -> Vec<Json> {
    let json: Json = serde_json::from_str(text).unwrap();
    json["scenes"].as_array().unwrap().clone()
}

pub fn numbers(json: &Json) -> Vec<f64> {
    json.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

pub fn receiver(case: &Json) -> (DVec3, DVec3) {
    (DVec3::from_slice(&numbers(&case["x"])), DVec3::from_slice(&numbers(&case["n"])))
}

pub fn scene(case: &Json) -> Scene {
    let lamps = case["lights"].as_array().unwrap().iter().map(lamp).collect();
    Scene { lamps, blockers: triangles(&case["blockers"]) }
}

fn lamp(json: &Json) -> Lamp {
    let radiance = match json["radiance"].as_f64() {
        Some(grey) => [grey; 3],
        None => numbers(&json["rgb"]).try_into().unwrap(),
    };
    Lamp { triangles: triangles(&json["triangles"]), radiance, two_sided: json["sides"] == 2 }
}

fn triangles(json: &Json) -> Vec<Triangle> {
    let triangle = |t: &Json| {
        let n = numbers(t);
        [0, 3, 6].map(|k| DVec3::from_slice(&n[k..k + 3]))
    };
    json.as_array().unwrap().iter().map(triangle).collect()
}
