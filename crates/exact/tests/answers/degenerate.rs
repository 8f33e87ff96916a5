//! Geometry that nobody would model on purpose: an answer or a reason, in bounded time, never a panic.

use glam::DVec3;
use twoforms_estimator::strategy::{Strategy, Weighting};
use twoforms_estimator::technique::Kind;
use twoforms_exact::{Error, Facing, Light, Sight};

use crate::support::{Lamp, Random, Scene, Triangle, ceiling, coplanar, formulas, lamp, parallelogram};

/// Which strategies are asked for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Look {
    /// All.
    Closely,
    /// Those whose integrands are smooth.
    Briefly,
}

impl Look {
    /// All in one scene of so many: what jumps takes tens of milliseconds of cubature here, and a map that the geometry leaves few
    /// digits of a second, until it is refused.
    fn of(scene: usize, many: usize) -> Self {
        if scene.is_multiple_of(many) { Self::Closely } else { Self::Briefly }
    }
}

/// Whether it is weighted by what jumps, or drawn by a map in binary64.
fn is_rough(strategy: Strategy) -> bool {
    matches!(strategy, Strategy::Mis(Weighting::Cutoff | Weighting::Maximum, _))
        || strategy.techniques().iter().any(|technique| technique.kind == Kind::AreaBilinearCosine)
}

/// Values are finite, not negative beyond their bounds, and at most what is open.
fn sane(sight: &Sight, what: &str, how: Look) {
    let (e, open) = (sight.irradiance(), sight.irradiance_unoccluded());
    assert!(e.luminance.is_finite() && e.error_bound.is_finite() && e.error_bound >= 0.0, "{what}: {e:?}");
    assert!(e.luminance >= -e.error_bound, "{what}: {e:?}");
    assert!(e.luminance <= open.luminance + e.error_bound + open.error_bound, "{what}: {e:?} of {open:?}");
    for strategy in formulas().into_iter().filter(|&strategy| how == Look::Closely || !is_rough(strategy)) {
        match sight.variance(strategy) {
            Ok(v) => {
                let bounded = v.error_bound.is_finite() && v.error_bound >= 0.0;
                assert!(v.luminance.is_finite() && bounded, "{what}: {strategy}: {v:?}");
                assert!(v.luminance >= -v.error_bound, "{what}: {strategy}: {v:?}");
            }
            Err(Error::NotConverged { .. }) => {}
            // Cubature of jumps may miss more than it knows of; its own mean tells.
            Err(Error::Inconsistent { .. }) if is_rough(strategy) => {}
            Err(other) => panic!("{what}: {strategy}: {other}"),
        }
    }
}

/// Points on a coarse grid, moved by nothing or by rounding: edges coincide, triangles touch,
/// collapse and repeat.
fn grid_point(random: &mut Random) -> DVec3 {
    let step = |random: &mut Random| (random.next() % 5) as f64 * 0.25 - 0.5;
    let nudge = [0.0, 0.0, 1e-16, 1e-12, 1e-8, 1e-4][(random.next() % 6) as usize];
    let p = DVec3::new(step(random), step(random), step(random) + 0.5);
    let moved = p + random.point(nudge);
    DVec3::from_array(moved.to_array().map(|c| f64::from(c as f32)))
}

fn overlap(lamps: &[Lamp]) -> bool {
    let all: Vec<Triangle> = lamps.iter().flat_map(|lamp| lamp.triangles.clone()).collect();
    (0..all.len()).any(|k| (0..k).any(|j| coplanar(&all[j], &all[k])))
}

#[test]
fn triangles_on_a_coarse_grid() {
    let mut random = Random::new(11);
    let mut answered = 0;
    for k in 0..3000 {
        let mut triangle = |_| [0; 3].map(|_| grid_point(&mut random));
        let lamps = (0..2).map(|j| Lamp {
            triangles: (0..2).map(&mut triangle).collect(),
            radiance: [1.0, 2.0, 3.0],
            two_sided: j == 1,
        });
        let lamps: Vec<Lamp> = lamps.collect();
        let blockers: Vec<Triangle> = (0..k % 9).map(&mut triangle).collect();
        // Emitters in one plane may overlap, and then both count.
        if overlap(&lamps) {
            continue;
        }
        let x = grid_point(&mut random) * 0.5 - DVec3::Z * [0.0, 1e-4, 0.3][k % 3];
        match (Scene { lamps, blockers }).try_sight(x, DVec3::new(0.0, [0.0, 0.2][k % 2], 1.0)) {
            Ok(sight) => {
                answered += 1;
                sane(&sight, &format!("scene {k}"), Look::of(k, 100));
            }
            Err(Error::OnLight { .. }) => {}
            Err(other) => panic!("scene {k}: {other}"),
        }
    }
    assert!(answered > 1500, "{answered}");
}

#[test]
fn receivers_close_to_the_plane_of_a_light() {
    let mut random = Random::new(12);
    for k in 0..300 {
        let height = [1e-2, 1e-4, 1e-6, 2e-8][k % 4];
        let x = DVec3::new(random.between(-0.8, 0.8), random.between(-0.8, 0.8), -height);
        let fin =
            |random: &mut Random| [DVec3::ZERO, DVec3::X, -DVec3::Z].map(|v| random.point(0.4).with_z(0.0) + 0.3 * v);
        let blockers = (0..4).map(|_| fin(&mut random)).collect();
        let scene = Scene { lamps: vec![lamp(ceiling(DVec3::ZERO, 1.0, 1.0), 1.0)], blockers };
        sane(&scene.sight(x, DVec3::Z + random.point(0.8)), &format!("receiver {k}"), Look::of(k, 25));
    }
}

#[test]
fn hundreds_of_needles() {
    let mut random = Random::new(13);
    let mut needle = |_| {
        let (a, b) = (random.point(0.7), random.point(0.7));
        [a, b, a + random.point(1e-3)].map(|v| v.with_z(0.4 + 0.3 * v.z))
    };
    let blockers: Vec<Triangle> = (0..400).map(&mut needle).collect();
    let scene = Scene { lamps: vec![lamp(ceiling(DVec3::Z, 1.0, 1.0), 1.0)], blockers };
    let sight = scene.sight(DVec3::ZERO, DVec3::Z);
    let (e, open) = (sight.irradiance(), sight.irradiance_unoccluded());
    assert!(e.luminance > 0.0 && e.luminance < open.luminance);
    assert!(e.error_bound < 1e-9 * e.luminance);
}

/// The same blocker a thousand times, and a pile of cards that share an edge.
#[test]
fn coincident_blockers() {
    let card: Triangle = [DVec3::new(-0.3, -0.3, 0.5), DVec3::new(0.3, -0.3, 0.5), DVec3::new(0.0, 0.4, 0.6)];
    let lamps = vec![lamp(ceiling(DVec3::Z, 1.0, 1.0), 1.0)];
    let once = Scene { lamps: lamps.clone(), blockers: vec![card] }.sight(DVec3::ZERO, DVec3::Z);
    let often = Scene { lamps: lamps.clone(), blockers: vec![card; 1000] }.sight(DVec3::ZERO, DVec3::Z);
    assert!((once.irradiance().luminance - often.irradiance().luminance).abs() <= once.irradiance().error_bound);
    let fan = (0..200).map(|k| [card[0], card[1], card[2] + DVec3::Y * 1e-4 * f64::from(k)]).collect();
    sane(&Scene { lamps, blockers: fan }.sight(DVec3::ZERO, DVec3::Z), "fan", Look::Closely);
}

fn square(corners: [DVec3; 4]) -> Facing {
    Facing {
        target: 7,
        light: 0,
        corners: corners.to_vec(),
        faces: true,
        area: 1.0,
        radiance: [1.0; 3],
        emitted: 1.0,
        glow: None,
        blockers: vec![],
    }
}

#[test]
fn what_has_no_answer_is_refused() {
    let light = [Light { area: 1.0, power: 1.0 }];
    let unit = [(-0.5, -0.5), (-0.5, 0.5), (0.5, 0.5), (0.5, -0.5)];
    let at = |z: f64| square(unit.map(|(x, y)| DVec3::new(x, y, z)));
    assert_eq!(Sight::new(&[at(0.0)], &light).err(), Some(Error::OnLight { target: 7 }));
    assert_eq!(Sight::new(&[at(1.0)], &[]).err(), Some(Error::NoSuchLight { target: 7, light: 0, lights: 0 }));
    assert_eq!(Sight::new(&[at(f64::NAN)], &light).err(), Some(Error::NotFinite { target: 7 }));
    let bad = [Light { area: 1.0, power: f64::NAN }];
    assert_eq!(Sight::new(&[at(1.0)], &bad).err(), Some(Error::BadLight { light: 0 }));
    let mut blocked = at(1.0);
    blocked.blockers = vec![[DVec3::X, DVec3::INFINITY, DVec3::Y]];
    assert_eq!(Sight::new(&[blocked], &light).err(), Some(Error::NotFinite { target: 7 }));
}

/// In the light's plane but beside it, nothing arrives.
#[test]
fn edge_on_lights_give_nothing() {
    let light = [Light { area: 1.0, power: 1.0 }];
    let aside = [(1.0, 0.0), (1.0, 1.0), (2.0, 1.0), (2.0, 0.0)];
    let sight = Sight::new(&[square(aside.map(|(x, y)| DVec3::new(x, y, 0.0)))], &light).unwrap();
    assert_eq!(sight.irradiance().luminance, 0.0);
    assert_eq!(sight.variance("area/uniform".parse().unwrap()).unwrap().luminance, 0.0);
}

#[test]
fn no_lights_no_light() {
    let sight = Sight::new(&[], &[]).unwrap();
    assert_eq!(sight.irradiance().luminance, 0.0);
    for (strategy, value) in sight.variances(&formulas()) {
        assert_eq!(value.unwrap().luminance, 0.0, "{strategy}");
    }
}

/// Triangles so small, far and near the horizon that their edge sums keep no digit, nor their sign.
#[test]
fn specks_at_the_horizon() {
    let mut random = Random::new(23);
    for k in 0..4000 {
        let size = 10.0_f64.powf(random.between(-9.0, -3.0));
        let height = size * 10.0_f64.powf(random.between(-6.0, 0.0));
        let at = DVec3::new(random.between(1.0, 20.0), random.between(-20.0, 20.0), height);
        let corner =
            |random: &mut Random| at + random.point(size) * DVec3::new(1.0, 1.0, random.unit() * height / size);
        let specks = (0..3).map(|_| [0; 3].map(|_| corner(&mut random))).collect();
        let scene = Scene::of(vec![Lamp { triangles: specks, radiance: [1.0, 10.0, 0.1], two_sided: true }]);
        if let Ok(sight) = scene.try_sight(DVec3::ZERO, DVec3::Z) {
            sane(&sight, &format!("speck {k}"), Look::of(k, 100));
        }
    }
}

/// Inside a box that emits everywhere no direction misses: what is left of 1 is rounding, of either sign.
#[test]
fn all_round() {
    let mut random = Random::new(24);
    let size = DVec3::new(1.0, 0.75, 0.5);
    let sides = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| {
        let (u, v) = axis.any_orthonormal_pair();
        let [u, v] = [u, v].map(|side| side * side.abs().dot(size));
        let wall = |corner: DVec3, u: DVec3, v: DVec3| parallelogram(corner - u - v, 2.0 * u, 2.0 * v);
        let at = axis * axis.dot(size);
        [wall(-at, u, v), wall(at, v, u)]
    });
    let scene = Scene::of(vec![lamp(sides.flatten().collect(), 1.0)]);
    for k in 0..60 {
        let x = (random.point(1.0) * size) * if k % 2 == 0 { DVec3::ONE } else { DVec3::new(1.0, 1.0, 0.99) };
        let sight = scene.sight(x, random.point(1.0));
        assert!((sight.irradiance().luminance - std::f64::consts::PI).abs() < 1e-12, "{k}: {:?}", sight.irradiance());
        sane(&sight, &format!("place {k}"), Look::of(k, 25));
    }
}
