//! Picking what the cosine leaves of each light: right wherever it is defined, and better where one light fills the sky.

use glam::{Quat, Vec3};
use twoforms_comparison::exactly;
use twoforms_comparison::place::{Place, Quantity, Reflection};
use twoforms_comparison::world::World;
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_geometry::view::{Effort, View};
use twoforms_tests::built::{ceiling, places, world};
use twoforms_tests::samples::{Samples, moments};
use twoforms_tests::scenes::{Material, Part, Receiver};
use twoforms_tests::statistics::{Family, Outcome, ZTest};
use twoforms_tests::worlds;

const SEED: u64 = 20_261_124;
const LEVEL: f64 = 1e-3;
const N: u32 = 200_000;

fn team(weighting: &str, density: &str, selection: &str, samples: [u32; 2]) -> Strategy {
    let [n, n_c] = samples;
    format!("mis/{weighting}({density}@{selection}:{n},hemisphere/cosine:{n_c})").parse().expect("a strategy")
}

fn variance(world: &World, place: &Place, strategy: Strategy) -> f64 {
    exactly::at(world, place, &[strategy]).light.strategies[0].variance_of_one.expect("a variance").luminance
}

/// A ceiling that fills the sky gives three fifths of the light; the cosine finds it anyway.
#[test]
fn the_balance_heuristic_gains_where_a_dim_light_fills_the_sky() {
    let stage = worlds::stage("lamp-and-ceiling");
    for (density, least) in [("area/uniform", 3.0), ("area/solid-angle", 4.0), ("area/projected-solid-angle", 4.0)] {
        let of = |receiver: &str, selection: &str| {
            variance(&stage.world, &stage.case(receiver).place, team("balance", density, selection, [1, 1]))
        };
        let gain = of("below", "contribution") / of("below", "compensated");
        assert!(gain > least, "{density} below: {gain} times lower");
        for receiver in ["aside", "edge"] {
            let [plain, compensated] = ["contribution", "compensated"].map(|selection| of(receiver, selection));
            assert!(compensated < plain, "{density} {receiver}: {compensated} against {plain}");
        }
    }
}

/// Two ceilings, one right above the other, and a lamp of no account: all that the lights give is what the cosine gives, so no
/// light is picked.
fn stacked() -> World {
    let of = |name, l: f32, y, [low, high]: [f32; 2]| {
        Part::new(name, Material::emitting([l, 0.5 * l, 2.0 * l]), vec![ceiling(y, [low; 2], [high; 2])])
    };
    let parts = [
        of("lower", 1.0, 1.0, [-8.0, 8.0]),
        of("upper", 1.0, 1.25, [-8.0, 8.0]),
        of("lamp", 0.25, 0.75, [-0.0625, 0.0625]),
    ];
    let tilted = Quat::from_rotation_x(0.25);
    let receivers =
        [Receiver::new("below", [0.25, 0.0, 0.125], Quat::IDENTITY), Receiver::new("tilted", [-0.5, 0.5, 0.5], tilted)];
    world(&parts, &receivers, |_| ())
}

/// Mean and variance of samples against exact light, by every weighting that has one.
fn outcomes(world: &World, place: &Place, strategy: Strategy) -> Vec<Outcome> {
    let exact = exactly::at(world, place, &[strategy]);
    let view = View::new(&world.geometry, place.frame(), Effort::Gather);
    let query = match place.quantity {
        Quantity::Radiance { surface: Reflection::Lambertian(albedo), .. } => Query::radiance(&world.lights, albedo),
        _ => Query::irradiance(&world.lights),
    };
    let prepared = strategy.prepare(&world.lights);
    let samples = Samples::new(SEED, place, strategy, Sampler::Independent, N);
    let found = moments(&samples.of(&*prepared.at(&view, &query, &exact.known())), 0);
    let (n, v) = (f64::from(N), found.m2 / f64::from(N));
    let e = exact.light.irradiance.expect("an irradiance").rgb[0];
    let known = exact.light.strategies[0].variance_of_one.expect("a variance");
    let relative = if known.luminance > 0.0 { known.error_bound / known.luminance } else { 0.0 };
    let expected = known.rgb[0].max(0.0);
    let sigma = (expected / n).sqrt();
    let mean = ZTest { found: found.mean, expected: e, sigma, budget: 3e-6 * e };
    let sigma = ((found.m4 / n - v * v) / n).max(0.0).sqrt();
    let delta = 3e-6 * e;
    let budget = (2.0 * expected.sqrt() + delta) * delta + relative * expected;
    let spread = ZTest { found: v, expected, sigma, budget };
    let name = format!("{} {strategy}", place.name);
    [("mean", mean), ("variance", spread)]
        .map(|(what, test)| Outcome::Tested { p: test.p(), evidence: format!("{name} {what}: {test}") })
        .into()
}

#[test]
fn where_the_cosine_gives_enough_of_every_light_it_is_alone() {
    let world = stacked();
    let mut found = Vec::new();
    for place in places(&world) {
        for weighting in ["balance", "power", "optimal"] {
            for density in ["area/uniform", "area/projected-solid-angle", "hemisphere/toward-lights"] {
                for samples in [[1, 1], [1, 3], [3, 1]] {
                    found.extend(outcomes(&world, &place, team(weighting, density, "compensated", samples)));
                }
            }
        }
    }
    Family::new("teams that compensate below two ceilings", LEVEL, SEED, found).assert_holds(0.0);
}

/// What a coloured surface reflects of each light is not what the light is picked by.
#[test]
fn lights_are_picked_by_what_they_give_whatever_the_surface() {
    let stage = worlds::stage("two-lights");
    let quantity = Quantity::Radiance { surface: Reflection::Lambertian([0.95, 0.02, 0.02]), emission: [0.0; 3] };
    let place = Place { quantity, ..stage.case("both").place };
    let names = ["area/uniform@contribution", "area/uniform@power", "area/uniform@uniform", "area/luminance"];
    let alone = names.iter().map(|name| name.parse().expect("a strategy"));
    let strategies = alone.chain([team("balance", "area/solid-angle", "compensated", [1, 1])]);
    let found = strategies.flat_map(|strategy| outcomes(&stage.world, &place, strategy)).collect();
    Family::new("picking before a coloured surface", LEVEL, SEED, found).assert_holds(0.0);
}

/// A lamp that the horizon cuts: on it no technique of the team draws, and nothing arrives.
#[test]
fn a_light_cut_by_the_horizon_has_its_variance() {
    let stage = worlds::stage("two-lights");
    let toward = Vec3::new(-1.0, 2.2, 0.0).normalize().as_dvec3();
    let place = Place { position: glam::DVec3::new(-0.7, 1.0, 0.0), normal: toward, ..stage.case("both").place };
    let e = exactly::at(&stage.world, &place, &[]).light.irradiance.expect("an irradiance").luminance;
    for weighting in ["balance", "power", "optimal", "cutoff", "maximum"] {
        for selection in ["contribution", "compensated"] {
            let strategy = team(weighting, "area/projected-solid-angle", selection, [1, 1]);
            let exact = exactly::at(&stage.world, &place, &[strategy]).light.strategies[0].variance_of_one;
            let value = exact.expect("a variance");
            assert!(value.error_bound.is_finite() && value.luminance.abs() < e * e, "{strategy}: {value:?}");
        }
    }
}
