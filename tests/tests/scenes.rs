//! The files in `scenes/` and what they promise.

use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use twoforms_tests::scenes::{self, Answer, Part, Receiver, Scene};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

fn scene(name: &str) -> Scene {
    scenes::all().into_iter().find(|scene| scene.name == name).expect("a scene of that name")
}

fn answer(scene: &Scene, receiver: &str) -> Answer {
    let mut answers = scene.answers();
    answers.find(|(x, _)| x.name == receiver).expect("a receiver of that name").1
}

fn variance(answer: &Answer, strategy: &str) -> f64 {
    answer.variance(strategy).expect("a listed strategy")[0]
}

#[test]
fn files_are_what_the_program_writes() {
    for scene in scenes::all() {
        let path = folder().join(scene.file_name());
        let written = std::fs::read_to_string(&path).unwrap_or_default();
        let same = written == scene.to_gltf();
        assert!(same, "{}: run `cargo run -p twoforms-tests --bin write-scenes`", path.display());
    }
}

#[test]
fn folder_and_readme_name_every_scene_and_no_other() {
    let names: BTreeSet<String> = scenes::all().iter().map(Scene::file_name).collect();
    let entries = std::fs::read_dir(folder()).expect("the folder of scenes");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let scenes = paths.filter(|path| path.extension().is_some_and(|suffix| suffix == "gltf"));
    let found: BTreeSet<String> = scenes.map(|path| file_name(&path)).collect();
    assert_eq!(found, names);
    let readme = readme();
    for name in names {
        assert!(readme.contains(&format!("`{name}`")), "README.md does not name {name}");
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().expect("a name").to_string_lossy().into_owned()
}

fn readme() -> String {
    std::fs::read_to_string(folder().join("README.md")).expect("a README")
}

#[test]
fn readme_lists_every_receiver_with_its_irradiance() {
    let readme = readme();
    for scene in scenes::all() {
        for (receiver, answer) in scene.answers() {
            let name = format!("| `{}` |", receiver.name);
            let irradiance = format!("| {} |", six_decimals(answer.irradiance));
            let is_row = |line: &str| line.starts_with(&name) && line.ends_with(&irradiance);
            assert!(readme.lines().any(is_row), "{}: {name} … {irradiance}", scene.name);
        }
    }
}

/// One number where the channels agree, else three.
fn six_decimals([r, g, b]: [f64; 3]) -> String {
    if r == g && g == b { format!("{r:.6}") } else { format!("{r:.6}, {g:.6}, {b:.6}") }
}

/// The reader finds the very geometry, lights and receivers that the answers were computed from.
#[test]
fn files_read_back_to_what_was_meant() {
    for scene in scenes::all() {
        let read = twoforms_scene::Scene::load(&folder().join(scene.file_name())).expect("a scene");
        assert_eq!(read.warnings, [""; 0], "{}", scene.name);
        let triangles = (0..).take(read.mesh.len()).map(|i| read.mesh.triangle(i).vertices());
        assert!(triangles.eq(scene.parts.iter().flat_map(Part::triangles)), "{}", scene.name);
        let lights = scene.parts.iter().filter(|part| part.material.emits());
        let radiances = lights.map(mean_radiance);
        assert!(read.lights.iter().map(|light| light.radiance).eq(radiances), "{}", scene.name);
        assert_eq!(read.cameras.len(), 1, "{}", scene.name);
        assert_eq!(read.receivers.len(), scene.receivers.len(), "{}", scene.name);
        for (found, (receiver, answer)) in read.receivers.iter().zip(scene.answers()) {
            assert_same_receiver(found, receiver, &answer);
        }
    }
}

/// The mean over the texels of a light, which are equally large.
fn mean_radiance(light: &Part) -> [f32; 3] {
    let texels = light.texels();
    [0, 1, 2].map(|c| texels.iter().map(|texel| texel.material.radiance[c]).sum::<f32>() / texels.len() as f32)
}

fn assert_same_receiver(found: &twoforms_scene::Receiver, receiver: &Receiver, answer: &Answer) {
    let name = receiver.name;
    assert_eq!(found.name, name);
    assert_eq!(found.position, receiver.x(), "{name}");
    assert!(found.normal.distance(receiver.n_x()) < 1e-7, "{name}: {}", found.normal);
    let known = found.known.as_ref().expect("a known answer");
    assert_eq!(known.irradiance, answer.irradiance, "{name}");
    assert_eq!(known.variance.len(), answer.variance.len(), "{name}");
    for (strategy, &variance) in &known.variance {
        assert_eq!(Some(variance), answer.variance(strategy), "{name} {strategy}");
    }
}

/// The measured data: the light's size, and nine receivers on the surfaces, facing out of them.
#[test]
fn cornell_receivers_lie_on_surfaces() {
    let scene = scene("cornell-box");
    let light = scene.parts.iter().find(|part| part.name == "light").expect("a light");
    assert!((light.area() - 0.13 * 0.105).abs() < 1e-8);
    assert_eq!(scene.receivers.len(), 9);
    for receiver in &scene.receivers {
        let on_surface = scene.parts.iter().flat_map(Part::triangles).any(|t| lies_on(receiver, t));
        assert!(on_surface, "{} floats", receiver.name);
    }
}

/// Within 1e-9 m of the triangle's plane, inside its edges, and on its front.
fn lies_on(receiver: &Receiver, [a, b, c]: [DVec3; 3]) -> bool {
    let normal = (b - a).cross(c - a).normalize();
    let (x, n_x) = (receiver.x(), receiver.n_x());
    let inside = |v: DVec3, w: DVec3| (w - v).cross(x - v).dot(normal) > 0.0;
    normal.dot(x - a).abs() < 1e-9 && inside(a, b) && inside(b, c) && inside(c, a) && n_x.distance(normal) < 1e-6
}

/// Some receivers are wholly lit, some in penumbra; what is hidden shows in the area estimator.
#[test]
fn cornell_receivers_are_lit_as_their_names_say() {
    let scene = scene("cornell-box");
    let unlit = |name: &str| answer(&scene, name).derivation.contains("shadow is cut away");
    for name in ["floor-penumbra", "behind-tall-block", "between-blocks"] {
        assert!(unlit(name), "{name} is not in penumbra");
        assert!(answer(&scene, name).irradiance[0] > 0.0, "{name} is in umbra");
    }
    for name in ["floor-lit", "on-short-block", "on-tall-block", "on-back-wall"] {
        assert!(!unlit(name), "{name} is in penumbra");
    }
}

/// Radiance by nori, then ours: irradiance and the variances of radiance for rho = 1/2 by area,
/// by cosine and by uniform hemisphere, computed beforehand by another quadrature.
#[test]
fn nori_lights_have_nori_s_radiance_and_the_tabulated_variances() {
    let rows = [
        (0.089_839_4, 0.564_476_71, [3.812_535e-3, 3.684_854e-2, 4.953_253e-2]),
        (0.022_92, 0.144_010_86, [2.774_736e-5, 1.093_469e-2, 2.053_215e-2]),
        (0.053_419_8, 0.335_644_87, [1.558_671e-3, 2.385_612e-2, 4.239_016e-2]),
        (0.020_531_4, 0.129_002_54, [3.978_901e-5, 9.844_158e-3, 1.627_902e-2]),
        (0.261_74, 1.644_560_04, [3.797_611e-2, 6.236_218e-2, 1.464_942e-1]),
    ];
    let strategies = ["area/uniform", "hemisphere/cosine", "hemisphere/uniform"];
    for (i, (radiance, irradiance, variances)) in rows.into_iter().enumerate() {
        let answer = answer(&scene(&format!("nori-light-{}", i + 1)), "origin");
        let [e, ..] = answer.irradiance;
        assert!((e - irradiance).abs() < 2e-8, "light {}: E = {e}", i + 1);
        assert!((0.5 * e / PI - radiance).abs() < 1e-6, "light {}: L = {}", i + 1, 0.5 * e / PI);
        for (strategy, v) in strategies.into_iter().zip(variances) {
            let v = v * (PI / 0.5).powi(2);
            let found = variance(&answer, strategy);
            assert!((found / v - 1.0).abs() < 1e-6, "light {} {strategy}: {found}, not {v}", i + 1);
        }
    }
}

/// hemisphere/cosine is pi times a coin of probability E/pi: V = E (pi L - E), hidden or not.
#[test]
fn cosine_hemisphere_is_a_coin_wherever_one_light_shines() {
    for scene in scenes::all() {
        let mut lights = scene.parts.iter().filter(|part| part.material.emits());
        let (Some(light), None) = (lights.next(), lights.next()) else { continue };
        for (receiver, answer) in scene.answers() {
            let found = answer.variance("hemisphere/cosine").expect("a listed strategy");
            for ((l, e), v) in light.material.radiance.into_iter().zip(answer.irradiance).zip(found) {
                let expected = e * (PI * f64::from(l) - e);
                let close = (v - expected).abs() <= 1e-13 * PI * f64::from(l) * e;
                assert!(close, "{} {}: {v}, not {expected}", scene.name, receiver.name);
            }
        }
    }
}

/// (2/45) (side/height)⁴ to leading order, where E[w²] - E² has no digit left.
#[test]
fn tiny_far_light_keeps_its_variance() {
    let answer = answer(&scene("tiny-far-light"), "below");
    let relative = variance(&answer, "area/uniform") / answer.irradiance[0].powi(2);
    let leading = 2.0 / 45.0 * 1e-12;
    assert!((relative / leading - 1.0).abs() < 1e-5, "V / E^2 = {relative}, not {leading}");
}

#[test]
fn answers_are_finite_and_no_variance_is_negative() {
    for scene in scenes::all() {
        for (receiver, answer) in scene.answers() {
            let numbers = answer.variance.iter().flat_map(|(_, v)| v).chain(&answer.irradiance);
            for &number in numbers {
                let sound = number.is_finite() && number >= 0.0;
                assert!(sound, "{} {}: {number}", scene.name, receiver.name);
            }
        }
    }
}

/// Radiance is stored as a factor of at most 1 and a power of two, so that their product, taken
/// in binary32, is the radiance itself.
#[test]
fn radiance_survives_the_file() {
    let text = scene("cornell-box").to_gltf();
    let document: serde_json::Value = text.parse().expect("JSON");
    let materials = document["materials"].as_array().expect("materials");
    let light = materials.iter().find(|m| m["name"] == "light").expect("a light");
    let strength = &light["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"];
    let factor = Vec3::from([0, 1, 2].map(|c| light["emissiveFactor"][c].as_f64().expect("a number") as f32));
    assert_eq!(factor * strength.as_f64().expect("a number") as f32, Vec3::new(17.0, 12.0, 4.0));
}
