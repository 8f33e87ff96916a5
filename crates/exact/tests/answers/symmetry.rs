//! What must not change an answer.

use glam::{DQuat, DVec3};
use twoforms_exact::{Sight, Value};

use crate::support::{Lamp, Random, Scene, Triangle, ceiling, formulas, lamp};

fn room(random: &mut Random) -> Scene {
    let square = ceiling(DVec3::new(0.1, 0.2, 1.5), 0.8, 0.6);
    let tilted: Triangle = [DVec3::new(-0.9, -0.2, 0.4), DVec3::new(-0.8, 0.5, 0.5), DVec3::new(-0.6, 0.1, 1.2)];
    let lamps = vec![
        Lamp { triangles: square, radiance: [3.0, 2.0, 1.0], two_sided: false },
        Lamp { triangles: vec![tilted], radiance: [0.5, 4.0, 2.0], two_sided: true },
    ];
    let blockers = (0..6).map(|_| {
        let centre = DVec3::new(0.0, 0.0, 0.8) + random.point(0.4);
        [0, 1, 2].map(|_| centre + random.point(0.3))
    });
    Scene { lamps, blockers: blockers.collect() }
}

fn agree(one: &Sight, other: &Sight, tolerance: f64, what: &str) {
    let (a, b) = (one.irradiance(), other.irradiance());
    assert!((a.luminance - b.luminance).abs() <= tolerance * a.luminance, "{what}: {a:?} {b:?}");
    for strategy in formulas() {
        // The bilinear cosine over a light depends on how it is cut.
        if what == "cut" && strategy.to_string().contains("bilinear") {
            continue;
        }
        let (a, b) = (one.variance(strategy).unwrap(), other.variance(strategy).unwrap());
        let bound = |value: &Value| if value.luminance > 0.0 { value.error_bound / value.luminance } else { 0.0 };
        let tolerance = tolerance.max(2.0 * (bound(&a) + bound(&b)));
        for (a, b) in a.rgb.iter().zip(b.rgb).chain([(&a.luminance, b.luminance)]) {
            assert!((a - b).abs() <= tolerance * a.abs() + 1e-24, "{what}: {strategy}: {a} {b}");
        }
    }
}

#[test]
fn turning_the_scene() {
    let mut random = Random::new(1);
    for _ in 0..20 {
        let scene = room(&mut random);
        let turn = DQuat::from_axis_angle(random.point(1.0).normalize(), random.between(0.0, 6.0));
        let turned = |t: &Triangle| t.map(|v| turn * v);
        let lamps =
            scene.lamps.iter().map(|l| Lamp { triangles: l.triangles.iter().map(turned).collect(), ..l.clone() });
        let rotated = Scene { lamps: lamps.collect(), blockers: scene.blockers.iter().map(turned).collect() };
        let n = DVec3::new(0.2, 0.1, 1.0);
        agree(&scene.sight(DVec3::ZERO, n), &rotated.sight(DVec3::ZERO, turn * n), 1e-9, "turned");
    }
}

#[test]
fn cutting_a_light_in_two() {
    let mut random = Random::new(2);
    for _ in 0..20 {
        let scene = room(&mut random);
        let mut cut = scene.clone();
        let [a, b, c] = scene.lamps[0].triangles[0];
        let middle = 0.5 * (b + c);
        cut.lamps[0].triangles.splice(0..1, [[a, b, middle], [a, middle, c]]);
        agree(&scene.sight(DVec3::ZERO, DVec3::Z), &cut.sight(DVec3::ZERO, DVec3::Z), 1e-9, "cut");
    }
}

#[test]
fn blockers_that_hide_nothing_and_hide_again() {
    let mut random = Random::new(3);
    for _ in 0..20 {
        let scene = room(&mut random);
        let mut more = scene.clone();
        more.blockers.push([DVec3::new(0.0, 0.0, 3.0), DVec3::new(1.0, 0.0, 3.0), DVec3::new(0.0, 1.0, 2.5)]);
        more.blockers.push([DVec3::new(0.0, 0.0, -0.1), DVec3::new(1.0, 0.0, -0.2), DVec3::new(0.0, 1.0, -0.3)]);
        more.blockers.push(scene.blockers[0]);
        more.blockers.push(scene.blockers[1].map(|v| v * 0.5));
        agree(&scene.sight(DVec3::ZERO, DVec3::Z), &more.sight(DVec3::ZERO, DVec3::Z), 1e-9, "hidden");
    }
}

#[test]
fn blockers_cut_in_two() {
    let mut random = Random::new(4);
    for _ in 0..20 {
        let scene = room(&mut random);
        let halves = |t: &Triangle| [[t[0], t[1], 0.5 * (t[1] + t[2])], [t[0], 0.5 * (t[1] + t[2]), t[2]]];
        let cut = Scene { blockers: scene.blockers.iter().flat_map(halves).collect(), ..scene.clone() };
        agree(&scene.sight(DVec3::ZERO, DVec3::Z), &cut.sight(DVec3::ZERO, DVec3::Z), 1e-9, "blockers cut");
    }
}

/// Radiance scales E, its square scales V; an equal lamp seen whole has no variance in projected
/// solid angle at all.
#[test]
fn radiance_scales() {
    let triangles = ceiling(DVec3::new(0.3, 0.1, 1.0), 0.7, 0.4);
    let one = Scene::of(vec![lamp(triangles.clone(), 1.0)]).sight(DVec3::ZERO, DVec3::new(0.1, 0.3, 1.0));
    let seven = Scene::of(vec![lamp(triangles, 7.0)]).sight(DVec3::ZERO, DVec3::new(0.1, 0.3, 1.0));
    for (strategy, value) in one.variances(&formulas()) {
        let (a, b) = (value.unwrap().luminance, seven.variance(strategy).unwrap().luminance);
        assert!((49.0 * a - b).abs() <= 1e-12 * b, "{strategy}: {a} {b}");
        if strategy.to_string().contains("projected") {
            assert_eq!([a, b], [0.0, 0.0]);
        }
    }
}

#[test]
fn toward_lights_is_area() {
    let sight = room(&mut Random::new(5)).sight(DVec3::ZERO, DVec3::Z);
    for selection in ["", "@uniform", "@power", "@contribution"] {
        let value = |name: &str| sight.variance(format!("{name}{selection}").parse().unwrap()).unwrap();
        assert_eq!(value("hemisphere/toward-lights"), value("area/uniform"));
    }
    assert_eq!(sight.variance("mixture/0".parse().unwrap()), sight.variance("area/uniform".parse().unwrap()));
    assert_eq!(sight.variance("mixture/1".parse().unwrap()), sight.variance("hemisphere/cosine".parse().unwrap()));
}
