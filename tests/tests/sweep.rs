//! Sweeps against scenes whose lights were moved in the file: occluders stay, lights hide lights, coplanar ones do not.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use twoforms_comparison::exactly::{self, ExactLight, ExactVariance};
use twoforms_comparison::place::Place;
use twoforms_comparison::sweep::{Parameter, Spacing, Sweep};
use twoforms_comparison::swept::swept;
use twoforms_comparison::world::World;
use twoforms_estimator::strategy::Strategy;
use twoforms_scene::Scene;

/// A scene of the repository.
fn scene(name: &str) -> Scene {
    let path = format!("{}/../scenes/{name}.gltf", env!("CARGO_MANIFEST_DIR"));
    Scene::load(Path::new(&path)).expect("a scene")
}

/// The scene with all vertices of its lights moved and rounded to binary32: y ↦ scale (y − centroid) + centroid + offset.
fn moved(mut scene: Scene, scale: f64, offset: DVec3) -> Scene {
    let mut mesh = scene.mesh.as_ref().clone();
    for (light, surface) in scene.lights.iter_mut().zip(scene.surfaces.iter().filter(|s| s.light.is_some())) {
        let triangles = surface.triangles.clone().map(|t| scene.mesh.triangle(t));
        let weighted = triangles.map(|t| t.area() * t.vertices().into_iter().sum::<DVec3>() / 3.0);
        let centroid = weighted.sum::<DVec3>() / light.area;
        for vertex in surface.vertices.clone() {
            let y = scene.mesh.vertices[vertex as usize].as_dvec3();
            mesh.vertices[vertex as usize] = (scale * (y - centroid) + centroid + offset).as_vec3();
        }
        let targets = light.targets.clone().map(|k| scene.targets[k as usize].area(&mesh));
        light.area = targets.sum();
    }
    scene.mesh = Arc::new(mesh);
    scene
}

fn places(scene: &Scene) -> Vec<Place> {
    scene.receivers.iter().map(Place::of_receiver).collect()
}

/// Checks E and all variances against each other: the moved vertices differ by their rounding, some 10⁻⁷ of a metre.
fn same(name: &str, one: &ExactLight, other: &ExactLight) {
    let near = |what: &str, a: f64, b: f64, size: f64| {
        assert!((a - b).abs() <= 1e-5 * size, "{name}, {what}: {a} and {b}");
    };
    let (e, f) = (one.irradiance.expect("a value").luminance, other.irradiance.expect("a value").luminance);
    near("E", e, f, e);
    assert_eq!(one.strategies.len(), other.strategies.len());
    for (v, w) in one.strategies.iter().zip(&other.strategies) {
        let value = |v: &ExactVariance| {
            let missing = || panic!("{name}, {}: {:?}", v.strategy, v.why);
            v.variance_of_one.map_or_else(missing, |v| v.luminance)
        };
        let (a, b) = (value(v), value(w));
        near(&v.strategy, a, b, a + e * e);
    }
}

/// Strategies that ask for areas, powers and every selection.
fn strategies() -> Vec<Strategy> {
    let names = "hemisphere/cosine area/uniform area/uniform@uniform area/uniform@power area/uniform@contribution \
                 area/solid-angle area/projected-solid-angle mis/balance";
    names.split_whitespace().map(|name| name.parse().expect("a strategy")).collect()
}

fn compare(name: &str, parameter: Parameter, values: [f64; 2], motion: impl Fn(f64) -> (f64, DVec3)) {
    let (here, strategies) = (scene(name), strategies());
    let places = places(&here);
    let world = World::new(here.clone()).expect("a light");
    let sweep = Sweep::new(parameter, values[0], values[1], Spacing::Linear, 4).expect("a sweep");
    let along = swept(&world, &places, &strategies, &sweep, &|_| ());
    let mut lit = 0;
    for k in 0..4 {
        let at = along[0].sweep.as_ref().expect("a sweep").steps[k].at;
        let (scale, offset) = motion(at);
        let there = World::new(moved(here.clone(), scale, offset)).expect("a light");
        for (place, result) in places.iter().zip(&along) {
            let step = &result.sweep.as_ref().expect("a sweep").steps[k];
            let truth = exactly::at(&there, place, &strategies);
            lit += u32::from(truth.light.irradiance.is_some_and(|e| e.luminance > 0.0));
            same(&format!("{name}, {} = {at}, {}", parameter.name(), place.name), &step.light, &truth.light);
        }
    }
    assert!(lit > 8, "{name}: {lit} of the receivers are lit");
}

#[test]
fn lights_moved_by_a_sweep_are_lights_moved_in_the_file() {
    let shift = |axis: DVec3| move |at: f64| (1.0, axis * at);
    compare("cornell-box", Parameter::LightX, [-0.07, 0.05], shift(DVec3::X));
    compare("cornell-box", Parameter::LightY, [-0.15, -0.01], shift(DVec3::Y));
    compare("two-lights", Parameter::LightZ, [-0.6, 0.4], shift(DVec3::Z));
    compare("two-lights", Parameter::LightX, [-1.1, 0.7], shift(DVec3::X));
    compare("square-light", Parameter::LightY, [-0.4, 0.8], shift(DVec3::Y));
}

#[test]
fn lights_scaled_by_a_sweep_are_lights_scaled_in_the_file() {
    for name in ["cornell-box", "two-lights", "square-light"] {
        compare(name, Parameter::LightScale, [0.4, 1.3], |at| (at, DVec3::ZERO));
    }
}

/// With the lights where the file has them all comes out the same.
#[test]
fn the_step_at_rest_is_the_scene_itself() {
    let strategies = strategies();
    for name in ["cornell-box", "two-lights", "tiny-far-light", "nori-light-5"] {
        let world = World::new(scene(name)).expect("a light");
        for parameter in Parameter::ALL {
            let rest = if parameter == Parameter::LightScale { 1.0 } else { 0.0 };
            let sweep = Sweep::new(parameter, rest, 2.0, Spacing::Linear, 2).expect("a sweep");
            for result in swept(&world, &places(&world.scene), &strategies, &sweep, &|_| ()) {
                let step = &result.sweep.as_ref().expect("a sweep").steps[0];
                for (v, w) in result.light.strategies.iter().zip(&step.light.strategies) {
                    let [a, b] = [v, w].map(|v| v.variance_of_one.expect("a value"));
                    let allowed = a.error_bound + b.error_bound + 1e-14 * a.luminance;
                    let off = (a.luminance - b.luminance).abs();
                    assert!(off <= allowed, "{name}, {}, {}: off by {off:e}", result.name, v.strategy);
                }
            }
        }
    }
}
