//! Exact light stays the same where the light does: in a mirror, turned, with a light cut in two, with a triangle added
//! that hides nothing. All scenes go through the loader.

use glam::{Quat, Vec3};
use serde_json::{Value, json};
use twoforms_comparison::exactly::with_formula;
use twoforms_comparison::exactly::{self, Bounded};
use twoforms_comparison::world::World;
use twoforms_estimator::selection::Selection;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::{Kind, Technique};
use twoforms_tests::built::{block, ceiling, places, world};
use twoforms_tests::scenes::{Material, Part, Receiver};

/// Relative difference that rounding may leave, beside the values' own bounds.
const ROUNDING: f64 = 1e-12;

const WARM: Material = Material::emitting([4.0, 2.5, 1.0]);
const COLD: Material = Material::emitting([0.5, 1.0, 2.0]);

/// A warm quad above, a cold triangle beside, and a block between, in eighths of a metre: exact in binary32.
fn parts() -> Vec<Part> {
    let cold = [Vec3::new(-1.0, 0.25, -0.5), Vec3::new(-1.0, 0.25, 0.75), Vec3::new(-1.0, 1.25, 0.125)];
    let facing_in = vec![cold[0], cold[2], cold[1]];
    vec![
        Part::new("warm", WARM, vec![ceiling(1.5, [-0.375, -0.25], [0.5, 0.375])]),
        Part::new("cold", COLD, vec![facing_in]),
        block("block", Vec3::new(0.125, 0.25, 0.0), Vec3::new(0.375, 0.5, 0.25), 0.0),
    ]
}

fn receivers() -> Vec<Receiver> {
    vec![
        Receiver::new("under", [0.0625, 0.0, 0.25], Quat::IDENTITY),
        Receiver::new("beside", [-0.5, 0.0, -0.25], Quat::IDENTITY),
        Receiver::new("far", [1.5, 0.125, 0.5], Quat::IDENTITY),
        Receiver::new("leaning", [0.75, 0.25, -0.125], Quat::from_xyzw(0.1, 0.3, 0.3, 0.9)),
    ]
}

fn near(name: &str, found: Bounded, expected: Bounded, relative: f64) {
    let pairs = found.rgb.into_iter().zip(expected.rgb).chain([(found.luminance, expected.luminance)]);
    for (found_value, expected_value) in pairs {
        let allowed = relative * expected_value.abs() + 4.0 * (found.error_bound + expected.error_bound);
        assert!((found_value - expected_value).abs() <= allowed, "{name}: {found_value} against {expected_value}");
    }
}

/// Compares every receiver of two worlds, in these strategies, whose variances may lie so far apart, as a share, beside their bounds.
fn same_light(one: &World, other: &World, strategies: &[Strategy], apart: fn(&str) -> f64) {
    for (a, b) in places(one).iter().zip(places(other)) {
        let name = &a.name;
        let (a, b) = (exactly::at(one, a, strategies).light, exactly::at(other, &b, strategies).light);
        near(name, a.irradiance.expect("irradiance"), b.irradiance.expect("irradiance"), ROUNDING);
        assert_eq!(a.strategies.len(), strategies.len());
        for (of_a, of_b) in a.strategies.iter().zip(&b.strategies) {
            let name = format!("{name} {}", of_a.strategy);
            let values = [of_a, of_b].map(|of| of.variance_of_one.expect("variance"));
            near(&name, values[0], values[1], apart(&of_a.strategy));
        }
    }
}

fn plain(parts: &[Part]) -> World {
    world(parts, &receivers(), |_| ())
}

/// Mirrors every node in the plane x = 0. A mesh is mirrored by its scale, whose determinant is negative; a receiver by
/// its place and turn, since it has a normal alone.
fn mirror(document: &mut Value) {
    for node in document["nodes"].as_array_mut().expect("nodes") {
        if node.get("mesh").is_some() {
            node["scale"] = json!([-1.0, 1.0, 1.0]);
        } else {
            node["translation"][0] = json!(-node["translation"][0].as_f64().expect("x"));
            if let Some(turn) = node.get_mut("rotation") {
                let [y, z] = [1, 2].map(|i| turn[i].as_f64().expect("a number"));
                (turn[1], turn[2]) = (json!(-y), json!(-z));
            }
        }
    }
}

/// Puts all nodes under one with this matrix, given by columns.
fn under(matrix: [[f64; 3]; 3], document: &mut Value) {
    let [x, y, z] = matrix;
    let columns = [x, y, z, [0.0; 3]].into_iter().zip([0.0, 0.0, 0.0, 1.0]).map(|(c, w)| [c[0], c[1], c[2], w]);
    let nodes = document["nodes"].as_array_mut().expect("nodes");
    let children: Vec<usize> = (0..nodes.len()).collect();
    let root = nodes.len();
    nodes.push(json!({"children": children, "matrix": columns.flatten().collect::<Vec<f64>>()}));
    document["scenes"][0]["nodes"] = json!([root]);
}

/// What binary32 bounds of the tree, which are rounded along the axes, may add: some hundred roundings.
const BY_TREE: f64 = 100.0 / (1 << 24) as f64;

/// How far apart two variances of a strategy may lie that a movement leaves as it is.
fn moved(strategy: &str) -> f64 {
    if strategy.contains("@tree") { BY_TREE } else { ROUNDING }
}

/// But for the bilinear cosine, whose map takes the sides of a light in the order in which its corners run.
#[test]
fn a_mirror_changes_nothing() {
    let mirrored = world(&parts(), &receivers(), mirror);
    let has_a_hand = |technique: Technique| technique.kind == Kind::AreaBilinearCosine;
    let one_sided = |strategy: &Strategy| strategy.techniques().into_iter().any(has_a_hand);
    let strategies: Vec<Strategy> = with_formula().into_iter().filter(|strategy| !one_sided(strategy)).collect();
    same_light(&mirrored, &plain(&parts()), &strategies, moved);
}

#[test]
fn quarter_turns_change_nothing() {
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let minus = |v: [f64; 3]| v.map(|c| 0.0 - c);
    let turns = [[minus(z), y, x], [minus(x), y, minus(z)], [y, minus(x), z], [y, z, x], [x, z, minus(y)]];
    for turn in turns {
        let turned = world(&parts(), &receivers(), |document| under(turn, document));
        same_light(&turned, &plain(&parts()), &with_formula(), moved);
    }
}

/// Whether the density of a technique over points depends on how lights of one radiance are cut into primitives.
fn depends_on_cuts(Technique { kind, selection }: Technique) -> bool {
    match (kind, selection) {
        (_, Selection::Tree | Selection::Compensated(_)) | (Kind::AreaBilinearCosine, _) => true,
        (Kind::AreaUniform | Kind::HemisphereTowardLights, _) => {
            matches!(selection, Selection::Uniform | Selection::Contribution)
        }
        (Kind::AreaSolidAngle, _) => selection != Selection::Together,
        (Kind::AreaProjectedSolidAngle, _) => matches!(selection, Selection::Uniform | Selection::Power),
        _ => false,
    }
}

fn indifferent_to_cuts() -> Vec<Strategy> {
    let depends = |strategy: &Strategy| strategy.techniques().into_iter().any(depends_on_cuts);
    with_formula().into_iter().filter(|strategy| !depends(strategy)).collect()
}

#[test]
fn a_light_cut_in_two_gives_the_same() {
    let whole = parts();
    let quad = &whole[0].polygons[0];
    let halves = [[0, 1, 2], [0, 2, 3]].map(|corners| corners.map(|i| quad[i]).to_vec());
    let [one, two] = halves.map(|half| Part::new("half", WARM, vec![half]));
    let cut = [&[one, two], &whole[1..]].concat();
    let cut = plain(&cut);
    assert_eq!(cut.scene.lights.len(), 3);
    same_light(&cut, &plain(&whole), &indifferent_to_cuts(), |_| ROUNDING);
}

/// Inside the block, above the lights, and below every receiver's horizon.
#[test]
fn a_triangle_that_hides_nothing_changes_nothing() {
    let grey = Material::diffuse([0.5; 3]);
    let triangle = |at: [f32; 3]| {
        let at = Vec3::from(at);
        vec![at, at + Vec3::new(0.0625, 0.03125, 0.0), at + Vec3::new(0.0, 0.0625, 0.0625)]
    };
    for at in [[0.125, 0.5, 0.0], [0.0, 1.75, 0.0], [0.25, -0.75, 0.25], [-1.25, 0.5, 0.0]] {
        let with = [parts(), vec![Part::new("hidden", grey, vec![triangle(at)])]].concat();
        same_light(&plain(&with), &plain(&parts()), &with_formula(), |_| ROUNDING);
    }
}
