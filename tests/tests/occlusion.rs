//! Exact light in rooms with much in the way, against directions drawn by brute force; and at receivers in awkward places.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};
use rand_philox::Philox;
use twoforms_comparison::exactly::with_formula;
use twoforms_comparison::exactly::{self, Bounded, ExactLight};
use twoforms_comparison::place::{Place, Quantity};
use twoforms_comparison::world::World;
use twoforms_estimator::moments::Moments;
use twoforms_estimator::rgb::luminance;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::Kind;
use twoforms_geometry::ray::Ray;
use twoforms_tests::built::{block, ceiling, world};
use twoforms_tests::scenes::{Material, Part};
use twoforms_tests::statistics::{Family, Outcome, ZTest};

const SEED: u64 = 20_260_813;
const LEVEL: f64 = 1e-3;
const ROOMS: u64 = 12;
const DIRECTIONS: usize = 100_000;
const GREY: Material = Material::diffuse([0.5; 3]);

/// Uniform numbers of one room.
struct Random(Philox);

impl Random {
    fn new(stream: u64) -> Self {
        Self(Philox::from_u64_seed_stream(SEED, stream))
    }

    fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.uniform() as f32
    }

    fn point(&mut self, low: [f32; 3], high: [f32; 3]) -> Vec3 {
        Vec3::from(std::array::from_fn(|i| self.between(low[i], high[i])))
    }

    /// Uniform over the hemisphere about `normal`.
    fn direction(&mut self, normal: DVec3) -> DVec3 {
        let (z, phi) = (self.uniform(), TAU * self.uniform());
        let (x_axis, y_axis) = normal.any_orthonormal_pair();
        let across = (1.0 - z * z).sqrt();
        (libm::cos(phi) * across) * x_axis + (libm::sin(phi) * across) * y_axis + z * normal
    }
}

/// A floor, two lights, slats under one of them, blocks, and cards that run through each other and through the lights.
fn room(random: &mut Random) -> World {
    let lamp = |random: &mut Random, name| {
        let [x, z] = [(); 2].map(|()| random.between(-1.0, 0.5));
        let size = [(); 2].map(|()| random.between(0.2, 0.7));
        let light = ceiling(random.between(1.4, 2.0), [x, z], [x + size[0], z + size[1]]);
        Part::new(name, Material::emitting([3.0, 2.0, 1.0]), vec![light])
    };
    let slat = |k: u8| {
        let x = -1.0 + 0.25 * f32::from(k);
        ceiling(1.2, [x, -1.0], [x + 0.125, 1.0])
    };
    let card = |random: &mut Random| (0..3).map(|_| random.point([-1.0, 0.1, -1.0], [1.0, 1.9, 1.0])).collect();
    let floor = vec![
        Vec3::new(-2.0, 0.0, -2.0),
        Vec3::new(-2.0, 0.0, 2.0),
        Vec3::new(2.0, 0.0, 2.0),
        Vec3::new(2.0, 0.0, -2.0),
    ];
    let blocks = (0..2).map(|_| {
        let (at, size) = (random.point([-0.8, 0.0, -0.8], [0.8, 0.4, 0.8]), random.point([0.1; 3], [0.5; 3]));
        block("block", at, size, random.between(0.0, 1.5))
    });
    let blocks: Vec<Part> = blocks.collect();
    let cards: Vec<Vec<Vec3>> = (0..6).map(|_| card(random)).collect();
    let parts = vec![
        lamp(random, "one"),
        Part { material: Material::emitting([0.5, 1.0, 2.0]).double_sided(), ..lamp(random, "two") },
        Part::new("floor", GREY, vec![floor]),
        Part::new("slats", GREY, (0..8).map(slat).collect()),
        Part::new("cards", GREY, cards),
    ];
    world(&[parts, blocks].concat(), &[], |_| ())
}

fn place(name: &str, position: DVec3, normal: DVec3) -> Place {
    let normal = normal.normalize();
    Place { name: name.into(), position, normal, quantity: Quantity::Irradiance, known: None }
}

/// What directions, uniform over the hemisphere, bring: f/p = 2π L cosθ.
fn by_brute_force(world: &World, place: &Place, random: &mut Random) -> Vec<f64> {
    let one = |_| {
        let psi = random.direction(place.normal);
        let seen = world.see(&Ray::new(place.position, psi));
        let l_e = seen.map_or([0.0; 3], |seen| world.emission(&seen).map(f64::from));
        TAU * luminance(l_e) * psi.dot(place.normal)
    };
    (0..DIRECTIONS).map(one).collect()
}

/// E against the mean, and E[w²] = V + E² against the mean of squares, whose own spread is measured.
fn outcomes(room: u64, world: &World, place: &Place, random: &mut Random) -> Vec<Outcome> {
    let exact = exactly::at(world, place, &[Strategy::from(Kind::HemisphereUniform)]).light;
    let e = exact.irradiance.expect("an irradiance").luminance;
    let v = exact.strategies[0].variance_of_one.expect("a variance").luminance;
    let worth = by_brute_force(world, place, random);
    let squares: Vec<f64> = worth.iter().map(|w| w * w).collect();
    let test = |name: &str, values: &[f64], expected: f64, variance: f64| {
        let name = format!("room {room} {} {name}", place.name);
        if worth.iter().filter(|w| **w != 0.0).count() < 100 {
            return Outcome::Skipped { why: format!("{name}: fewer than 100 directions meet a light") };
        }
        let sigma = (variance / values.len() as f64).sqrt();
        let test = ZTest { found: Moments::of(values).mean, expected, sigma, budget: 1e-9 * expected };
        Outcome::Tested { p: test.p(), evidence: format!("{name}: {test}") }
    };
    let spread = Moments::of(&squares).variance().expect("many");
    vec![test("E", &worth, e, v), test("E[w²]", &squares, v + e * e, spread)]
}

#[test]
fn rooms_full_of_blockers_agree_with_brute_force() {
    let in_room = |room_number: u64| {
        let mut random = Random::new(room_number);
        let world = room(&mut random);
        let places = (0..4).map(|k| {
            let at = random.point([-1.0, 0.0, -1.0], [1.0, 0.5, 1.0]).as_dvec3();
            let up = DVec3::new(random.uniform() - 0.5, 0.7, random.uniform() - 0.5);
            if k < 2 { place("floor", at * DVec3::new(1.0, 0.0, 1.0), DVec3::Y) } else { place("mid-air", at, up) }
        });
        let places: Vec<Place> = places.collect();
        places.iter().flat_map(|place| outcomes(room_number, &world, place, &mut random)).collect::<Vec<_>>()
    };
    Family::new("rooms against brute force", LEVEL, SEED, (0..ROOMS).flat_map(in_room).collect()).assert_holds(0.4);
}

/// A unit square light, 1 m above the floor and facing down, with a wall that stands on the floor at x = 1/4.
fn with_wall() -> World {
    let wall = vec![
        Vec3::new(0.25, 0.0, -1.0),
        Vec3::new(0.25, 0.0, 1.0),
        Vec3::new(0.25, 0.75, 1.0),
        Vec3::new(0.25, 0.75, -1.0),
    ];
    let parts = [
        Part::new("light", Material::emitting([1.0; 3]), vec![ceiling(1.0, [-0.5; 2], [0.5; 2])]),
        Part::new("wall", GREY, vec![wall]),
    ];
    world(&parts, &[], |_| ())
}

/// All figures are numbers with bounds, or have a reason.
fn is_sound(name: &str, exact: &ExactLight) {
    let sound = |value: Bounded| {
        let numbers = value.rgb.into_iter().chain([value.luminance]);
        numbers.into_iter().all(f64::is_finite) && value.error_bound >= 0.0 && value.error_bound.is_finite()
    };
    match exact.irradiance {
        None => assert!(exact.why.contains_key("irradiance") && exact.strategies.is_empty(), "{name}: {exact:?}"),
        Some(e) => assert!(sound(e) && e.luminance >= -e.error_bound, "{name}: {e:?}"),
    }
    for strategy in &exact.strategies {
        let stated = strategy.variance_of_one.map_or(strategy.why.is_some(), sound);
        assert!(stated, "{name} {strategy:?}");
    }
}

#[test]
fn awkward_receivers_get_their_limit_or_a_reason() {
    let world = with_wall();
    let corners =
        [[0.0, 1.0, 0.0], [0.5, 1.0, 0.5], [0.5, 1.0, 0.0], [0.25, 0.0, 0.0], [0.25, 0.75, 0.0], [0.25, 0.5, 1.0]];
    let on_diagonal = [[0.25, 1.0, 0.25], [0.25, 0.4, 0.1], [0.7, 1.0, 0.0], [0.25, 1.0, 0.0]];
    let offsets = [0.0, 1e-300, 1e-12, 1e-9, 1e-7, 1e-4];
    let axes = [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z];
    for at in corners.into_iter().chain(on_diagonal).map(DVec3::from) {
        for offset in offsets {
            for (normal, toward) in axes.iter().flat_map(|n| axes.iter().map(move |t| (*n, *t))) {
                let place = place(&format!("{at} + {offset} {toward}, {normal}"), at + offset * toward, normal);
                is_sound(&place.name, &exactly::at(&world, &place, &with_formula()).light);
            }
        }
    }
}

/// 1e-4 under the light's middle irradiance is nearly π, and the area form's variance π A L²/(3 s²), the leading term over
/// a light's interior. On the light itself it is 0: x lies in its plane, and sees none of it.
#[test]
fn near_a_light_there_is_a_limit_and_on_it_none_of_its_light() {
    let world = with_wall();
    let strategies: Vec<Strategy> =
        vec!["area/uniform".parse().expect("a name"), Strategy::from(Kind::HemisphereCosine)];
    let at = |y: f64| exactly::at(&world, &place("x", DVec3::new(0.0, y, 0.0), DVec3::Y), &strategies).light;
    let on = at(1.0);
    assert_eq!(on.irradiance.expect("E").luminance, 0.0);
    let s = 1e-4;
    let near = at(1.0 - s);
    assert!((near.irradiance.expect("E").luminance / PI - 1.0).abs() < 1e-6, "{near:?}");
    let variance = near.strategies[0].variance_of_one.expect("V").luminance;
    assert!((variance / (PI / (3.0 * s * s)) - 1.0).abs() < 1e-3, "{variance}");
}

/// In the wall's plane the wall blocks nothing: the same light as without it, to the last digits.
#[test]
fn in_a_wall_the_wall_is_not_there() {
    let light = Part::new("light", Material::emitting([1.0; 3]), vec![ceiling(1.0, [-0.5; 2], [0.5; 2])]);
    let without = world(&[light], &[], |_| ());
    for (position, normal) in [([0.25, 0.5, 0.0], [-1.0, 0.0, 0.0]), ([0.25, 0.25, 0.5], [0.0, 1.0, 0.0])] {
        let place = place("in the wall", position.into(), normal.into());
        let e = |world: &World| exactly::at(world, &place, &[]).light.irradiance.expect("E").luminance;
        assert_eq!(e(&with_wall()), e(&without));
        assert!(e(&without) > 0.0);
    }
}

/// The light through a slit falls with its width, down to a ten-millionth of the light's own.
#[test]
fn a_slit_narrows_to_nothing() {
    let slit = |width: f32| {
        let left = ceiling(0.5, [-2.0, -2.0], [-0.5 * width, 2.0]);
        let right = ceiling(0.5, [0.5 * width, -2.0], [2.0, 2.0]);
        let light = Part::new("light", Material::emitting([1.0; 3]), vec![ceiling(1.0, [-0.5; 2], [0.5; 2])]);
        world(&[light, Part::new("slit", GREY, vec![left, right])], &[], |_| ())
    };
    let at = place("under the slit", DVec3::ZERO, DVec3::Y);
    let widths: [f32; 4] = [1e-1, 1e-3, 1e-5, 1e-7];
    let light = widths
        .map(|width| exactly::at(&slit(width), &at, &[]).light.irradiance.expect("E").luminance / f64::from(width));
    // E/width tends to ∫ 2 h dA/r⁴ along the slit: within a few percent of each other, however narrow.
    for pair in light.windows(2) {
        assert!((pair[1] / pair[0] - 1.0).abs() < 0.02, "{light:?}");
    }
}
