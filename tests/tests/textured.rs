//! Lights that emit by textures: exact light against samples, and the density that follows their luminance.

use base64::{Engine, engine::general_purpose::STANDARD};
use glam::Vec3;
use serde_json::{Value, json};
use twoforms_comparison::exactly::{self, with_formula};
use twoforms_comparison::image::{PixelFilter, Shown};
use twoforms_comparison::place::Place;
use twoforms_comparison::world::World;
use twoforms_estimator::density::{LuminanceOnLights, Ready};
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::selection::Selection;
use twoforms_estimator::strategy::{Strategy, Weighting};
use twoforms_estimator::technique::Kind;
use twoforms_geometry::view::{Effort, View};
use twoforms_tests::built::{ceiling, image, places, world};
use twoforms_tests::domain::{LightCells, chi_square};
use twoforms_tests::samples::Samples;
use twoforms_tests::scenes::{Material, Part, Receiver};
use twoforms_tests::statistics::{Family, Outcome};

const SEED: u64 = 20_261_123;
const LEVEL: f64 = 1e-3;
const N: u32 = 100_000;
const GREY: Material = Material::diffuse([0.5; 3]);
const FLOOR: usize = 0;
const SQUARE: usize = 2;
const TRIANGLE: usize = 3;
const LINEAR: u32 = 9729;
const NEAREST: u32 = 9728;

/// A floor, a card, a square and a triangle that emit by textures, and a lamp of one radiance.
fn parts() -> Vec<Part> {
    let floor = ceiling(0.0, [-3.0, -3.0], [3.0, 3.0]).into_iter().rev().collect();
    let triangle = vec![Vec3::new(1.0, 1.0, -0.5), Vec3::new(1.25, 1.5, 0.75), Vec3::new(1.5, 2.0, -0.25)];
    vec![
        Part::new("floor", GREY, vec![floor]),
        Part::new("card", GREY, vec![ceiling(1.0, [-0.25, -0.5], [0.5, 0.25])]),
        Part::new("square", Material::emitting([3.0, 2.0, 1.0]), vec![ceiling(2.0, [-1.0, -1.0], [0.5, 0.5])]),
        Part::new("triangle", Material::emitting([2.0, 4.0, 3.0]).double_sided(), vec![triangle]),
        Part::new("lamp", Material::emitting([1.0, 1.0, 2.0]), vec![ceiling(1.75, [-2.0, 0.5], [-1.75, 1.0])]),
    ]
}

/// The parts' world, the square and the triangle with textures of so many texels, turned and repeated.
fn textured() -> World {
    let up = glam::Quat::IDENTITY;
    let receivers = [
        Receiver::new("below", [0.125, 0.0, 0.125], up),
        Receiver::new("near", [-0.25, 1.5, -0.25], up),
        Receiver::new("aside", [2.0, 0.5, 0.25], up),
    ];
    world(&parts(), &receivers, |document| {
        let square = [[0.125, 0.25], [1.375, 0.5], [1.125, 1.75], [-0.125, 1.5]];
        paint(document, SQUARE, [5, 4], LINEAR, &square);
        paint(document, TRIANGLE, [3, 2], NEAREST, &[[0.0, 0.125], [1.5, 0.25], [0.25, 0.875]]);
    })
}

/// Makes a part emit by an image of colours that look like chance, at these texture coordinates.
fn paint(document: &mut Value, part: usize, [width, height]: [u32; 2], filter: u32, corners: &[[f32; 2]]) {
    let mut image = Vec::new();
    let mut encoder = png::Encoder::new(&mut image, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let texels: Vec<u8> = (0..3 * width * height).map(|k| (k * k * 37 + k * 101 + 13 * part as u32) as u8).collect();
    encoder.write_header().and_then(|mut writer| writer.write_image_data(&texels)).expect("an image");
    let coordinates: Vec<u8> = corners.as_flattened().iter().flat_map(|c| c.to_le_bytes()).collect();
    let uri = |kind: &str, bytes: &[u8]| format!("data:{kind};base64,{}", STANDARD.encode(bytes));
    let mut push = |list: &str, value: Value| {
        if document[list].is_null() {
            document[list] = json!([]);
        }
        let list = document[list].as_array_mut().expect("a list");
        list.push(value);
        list.len() - 1
    };
    let sampler = push("samplers", json!({"magFilter": filter}));
    let source = push("images", json!({"uri": uri("image/png", &image)}));
    let texture = push("textures", json!({"sampler": sampler, "source": source}));
    let bytes = json!({"byteLength": coordinates.len(), "uri": uri("application/octet-stream", &coordinates)});
    let buffer = push("buffers", bytes);
    let view = push("bufferViews", json!({"buffer": buffer, "byteLength": coordinates.len()}));
    let accessor = json!({"bufferView": view, "componentType": 5126, "count": corners.len(), "type": "VEC2"});
    let accessor = push("accessors", accessor);
    document["meshes"][part]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(accessor);
    document["materials"][part]["emissiveTexture"] = json!({"index": texture});
}

/// How far something found lies from what was expected, in deviations.
fn outcome(name: &str, found: f64, expected: f64, deviation: f64) -> Outcome {
    let z = (found - expected) / deviation;
    let p = beyond(z.abs());
    Outcome::Tested { p, evidence: format!("{name}: {found} against {expected}, z = {z:.2}") }
}

/// The probability that a normal deviate lies at least so far out, on either side.
fn beyond(z: f64) -> f64 {
    libm::erfc(z / std::f64::consts::SQRT_2)
}

/// Mean and variance of samples, red, against exact light. What `control-variate` knows of a texture is the light of its mean, and
/// no formula is known for the variance of the rest: its mean is held to its own samples' variance.
fn outcomes(world: &World, place: &Place, strategy: Strategy) -> Vec<Outcome> {
    let exact = exactly::at(world, place, &[strategy]);
    let view = View::new(&world.geometry, place.frame(), Effort::Gather);
    let (query, prepared) = (Query::irradiance(&world.lights), strategy.prepare(&world.lights));
    let samples = Samples::new(SEED, place, strategy, Sampler::Independent, N);
    let worths = samples.of(&*prepared.at(&view, &query, &exact.known()));
    let red: Vec<f64> = worths.iter().map(|worth| f64::from(worth[0])).collect();
    let n = f64::from(N);
    let mean = red.iter().sum::<f64>() / n;
    let central = |k: i32| red.iter().map(|worth| (worth - mean).powi(k)).sum::<f64>() / n;
    let (second, fourth) = (central(2), central(4));
    let irradiance = exact.light.irradiance.expect("an irradiance");
    assert!(irradiance.error_bound < 1e-9 * irradiance.luminance, "{irradiance:?}");
    let name = |what: &str| format!("{} {strategy} {what}", place.name);
    let variance = exact.light.strategies[0].variance_of_one;
    if strategy == Strategy::ControlVariate {
        assert_eq!(variance, None);
        return vec![outcome(&name("mean"), mean, irradiance.rgb[0], (second / n).sqrt())];
    }
    let variance = variance.expect("a variance");
    // Weights that jump are integrated to a thousandth.
    let jumps = matches!(strategy, Strategy::Mis(Weighting::Cutoff | Weighting::Maximum, _));
    let bound = if jumps { 1e-2 } else { 1e-6 };
    assert!(variance.error_bound < bound * variance.luminance, "{strategy}: {variance:?}");
    vec![
        outcome(&name("mean"), mean, irradiance.rgb[0], (variance.rgb[0] / n).sqrt()),
        outcome(&name("variance"), second, variance.rgb[0], ((fourth - second * second) / n).sqrt()),
    ]
}

#[test]
fn samples_vary_about_exact_light_as_it_says() {
    let world = textured();
    assert_eq!(world.scene.targets.len(), 3);
    let mut found = Vec::new();
    for place in places(&world) {
        for strategy in with_formula() {
            found.extend(outcomes(&world, &place, strategy));
        }
    }
    Family::new("samples of textured lights against exact light", LEVEL, SEED, found).assert_holds(0.0);
}

#[test]
fn points_by_luminance_follow_their_density() {
    let world = textured();
    let query = Query::irradiance(&world.lights);
    let ready = LuminanceOnLights::prepare(&world.lights, Selection::Together);
    let strategy = Strategy::from(Kind::AreaLuminance);
    let mut found = Vec::new();
    for place in places(&world) {
        let view = View::new(&world.geometry, place.frame(), Effort::Gather);
        let density = ready.at(&view, &query);
        let draws = Samples::new(SEED, &place, strategy, Sampler::Independent, N);
        let counts = chi_square(&view, &density, &LightCells::new(&view, &density.picking), &draws);
        found.push(Outcome::Tested { p: counts.p(), evidence: format!("{}: {counts}", place.name) });
    }
    Family::new("points by luminance against their density", LEVEL, SEED, found).assert_holds(0.0);
}

/// Each target is drawn in proportion to the luminance that it emits.
#[test]
fn targets_are_drawn_by_what_they_emit() {
    let world = textured();
    let ready = LuminanceOnLights::prepare(&world.lights, Selection::Together);
    let place = &places(&world)[0];
    let view = View::new(&world.geometry, place.frame(), Effort::Gather);
    let query = Query::irradiance(&world.lights);
    let density = ready.at(&view, &query);
    let total: f64 = (0..world.lights.targets() as u32).map(|k| world.lights.emitted(k)).sum();
    for target in 0..world.lights.targets() as u32 {
        let per_luminance = f64::from(density.picking.density::<f32>(target)) * total;
        assert!((per_luminance - 1.0).abs() < 1e-5, "target {target}: {per_luminance}");
    }
}

/// Radiance from a floor of many colours is that from a white one times the colour there, also where the floor is a metal but
/// for a texture that says otherwise.
#[test]
fn images_show_the_colour_at_the_point() {
    let floor = |document: &mut Value| {
        document["materials"][FLOOR]["pbrMetallicRoughness"]["baseColorFactor"] = json!([1.0, 1.0, 1.0, 1.0]);
    };
    let image = |world: &World| image(world, Shown::Diffuse, PixelFilter::Point, SEED);
    let white = image(&world(&parts(), &[], floor));
    let painted = image(&world(&parts(), &[], |document| {
        floor(document);
        paint(document, FLOOR, [7, 6], LINEAR, &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let material = &mut document["materials"][FLOOR];
        let texture = material.as_object_mut().expect("a material").remove("emissiveTexture").expect("a texture");
        let surface = &mut material["pbrMetallicRoughness"];
        surface["baseColorTexture"] = texture;
        surface["metallicFactor"] = json!(1.0);
        surface["metallicRoughnessTexture"] = json!({"index": 1});
        let mut yellow = Vec::new();
        let mut encoder = png::Encoder::new(&mut yellow, 1, 1);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header().and_then(|mut writer| writer.write_image_data(&[255, 255, 0])).expect("an image");
        let mut push = |list: &str, value: Value| document[list].as_array_mut().expect("a list").push(value);
        push("images", json!({"uri": format!("data:image/png;base64,{}", STANDARD.encode(&yellow))}));
        push("textures", json!({"sampler": 0, "source": 1}));
    }));
    let mut colours = std::collections::BTreeSet::new();
    for (one, other) in painted.iter().zip(&white) {
        assert_eq!(one.centre.is_some(), other.centre.is_some());
        let Some(centre) = one.centre.filter(|centre| centre.position[1].abs() < 1e-6) else { continue };
        colours.insert(centre.albedo.map(f32::to_bits));
        for c in 0..3 {
            let expected = other.mean[c] * f64::from(centre.albedo[c]);
            assert!((one.mean[c] - expected).abs() <= 1e-4 * expected, "{centre:?}: {} {expected}", one.mean[c]);
        }
    }
    assert!(colours.len() > 100, "{} colours", colours.len());
}
