//! Surfaces that are cut out by a mask are not there where they are cut out, and surfaces that are blended dim what passes.

use base64::{Engine, engine::general_purpose::STANDARD};
use glam::DVec3;
use serde_json::{Value, json};
use twoforms_comparison::exactly;
use twoforms_comparison::image::{Pixel, PixelFilter, Shown};
use twoforms_comparison::place::Place;
use twoforms_comparison::world::World;
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::{Known, Strategy, Weighting};
use twoforms_estimator::technique::Kind;
use twoforms_geometry::veil::Cover;
use twoforms_geometry::view::{Effort, View};
use twoforms_tests::built::{ceiling, image, places, world};
use twoforms_tests::samples::Samples;
use twoforms_tests::scenes::{Material, Part, Receiver};

const SEED: u64 = 20_261_122;
const N: u32 = 4096;
const GREY: Material = Material::diffuse([0.5; 3]);
const CARD: usize = 1;
const LIGHT: usize = 2;

/// A floor, a card at half height from `x` on, and a light that ends at `end`.
fn parts(x: f32, end: f32) -> Vec<Part> {
    let floor = ceiling(0.0, [-3.0, -3.0], [3.0, 3.0]).into_iter().rev().collect();
    let card = ceiling(1.0, [x, -0.5], [0.5, 0.5]);
    let light = ceiling(2.0, [-0.5, -0.5], [end, 0.5]);
    vec![
        Part::new("floor", GREY, vec![floor]),
        Part::new("card", GREY, vec![card]),
        Part::new("light", Material::emitting([3.0, 2.0, 1.0]), vec![light]),
    ]
}

fn receivers() -> Vec<Receiver> {
    let up = glam::Quat::IDENTITY;
    vec![
        Receiver::new("below", [0.0, 0.0, 0.125], up),
        Receiver::new("penumbra", [0.375, 0.25, 0.0], up),
        Receiver::new("aside", [-1.5, 0.0, 0.25], up),
        Receiver::new("above", [0.25, 1.5, 0.0], up),
    ]
}

/// Gives a part a base colour of two by one texels, white, with these alphas from its first corner along its first side.
fn cut(document: &mut Value, part: usize, alphas: [u8; 2]) {
    let mut image = Vec::new();
    let mut encoder = png::Encoder::new(&mut image, 2, 1);
    encoder.set_color(png::ColorType::Rgba);
    let texels = alphas.map(|alpha| [255, 255, 255, alpha]).concat();
    encoder.write_header().and_then(|mut writer| writer.write_image_data(&texels)).expect("an image");
    let corners: Vec<u8> =
        [[0.0_f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].concat().into_iter().flat_map(f32::to_le_bytes).collect();
    let uri = |kind: &str, bytes: &[u8]| format!("data:{kind};base64,{}", STANDARD.encode(bytes));
    document["samplers"] = json!([{"magFilter": 9728, "wrapS": 33071, "wrapT": 33071}]);
    document["images"] = json!([{"uri": uri("image/png", &image)}]);
    document["textures"] = json!([{"sampler": 0, "source": 0}]);
    let push = |document: &mut Value, list: &str, value: Value| {
        let list = document[list].as_array_mut().expect("a list");
        list.push(value);
        list.len() - 1
    };
    let buffer = json!({"byteLength": corners.len(), "uri": uri("application/octet-stream", &corners)});
    let buffer = push(document, "buffers", buffer);
    let view = push(document, "bufferViews", json!({"buffer": buffer, "byteLength": corners.len()}));
    let accessor = json!({"bufferView": view, "componentType": 5126, "count": 4, "type": "VEC2"});
    let accessor = push(document, "accessors", accessor);
    document["meshes"][part]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(accessor);
    document["materials"][part]["alphaMode"] = json!("MASK");
    document["materials"][part]["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": 0});
}

fn blend(document: &mut Value, alpha: f32) {
    document["materials"][CARD]["alphaMode"] = json!("BLEND");
    document["materials"][CARD]["pbrMetallicRoughness"]["baseColorFactor"] = json!([0.5, 0.5, 0.5, alpha]);
}

/// What samples are worth that share their numbers with those of other worlds.
fn worths(world: &World, place: &Place, strategy: Strategy, effort: Effort) -> Vec<[f32; 3]> {
    let view = View::new(&world.geometry, place.frame(), effort);
    let (query, prepared) = (Query::irradiance(&world.lights), strategy.prepare(&world.lights));
    let samples = Samples::new(SEED, place, strategy, Sampler::Independent, N);
    samples.of(&*prepared.at(&view, &query, &Known::default()))
}

fn strategies() -> impl Iterator<Item = Strategy> {
    Strategy::all().into_iter().filter(|strategy| strategy.needs_alpha().is_none())
}

/// Those whose samples depend on nothing but what lies along them.
fn without_pilots() -> impl Iterator<Item = Strategy> {
    strategies().filter(|strategy| !matches!(strategy, Strategy::Mis(Weighting::Pilot(_), _)))
}

/// How many samples of a world are not worth what `expected` says; rounding beside an edge may change some.
fn assert_worths(name: &str, found: &[[f32; 3]], expected: &[[f64; 3]]) {
    let differs = |(found, expected): &(&[f32; 3], &[f64; 3])| {
        found.iter().zip(*expected).any(|(&a, &b)| (f64::from(a) - b).abs() > 2e-5 * b.abs().max(1e-3))
    };
    let differing = found.iter().zip(expected).filter(differs).count();
    assert!(differing <= 2, "{name}: {differing} of {N} samples differ, seed {SEED}");
    assert!(found.len() == N as usize && expected.len() == N as usize);
}

fn wide(worths: &[[f32; 3]]) -> Vec<[f64; 3]> {
    worths.iter().map(|worth| worth.map(f64::from)).collect()
}

#[test]
fn a_card_with_half_of_it_cut_out_is_half_a_card() {
    let masked = world(&parts(-0.5, 0.5), &receivers(), |document| cut(document, CARD, [0, 255]));
    let half = world(&parts(0.0, 0.5), &receivers(), |_| ());
    assert_eq!(masked.geometry.cover(2), Cover::Cut);
    for (place, other) in places(&masked).iter().zip(&places(&half)) {
        for strategy in without_pilots() {
            let expected = wide(&worths(&half, other, strategy, Effort::Gather));
            for effort in [Effort::Gather, Effort::Cast] {
                assert_worths(
                    &format!("{} {strategy}", place.name),
                    &worths(&masked, place, strategy, effort),
                    &expected,
                );
            }
        }
    }
}

#[test]
fn a_light_with_half_of_it_cut_out_is_half_a_light() {
    let masked = world(&parts(0.0, 0.5), &receivers(), |document| cut(document, LIGHT, [255, 0]));
    let half = world(&parts(0.0, 0.0), &receivers(), |_| ());
    for (place, other) in places(&masked).iter().zip(&places(&half)) {
        for kind in [Kind::HemisphereUniform, Kind::HemisphereCosine] {
            let expected = wide(&worths(&half, other, kind.into(), Effort::Gather));
            assert_worths(&place.name, &worths(&masked, place, kind.into(), Effort::Gather), &expected);
        }
        let exact = exactly::at(&half, other, &[]).light.irradiance.expect("an irradiance").rgb[0];
        for strategy in strategies().filter(|strategy| !strategy.is_biased()) {
            let red: Vec<f64> =
                worths(&masked, place, strategy, Effort::Gather).iter().map(|w| f64::from(w[0])).collect();
            let n = f64::from(N);
            let mean = red.iter().sum::<f64>() / n;
            let deviation = (red.iter().map(|w| (w - mean).powi(2)).sum::<f64>() / (n * (n - 1.0))).sqrt();
            let apart = (mean - exact).abs();
            assert!(apart <= 6.0 * deviation + 3e-6 * exact, "{} {strategy}: {mean} {exact}", place.name);
        }
    }
}

/// The worth of a sample is linear in V, so that it lies between those with the card and without it.
#[test]
fn a_blended_card_lets_its_share_pass() {
    let alpha = 0.25;
    let blended = world(&parts(0.0, 0.5), &receivers(), |document| blend(document, alpha));
    let opaque = world(&parts(0.0, 0.5), &receivers(), |document| blend(document, 1.0));
    let without = world(&parts(0.0, 0.5), &receivers(), |document| blend(document, 0.0));
    assert!(blended.geometry.is_veiled() && without.geometry.is_veiled() && !opaque.geometry.is_veiled());
    let linear = |strategy: &Strategy| !matches!(strategy, Strategy::Resampled(_));
    for place in places(&blended) {
        for strategy in without_pilots().filter(linear) {
            let ends = [&opaque, &without].map(|world| wide(&worths(world, &place, strategy, Effort::Gather)));
            let mixed = |k: usize| -> [f64; 3] {
                let share = f64::from(alpha);
                std::array::from_fn(|c| share * ends[0][k][c] + (1.0 - share) * ends[1][k][c])
            };
            let expected: Vec<[f64; 3]> = (0..N as usize).map(mixed).collect();
            for effort in [Effort::Gather, Effort::Cast] {
                let name = format!("{} {strategy}", place.name);
                assert_worths(&name, &worths(&blended, &place, strategy, effort), &expected);
            }
        }
    }
}

#[test]
fn exact_light_is_had_where_nothing_of_that_kind_stands_between() {
    let masked = world(&parts(-0.5, 0.5), &receivers(), |document| cut(document, CARD, [0, 255]));
    let half = world(&parts(0.0, 0.5), &receivers(), |_| ());
    let at = |world: &World, name: &str| {
        let place = places(world).into_iter().find(|place| place.name == name).expect("a receiver");
        exactly::at(world, &place, &[]).light
    };
    assert_eq!(at(&masked, "above"), at(&half, "above"));
    let below = at(&masked, "below");
    assert!(below.irradiance.is_none(), "{below:?}");
    assert!(format!("{:?}", below.why).contains("cut out or blended"), "{:?}", below.why);
}

#[test]
fn images_see_through_what_is_cut_out_and_what_is_blended() {
    let image = |world: &World| image(world, Shown::Radiance, PixelFilter::Box, SEED);
    let masked = image(&world(&parts(-0.5, 0.5), &receivers(), |document| cut(document, CARD, [0, 255])));
    let half = image(&world(&parts(0.0, 0.5), &receivers(), |_| ()));
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|c| (a[c] - b[c]).abs() <= 2e-5 * (a[c] + b[c]));
    let differing = masked.iter().zip(&half).filter(|(one, other)| !near(one.mean, other.mean)).count();
    assert!(differing <= 4, "{differing} pixels differ");
    let blended = |alpha| image(&world(&parts(0.0, 0.5), &receivers(), |document| blend(document, alpha)));
    let [none, some, all] = [0.0, 0.25, 1.0].map(blended);
    let linear = |k: usize| std::array::from_fn(|c| 0.75 * none[k].mean[c] + 0.25 * all[k].mean[c]);
    // Where the card is seen and in its shadow alike, radiance is linear in alpha; where it lies in its own shadow it is not.
    let differing = (0..some.len()).filter(|&k| !near(some[k].mean, linear(k))).count();
    assert!(differing <= 40, "{differing} pixels differ");
    let lit = |pixel: &Pixel| DVec3::from(pixel.mean).length() > 0.0;
    assert!(some.iter().filter(|pixel| lit(pixel)).count() > 300);
}

#[test]
fn a_surface_whose_alpha_is_large_enough_is_opaque() {
    let opaque = world(&parts(-0.5, 0.5), &receivers(), |document| cut(document, CARD, [128, 255]));
    assert!(!opaque.geometry.is_veiled());
}
