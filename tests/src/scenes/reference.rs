//! Answers held against numbers from elsewhere: printed values, and cases computed by two other
//! methods (planar booleans at 34 digits, and an azimuth sweep) that agree with each other.

use glam::{DVec3, Quat, Vec3};

use super::answer::{Answer, answer};
use super::moments::SphericalPolygon;
use super::receiver::toward;
use super::sight::Sight;
use super::view::{closed_form, cubature};
use super::{Material, Part, Receiver, Scene, all};

/// Irradiance, then the variances of hemisphere/uniform, hemisphere/cosine and area/uniform.
const COLUMNS: [&str; 3] = ["hemisphere/uniform", "hemisphere/cosine", "area/uniform"];

/// Fails unless all four numbers agree, variances relative to E[w²].
fn assert_near(name: &str, answer: &Answer, expected: [f64; 4], tolerance: f64) {
    let [e, variances @ ..] = expected;
    let found = answer.irradiance[0];
    assert!((found - e).abs() <= tolerance * e, "{name}: E = {found}, not {e}");
    for (strategy, v) in COLUMNS.into_iter().zip(variances) {
        let [found, ..] = answer.variance(strategy).expect("a listed strategy");
        assert!((found - v).abs() <= tolerance * (v + e * e), "{name} {strategy}: {found}, not {v}");
    }
}

fn scene(name: &str) -> Scene {
    all().into_iter().find(|scene| scene.name == name).expect("a scene of that name")
}

fn receiver_at(position: [f32; 3], normal: [f32; 3]) -> Receiver {
    Receiver::new("x", position, toward(Vec3::from(normal).as_dvec3()))
}

fn rectangle(corners: [[f32; 2]; 2], z: f32) -> Vec<Vec3> {
    let [[x0, y0], [x1, y1]] = corners;
    [[x0, y0], [x0, y1], [x1, y1], [x1, y0]].map(|[x, y]| Vec3::new(x, y, z)).to_vec()
}

fn light(radiance: f32, polygon: Vec<Vec3>) -> Part {
    Part::new("light", Material::emitting([radiance; 3]), vec![polygon])
}

fn card(polygon: [[f32; 3]; 3]) -> Part {
    Part::new("card", Material::diffuse([0.5; 3]), vec![polygon.map(Vec3::from).to_vec()])
}

const UP_Z: [f32; 3] = [0.0, 0.0, 1.0];
const UNIT: [[f32; 2]; 2] = [[-0.5, -0.5], [0.5, 0.5]];

#[test]
fn centred_square_at_eight_heights() {
    let rows = [
        (0.05, [3.116_100_618, 3.439_642_371, 0.079_435_746_61, 409.168_690_9]),
        (0.1, [3.042_128_438, 3.829_845_622, 0.302_582_897_7, 95.461_563_36]),
        (0.25, [2.610_753_031, 5.420_501_748, 1.385_891_154, 9.852_291_903]),
        (0.5, [1.740_839_503, 6.192_766_975, 2.438_486_419, 0.773_667_12]),
        (1.0, [0.752_274_688_5, 3.857_081_27, 1.797_423_428, 0.017_178_141_32]),
        (2.0, [0.230_836_797_7, 1.369_028_28, 0.671_909_560_7, 1.323_733_726e-4]),
        (5.0, [0.039_474_025_28, 0.245_647_728_1, 0.122_453_109_2, 1.087_366_347e-7]),
        (10.0, [0.009_966_782_906, 0.062_471_781_54, 0.031_212_235_2, 4.394_049_668e-10]),
    ];
    for (h, expected) in rows {
        let answer = answer(&[light(1.0, rectangle(UNIT, h))], &receiver_at([0.0; 3], UP_Z));
        assert_near(&format!("h = {h}"), &answer, expected, 2e-7);
        let [area, ..] = answer.variance("area/uniform").expect("a listed strategy");
        assert!((area / expected[3] - 1.0).abs() < 2e-6, "h = {h}: V = {area}");
    }
}

#[test]
fn cornell_box_in_shadow_and_light() {
    let cases = [
        (
            [278.0, 0.0, 20.0],
            [0.419_797_245_034_280_4, 37.135_094_837_601_18, 20.397_549_055_708_193, 0.024_860_605_530_447_36],
        ),
        (
            [250.0, 0.0, 30.0],
            [0.245_140_143_691_309_54, 22.119_362_362_920_207, 11.953_942_006_253_27, 0.065_839_769_324_932_66],
        ),
        (
            [265.0, 0.0, 420.0],
            [0.345_047_083_118_077_2, 32.648_346_377_048_71, 16.791_302_074_818_76, 0.096_110_069_335_489_23],
        ),
        (
            [186.0, 165.0, 168.0],
            [1.089_217_137_803_926_1, 98.481_414_696_348_51, 52.194_881_641_363_615, 0.015_187_711_297_712_57],
        ),
        (
            [200.0, 0.0, 500.0],
            [0.491_346_076_130_330_2, 44.059_141_413_049_03, 23.838_883_503_314_495, 0.007_857_555_066_763_944],
        ),
    ];
    let mut parts = scene("cornell-box").parts;
    let light = parts.iter_mut().find(|part| part.material.emits()).expect("a light");
    light.material = Material::emitting([15.6; 3]);
    for (millimetres, expected) in cases {
        let position = millimetres.map(|v: f64| (v * 1e-3) as f32);
        let answer = answer(&parts, &Receiver::new("x", position, Quat::IDENTITY));
        assert_near(&format!("{millimetres:?}"), &answer, expected, 1e-12);
    }
}

#[test]
fn card_that_hides_half() {
    let scene = scene("square-light");
    let (_, answer) = scene.answers().find(|(x, _)| x.name == "half-hidden").expect("a receiver");
    let expected =
        [0.115_418_398_865_085_38, 0.697_835_546_811_886_3, 0.349_276_187_167_068_8, 0.013_387_593_482_890_448];
    assert_near("half-hidden", &answer, expected, 1e-13);
}

/// Also by the strategies that pick a light first.
#[test]
fn two_lights_and_a_triangle() {
    let parts = [
        light(2.0, rectangle([[-1.25, -0.25], [-0.75, 0.25]], 1.0)),
        light(5.0, rectangle([[0.5, -0.5], [1.5, 0.5]], 2.0)),
        card([[-0.7, -0.3, 0.6], [-0.2, 0.5, 0.7], [0.1, -0.4, 0.5]]),
    ];
    let answer = answer(&parts, &receiver_at([0.0; 3], UP_Z));
    let expected = [0.879_087_714_533_426_6, 21.995_216_401_513_193, 12.082_089_719_277_889, 0.084_715_285_858_628_31];
    assert_near("two lights", &answer, expected, 1e-12);
    let picked = [("area/uniform@uniform", 0.521_428_770_575_690_9), ("area/uniform@power", 0.067_386_120_349_064_55)];
    for (strategy, expected) in picked {
        let [found, ..] = answer.variance(strategy).expect("a listed strategy");
        assert!((found / expected - 1.0).abs() < 1e-10, "{strategy}: {found}");
    }
}

/// A light that hides another; a light that emits from both sides, partly below the horizon.
#[test]
fn lights_that_hide_and_lights_below_the_horizon() {
    let stacked = [light(1.0, rectangle(UNIT, 1.0)), light(1.0, rectangle([[-1.0, -1.0], [1.0, 1.0]], 2.0))];
    let found = answer(&stacked, &receiver_at([0.0; 3], UP_Z));
    let expected = [0.752_274_688_454_107_4, 3.857_081_269_981_968_3, 1.797_423_427_840_249_9, 2.349_559_534_145_096_3];
    assert_near("stacked", &found, expected, 1e-12);

    let mut large = light(0.5, rectangle([[-3.0, -1.5], [0.0, 1.5]], 1.5));
    large.material = large.material.double_sided();
    let small = light(20.0, rectangle([[0.875, -0.125], [1.125, 0.125]], 0.75));
    let card = card([[0.75, -0.25, 0.25], [1.0, 0.25, 0.25], [0.625, 0.125, 0.375]]);
    let found = answer(&[small, large, card], &receiver_at([0.5, 0.25, 0.0], [0.5, 0.0, 1.0]));
    let expected = [0.535_525_484_552_399_8, 44.916_080_889_015_61, 23.012_488_544_946_97, 65.757_772_062_354_45];
    assert_near("unlike", &found, expected, 2e-7);
}

/// Product rules are left out where a piece is more than four times longer than it is far: they
/// converge slowly there, and the heights above cover it.
#[test]
fn edge_sums_and_cubature_agree_on_what_the_receivers_see() {
    let mut compared = 0;
    for scene in all() {
        for receiver in &scene.receivers {
            for sight in sights(&scene, receiver) {
                let pieces = sight.pieces.iter().filter(|piece| length(piece) < 4.0 * sight.s);
                for piece in pieces {
                    let name = format!("{} {}", scene.name, receiver.name);
                    assert_both_ways_agree(&name, piece, receiver.n_x(), &sight);
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 100, "{compared} pieces");
}

fn length(polygon: &[DVec3]) -> f64 {
    let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
    edges.map(|(&v, &w)| v.distance(w)).fold(0.0, f64::max)
}

fn sights(scene: &Scene, receiver: &Receiver) -> Vec<Sight> {
    let (x, n) = (receiver.x(), receiver.n_x());
    let lights = scene.parts.iter().filter(|part| part.material.emits());
    let sights =
        lights.flat_map(|light| light.triangles().filter_map(move |t| Sight::new(x, n, t, light, &scene.parts)));
    sights.collect()
}

fn assert_both_ways_agree(name: &str, piece: &[DVec3], n: DVec3, sight: &Sight) {
    let polygon = SphericalPolygon::new(piece, n, sight.m);
    let by_edges = closed_form(&polygon, sight.s);
    for (edges, area) in by_edges.into_iter().zip(cubature(piece, n, sight.m)) {
        assert!((edges / area - 1.0).abs() < 1e-10, "{name}: {edges} by edges, {area} by area");
    }
}
