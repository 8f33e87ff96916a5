//! Jittered sampling against its definition and against chance.

use glam::DVec3;
use twoforms_exact::{Error, Sight, variance_of_jittered};

use crate::support::{Lamp, Random, Scene, Triangle, ceiling, lamp};

/// V_N = (E[w²] − Σ E_k²/N)/N with E_k = N times the irradiance from the stratum, of a square cut by hand.
#[test]
fn a_square_in_sixteen() {
    let n = 4;
    let x = DVec3::new(0.2, -0.1, 0.0);
    let card: Triangle = [DVec3::new(-0.1, -0.3, 0.5), DVec3::new(0.4, -0.2, 0.4), DVec3::new(0.1, 0.4, 0.6)];
    let scene = |triangles| Scene { lamps: vec![lamp(triangles, 2.0)], blockers: vec![card] };
    let whole = scene(ceiling(DVec3::Z, 1.0, 1.0));
    let (facing, lights) = whole.facing(x, DVec3::Z, true);
    let sight = Sight::new(&facing, &lights).unwrap();
    let e = sight.irradiance().luminance;
    let second = sight.variance("area/uniform".parse().unwrap()).unwrap().luminance + e * e;
    let mut squares = 0.0;
    for i in 0..n {
        for j in 0..n {
            let step = |k: i32| (f64::from(k) + 0.5) / f64::from(n) - 0.5;
            let part = scene(ceiling(DVec3::new(step(i), step(j), 1.0), 0.25, 0.25));
            squares += (16.0 * part.sight(x, DVec3::Z).irradiance().luminance).powi(2);
        }
    }
    let known = (second - squares / 16.0) / 16.0;
    let value = variance_of_jittered(&facing, &lights, 4).unwrap();
    assert!((value.luminance - known).abs() <= 1e-11 * known, "{value:?}, known {known}");
    let one = variance_of_jittered(&facing, &lights, 1).unwrap().luminance;
    assert!((one - (second - e * e)).abs() <= 1e-12 * one);
}

/// A triangle and a square, 3 × 3 strata, 20 000 estimates without occlusion; level 5.5 σ.
#[test]
fn strata_across_targets() {
    let tilted: Triangle = [DVec3::new(0.2, 0.1, 1.1), DVec3::new(0.5, 0.9, 1.2), DVec3::new(1.1, 0.3, 0.9)];
    let two = Lamp { triangles: vec![tilted], radiance: [3.0; 3], two_sided: true };
    let scene = Scene::of(vec![two, lamp(ceiling(DVec3::new(-0.6, -0.2, 0.8), 0.5, 0.4), 1.0)]);
    let (facing, lights) = scene.facing(DVec3::ZERO, DVec3::Z, true);
    let total: f64 = lights.iter().map(|light| light.area).sum();
    let value = |u: f64, v: f64| {
        let target = usize::from(u * total >= facing[0].area);
        let u = (u * total - if target == 1 { facing[0].area } else { 0.0 }) / facing[target].area;
        let c = &facing[target].corners;
        let y = match target {
            0 => c[0] + u.sqrt() * ((c[1] - c[0]) + v * (c[2] - c[1])),
            _ => c[0] + u * (c[1] - c[0]) + v * (c[3] - c[0]),
        };
        let normal = (c[1] - c[0]).cross(c[2] - c[0]).normalize();
        facing[target].radiance[0] * total * y.z * normal.dot(y).abs() / y.length_squared().powi(2)
    };
    let mut random = Random::new(77);
    let count = 20_000;
    let estimates: Vec<f64> = (0..count)
        .map(|_| {
            let cell = |k: i32, random: &mut Random| (f64::from(k) + random.unit()) / 3.0;
            let values = (0..9).map(|k| value(cell(k / 3, &mut random), cell(k % 3, &mut random)));
            values.sum::<f64>() / 9.0
        })
        .collect();
    let n = f64::from(count);
    let mean = estimates.iter().sum::<f64>() / n;
    let moment = |k: i32| estimates.iter().map(|e| (e - mean).powi(k)).sum::<f64>() / n;
    let (second, fourth) = (moment(2), moment(4));
    let known = variance_of_jittered(&facing, &lights, 3).unwrap().luminance;
    let z = (second - known) / ((fourth - second * second) / n).sqrt();
    assert!(z.abs() < 5.5, "measured {second}, exact {known}, z {z}");
}

#[test]
fn targets_that_are_not_listed() {
    let scene = Scene::of(vec![lamp(ceiling(DVec3::Z, 1.0, 1.0), 1.0), lamp(ceiling(DVec3::Z * 2.0, 1.0, 1.0), 1.0)]);
    let (facing, lights) = scene.facing(DVec3::ZERO, DVec3::Z, true);
    let refused = variance_of_jittered(&facing[..1], &lights, 2);
    assert_eq!(refused, Err(Error::Unlisted { listed: 1.0, total: 2.0 }));
}
