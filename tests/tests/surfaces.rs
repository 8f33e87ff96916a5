//! Surfaces with highlights: f_r is glTF's, its own density is one, and all that estimates radiance agrees with exact light.

use glam::{DVec3, Quat, Vec3};
use rand_philox::splitmix64;
use rayon::prelude::*;
use twoforms_comparison::exactly::{self, Bounded};
use twoforms_comparison::image::{Crop, PixelFilter, Rendering, Shown};
use twoforms_comparison::place::{Place, Quantity, Reflection};
use twoforms_comparison::viewpoint;
use twoforms_comparison::world::World;
use twoforms_estimator::density::{BrdfOfSurface, Density, Ready};
use twoforms_estimator::estimate::Estimate;
use twoforms_estimator::glossy::{Glossy, Makeup, MetallicRoughness};
use twoforms_estimator::measure::Sample;
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::{Sampler, Stream};
use twoforms_estimator::secondary::secondary_by;
use twoforms_estimator::selection::Selection;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::xi::{Draws, Key};
use twoforms_geometry::lanes::Instructions;
use twoforms_geometry::view::{Effort, View};
use twoforms_tests::built::{block, ceiling, world};
use twoforms_tests::domain::{Domain, HemisphereCells, chi_square, value};
use twoforms_tests::ggx;
use twoforms_tests::samples::{Samples, moments};
use twoforms_tests::scenes::{Material, Part, Receiver};
use twoforms_tests::statistics::{Family, Outcome, ZTest};
use twoforms_tests::worlds;

const SEED: u64 = 20_261_122;
const LEVEL: f64 = 1e-3;
/// What binary32 arithmetic may add to a mean, as a share of it.
const BUDGET: f64 = 3e-6;

const GOLD: Makeup = Makeup { base: [1.0, 0.75, 0.25], metallic: 1.0, roughness: 0.375, specular: 1.0, f_0: [0.04; 3] };
const PLASTIC: Makeup =
    Makeup { base: [0.25, 0.5, 0.125], metallic: 0.0, roughness: 0.25, specular: 1.0, f_0: [0.04; 3] };
const ENAMEL: Makeup =
    Makeup { base: [0.5, 0.375, 0.75], metallic: 0.5, roughness: 0.75, specular: 0.5, f_0: [0.08, 0.02, 0.04] };
const WHITE: Makeup = Makeup { base: [1.0; 3], metallic: 1.0, roughness: 0.5, specular: 1.0, f_0: [0.04; 3] };

/// Uniform numbers in [0, 1).
fn uniform(index: u64) -> f64 {
    splitmix64(SEED ^ splitmix64(index)) as f64 / 18_446_744_073_709_551_616.0
}

/// A direction at this cosθ and azimuth in turns.
fn toward(cos: f64, turns: f64) -> DVec3 {
    let (sin_phi, cos_phi) = libm::sincos(std::f64::consts::TAU * turns);
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    DVec3::new(sin * cos_phi, sin * sin_phi, cos)
}

fn close(found: f64, expected: f64, relative: f64) -> bool {
    (found - expected).abs() <= relative * expected.abs()
}

#[test]
fn f_r_is_gltf_s_and_reciprocal() {
    for makeup in
        [GOLD, PLASTIC, ENAMEL, WHITE, Makeup { roughness: 1.0, ..GOLD }, Makeup { roughness: 0.0625, ..ENAMEL }]
    {
        let surface = MetallicRoughness::new(&makeup);
        for k in 0..5000 {
            let u = |j: u64| uniform(4 * k + j);
            let (theta, psi) = (toward(0.01 + 0.99 * u(0), u(1)), toward(0.01 + 0.99 * u(2), u(3)));
            let (one, other) = (theta.to_array(), psi.to_array());
            let (f_r, back) = (surface.f_r(one, other), surface.f_r(other, one));
            let single = surface.f_r(one.map(|v| v as f32), other.map(|v| v as f32));
            let expected = ggx::f_r(&makeup, theta, psi);
            for c in 0..3 {
                // Factors are rounded to binary32 once.
                assert!(close(f_r[c], expected[c], 1e-6), "{makeup:?} {theta} {psi}: {f_r:?}, {expected:?}");
                assert!(close(back[c], f_r[c], 1e-12), "{makeup:?} {theta} {psi}: {f_r:?}, {back:?}");
                assert!(close(f64::from(single[c]), f_r[c], 1e-4), "{makeup:?} {theta} {psi}: {f_r:?}, {single:?}");
            }
        }
    }
}

/// A metal's density is that of the normals that Θ sees, mirrored: D_Θ / (4 Θ·H).
#[test]
fn a_metal_draws_directions_mirrored_at_visible_normals() {
    let surface = MetallicRoughness::new(&GOLD);
    for k in 0..5000 {
        let u = |j: u64| uniform(4 * k + j);
        let (theta, psi) = (toward(0.01 + 0.99 * u(0), u(1)), toward(0.01 + 0.99 * u(2), u(3)));
        let half = (theta + psi).normalize();
        let expected = ggx::visible(ggx::alpha(&GOLD), theta, half) / (4.0 * theta.dot(half));
        let found = surface.pdf(theta.to_array(), psi.to_array());
        assert!(close(found, expected, 1e-6), "{theta} {psi}: {found}, {expected}");
    }
}

/// Visible normals are a density whatever Θ and α, and a white metal reflects at most what arrives: all of it where it is
/// nearly a mirror.
#[test]
fn a_white_furnace_gives_back_no_more_than_it_has() {
    for roughness in [1.0 / 32.0, 0.25, 0.5, 0.75, 1.0] {
        let alpha = roughness * roughness;
        for cos in [0.1, 0.4, 0.7, 1.0] {
            let theta = toward(cos, 0.1);
            let whole = ggx::over_visible(alpha, theta, 600, |_, _| 1.0);
            assert!((whole - 1.0).abs() < 2e-3, "α = {alpha}, cosθ = {cos}: {whole}");
            let reflected = ggx::white_metal_reflects(alpha, theta, 600);
            let least = if alpha < 0.001 { 0.997 } else { 0.3 };
            assert!((least..1.0 + 2e-3).contains(&reflected), "α = {alpha}, cosθ = {cos}: {reflected}");
        }
    }
}

/// A floor with a highlight, a warm quad above, a cold triangle beside, and a block between.
fn room(makeup: &Makeup) -> World {
    let (half, warm, cold) = (4.0, Material::emitting([4.0, 2.5, 1.0]), Material::emitting([0.5, 1.0, 2.0]));
    let floor: Vec<Vec3> = ceiling(0.0, [-half, -half], [half, half]).into_iter().rev().collect();
    let side = vec![Vec3::new(-1.0, 0.25, -0.5), Vec3::new(-1.0, 1.25, 0.125), Vec3::new(-1.0, 0.25, 0.75)];
    let parts = [
        Part::new("floor", Material::diffuse([0.5; 3]), vec![floor]),
        Part::new("warm", warm, vec![ceiling(1.5, [-0.375, -0.25], [0.5, 0.375])]),
        Part::new("cold", cold, vec![side]),
        block("block", Vec3::new(0.125, 0.25, 0.0), Vec3::new(0.375, 0.5, 0.25), 0.0),
    ];
    let receivers = [
        Receiver::new("under", [0.0625, 0.0, 0.25], Quat::IDENTITY),
        Receiver::new("beside", [-0.5, 0.0, -0.25], Quat::IDENTITY),
        Receiver::new("mirror", [0.0, 0.0, -1.0], Quat::IDENTITY),
    ];
    world(&parts, &receivers, |document| {
        let [r, g, b] = makeup.base;
        document["materials"][0]["pbrMetallicRoughness"] = serde_json::json!({
            "baseColorFactor": [r, g, b, 1.0], "metallicFactor": makeup.metallic, "roughnessFactor": makeup.roughness,
        });
        let color = makeup.f_0.map(|f_0| f_0 / 0.04);
        let specular = serde_json::json!({"specularFactor": makeup.specular, "specularColorFactor": color});
        document["materials"][0]["extensions"] = serde_json::json!({"KHR_materials_specular": specular});
    })
}

/// The receivers of the room, asked for the radiance toward its camera.
fn places(world: &World) -> Vec<Place> {
    let eye = world.scene.cameras[0].position;
    let place = |place: Place| {
        let seen = world.surface_at(place.position, place.normal).expect("a surface under the receiver");
        let surface = world.highlight(&seen).expect("a highlight");
        let surface = Reflection::Glossy { surface, eye };
        Place { quantity: Quantity::Radiance { surface, emission: [0.0; 3] }, known: None, ..place }
    };
    twoforms_tests::built::places(world).into_iter().map(place).collect()
}

fn query<'l>(world: &'l World, place: &Place) -> Query<'l> {
    let Quantity::Radiance { surface: Reflection::Glossy { surface, eye }, .. } = place.quantity else {
        panic!("{} has a highlight", place.name)
    };
    let eye = place.frame().localize(eye).as_vec3().to_array();
    Query::glossy_radiance(&world.lights, Glossy::new(surface, eye))
}

/// Strategies that sample a surface with a highlight without bias: all but those with weights that need a constant f_r.
fn strategies() -> Vec<Strategy> {
    Strategy::all().into_iter().filter(|strategy| !strategy.is_biased() && strategy.needs_alpha().is_none()).collect()
}

/// The directions that a surface draws follow the density that it says, which they say again, and integrates to what of it
/// lies above the horizon.
#[test]
fn the_surface_s_own_density_is_what_it_draws() {
    let mut outcomes = Vec::new();
    for makeup in [GOLD, PLASTIC, ENAMEL, Makeup { roughness: 1.0, ..WHITE }] {
        let world = room(&makeup);
        for place in places(&world) {
            let view = View::new(&world.geometry, place.frame(), Effort::Gather);
            let (query, name) = (query(&world, &place), format!("{makeup:?} {}", place.name));
            let density = BrdfOfSurface::prepare(&world.lights, Selection::Together).at(&view, &query);
            let glossy = query.glossy().expect("a highlight");
            let theta = DVec3::from_array(glossy.theta::<f32>(None).to_array().map(f64::from));
            let share = glossy.surface().share(theta.to_array());
            let above = ggx::over_visible(ggx::alpha(&makeup), theta, 600, |_, psi| f64::from(u8::from(psi.z > 0.0)));
            let domain = HemisphereCells { fine: 24, mass: share * above + (1.0 - share), resolution: 4e-3 };
            let p = |patch: &twoforms_tests::domain::Patch<_>| value(&density, &view, &patch.at) * patch.measure;
            let integral: f64 = domain.patches().iter().map(p).sum();
            assert!((integral - domain.mass()).abs() < domain.resolution, "{name}: {integral}, {}", domain.mass());
            let draws = Samples::new(SEED, &place, Strategy::defaults()[0], Sampler::Independent, 50_000);
            for index in 0..draws.n {
                let (Sample { at, pdf }, some) = density.sample::<f32>(&view.from_x(), draws.xi(index)).parts();
                assert!(!some || value(&density, &view, &at) == f64::from(pdf.value()), "{name}: sample {index}");
            }
            let found = chi_square(&view, &density, &domain, &draws);
            outcomes.push(Outcome::Tested { p: found.p(), evidence: format!("{name}: {found}") });
        }
    }
    Family::new("χ² of directions against the surface's own density", LEVEL, SEED, outcomes).assert_holds(0.0);
}

/// ∫ L f_r G dA over a rectangle above x, by midpoints and the formulas of books.
fn by_midpoints(makeup: &Makeup, theta: DVec3, l: [f64; 3], [low, high]: [DVec3; 2], n: u32) -> [f64; 3] {
    let mut sum = [0.0; 3];
    let middle = |k: u32| (f64::from(k) + 0.5) / f64::from(n);
    let area = (high.x - low.x) * (high.y - low.y) / f64::from(n * n);
    for k in 0..n * n {
        let y = DVec3::new(low.x + (high.x - low.x) * middle(k / n), low.y + (high.y - low.y) * middle(k % n), low.z);
        let (r2, psi) = (y.length_squared(), y.normalize());
        let f_r = ggx::f_r(makeup, theta, psi);
        (0..3).for_each(|c| sum[c] += l[c] * f_r[c] * psi.z * psi.z / r2 * area);
    }
    sum
}

/// A level light above a floor with nothing between: exact radiance is that of midpoints.
#[test]
fn exact_radiance_is_that_of_another_rule() {
    for makeup in [GOLD, PLASTIC, ENAMEL] {
        let world = room(&makeup);
        let light =
            Part::new("light", Material::emitting([4.0, 2.5, 1.0]), vec![ceiling(1.5, [-0.375, -0.25], [0.5, 0.375])]);
        let alone = twoforms_tests::built::world(&[light], &[], |_| ());
        for place in places(&world) {
            let found = exactly::at(&alone, &place, &[]).light.irradiance.expect("exact radiance");
            // The frame's axes lie along the world's, turned; so the rectangle is one in it too.
            let frame = place.frame();
            let corners = [DVec3::new(-0.375, 1.5, -0.25), DVec3::new(0.5, 1.5, 0.375)].map(|c| frame.localize(c));
            let (low, high) = (corners[0].min(corners[1]), corners[0].max(corners[1]));
            let theta = frame.localize(world.scene.cameras[0].position).normalize();
            let expected = by_midpoints(&makeup, theta, [4.0, 2.5, 1.0], [low, high], 1500);
            for c in 0..3 {
                assert!(close(found.rgb[c], expected[c], 3e-6), "{makeup:?} {}: {found:?}, {expected:?}", place.name);
            }
        }
    }
}

/// In a closed box of radiance 1 a white metal sends back what a white furnace makes of it.
#[test]
fn a_metal_in_a_closed_furnace_reflects_what_its_albedo_says() {
    let stage = worlds::stage("furnace");
    let surface = MetallicRoughness::new(&WHITE);
    for case in stage.cases() {
        let frame = case.place.frame();
        for cos in [0.3, 0.6, 1.0] {
            let eye = frame.x() + frame.to_world(toward(cos, 0.3));
            let quantity = Quantity::Radiance { surface: Reflection::Glossy { surface, eye }, emission: [0.0; 3] };
            let place = Place { quantity, known: None, ..case.place.clone() };
            let Bounded { rgb, .. } = exactly::at(&stage.world, &place, &[]).light.irradiance.expect("exact radiance");
            let expected = ggx::white_metal_reflects(ggx::alpha(&WHITE), toward(cos, 0.3), 1000);
            assert!((rgb[0] - expected).abs() < 1e-3, "{case} cosθ = {cos}: {rgb:?}, {expected}");
        }
    }
}

/// The mean of single samples is the exact radiance, and their variance the exact one where it is known.
#[test]
fn every_strategy_finds_the_exact_radiance_with_the_exact_variance() {
    let n = 60_000;
    let outcomes = |makeup: &Makeup| {
        let world = room(makeup);
        let mut outcomes = Vec::new();
        for place in places(&world) {
            let view = View::new(&world.geometry, place.frame(), Effort::Gather);
            let exact = exactly::at(&world, &place, &strategies());
            let (query, radiance) = (query(&world, &place), exact.light.irradiance.expect("exact radiance"));
            for (strategy, of) in strategies().into_iter().zip(&exact.light.strategies) {
                let prepared = strategy.prepare(&world.lights);
                let draws = Samples::new(SEED, &place, strategy, Sampler::Independent, n);
                let drawn = draws.of(&*prepared.at(&view, &query, &exact.known()));
                let found = moments(&drawn, 1);
                let name = format!("{makeup:?} {} {strategy}", place.name);
                let variance = found.m2 / (found.n - 1.0);
                let known = of.variance_of_one.map(|variance| variance.rgb[1]);
                let sigma = (known.unwrap_or(variance) / found.n).sqrt();
                let mean =
                    ZTest { found: found.mean, expected: radiance.rgb[1], sigma, budget: BUDGET * radiance.rgb[1] };
                outcomes.push(Outcome::Tested { p: mean.p(), evidence: format!("{name}: mean {mean}") });
                let Some(expected) = known else { continue };
                let of_square = (found.m4 / found.n - (found.m2 / found.n).powi(2)).max(0.0) / found.n;
                let delta = BUDGET * radiance.rgb[1];
                let budget = (2.0 * expected.sqrt() + delta) * delta;
                let test = ZTest { found: variance, expected, sigma: of_square.sqrt(), budget };
                outcomes.push(Outcome::Tested { p: test.p(), evidence: format!("{name}: s² {test}") });
            }
        }
        outcomes
    };
    let outcomes: Vec<Outcome> = [GOLD, PLASTIC, ENAMEL].par_iter().flat_map_iter(outcomes).collect();
    assert!(outcomes.len() > 200);
    Family::new("radiance and variance of surfaces with highlights", LEVEL, SEED, outcomes).assert_holds(0.0);
}

#[test]
fn bits_do_not_depend_on_the_instructions() {
    let world = room(&ENAMEL);
    for place in places(&world) {
        let view = View::new(&world.geometry, place.frame(), Effort::Gather);
        let (query, known) = (query(&world, &place), exactly::at(&world, &place, &[]).known());
        for strategy in strategies() {
            let prepared = strategy.prepare(&world.lights);
            let estimator = prepared.at(&view, &query, &known);
            let draws = Draws { key: Key::new([SEED]), stream: [1000, 0] };
            let stream = Stream { sampler: Sampler::Independent, draws, n: 1000 };
            let by = |instructions| secondary_by(&*estimator, instructions, stream, 0..1000).expect("finite samples");
            let estimates: Vec<Estimate> = Instructions::all().into_iter().map(by).collect();
            assert!(estimates.windows(2).all(|pair| pair[0] == pair[1]), "{} {strategy}: {estimates:?}", place.name);
        }
    }
}

/// Pixels at whose centres all camera samples lie show the exact radiance there; without highlights that of the albedo.
#[test]
fn pixels_show_the_exact_radiance() {
    let (world, size, spp) = (room(&PLASTIC), [12, 8], 4096);
    let camera = world.scene.cameras[0].clone();
    let mut outcomes = Vec::new();
    for (name, quantity) in [
        ("area/uniform", Shown::Radiance),
        ("hemisphere/brdf", Shown::Radiance),
        ("mis/balance(area/uniform,hemisphere/brdf)", Shown::Radiance),
        ("area/projected-solid-angle", Shown::Radiance),
        ("hemisphere/brdf", Shown::Diffuse),
    ] {
        let rendering = Rendering {
            strategy: name.parse().expect("a strategy"),
            sampler: Sampler::Independent,
            width: size[0],
            height: size[1],
            crop: Crop { x0: 0, x1: size[0], y0: 0, y1: size[1] },
            spp,
            light_samples: 1,
            filter: PixelFilter::Point,
            cull: false,
            quantity,
            seed: SEED,
        };
        let pixels = rendering.run(&world, &camera, &|_| ()).expect("finite samples");
        for (k, pixel) in (0..).zip(&pixels) {
            let at = [k % size[0], k / size[0]].map(|c| f64::from(c) + 0.5);
            let Some(seen) = world.see(&viewpoint::ray(&camera, at, size)) else { continue };
            let lambertian = Reflection::Lambertian(world.appearance(&seen).albedo());
            let highlight = world.highlight(&seen).filter(|_| quantity == Shown::Radiance);
            let glossy = |surface| Reflection::Glossy { surface, eye: camera.position };
            let surface = highlight.map_or(lambertian, glossy);
            let quantity = Quantity::Radiance { surface, emission: world.emission(&seen) };
            let (position, normal) = (seen.position, seen.normal);
            let place = Place { name: format!("{at:?}"), position, normal, quantity, known: None };
            let Some(exact) = exactly::at(&world, &place, &[]).light.irradiance else { continue };
            let sigma = (pixel.variance[0] / f64::from(spp)).sqrt();
            let test = ZTest { found: pixel.mean[0], expected: exact.rgb[0], sigma, budget: 2e-5 * exact.rgb[0] };
            if pixel.variance[0] > 0.0 || exact.rgb[0] == 0.0 {
                outcomes.push(Outcome::Tested { p: test.p(), evidence: format!("{name} {at:?}: {test}") });
            }
        }
    }
    assert!(outcomes.len() > 200, "{}", outcomes.len());
    Family::new("pixels against exact radiance", LEVEL, SEED, outcomes).assert_holds(0.0);
}
