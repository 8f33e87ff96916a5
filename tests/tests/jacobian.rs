//! The density sets the variance, not the formulation: the same points through both formulations are worth the same.

use rayon::prelude::*;
use twoforms_estimator::density::{AreaOnLights, Density, Ready};
use twoforms_estimator::formulation::{Area, Formulation, Hemisphere};
use twoforms_estimator::measure::{Aim, Sample};
use twoforms_estimator::query::Query;
use twoforms_estimator::rgb::Rgb;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::selection::Selection;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::Kind;
use twoforms_geometry::segment::Segment;
use twoforms_geometry::view::{Effort, View};
use twoforms_tests::samples::{Samples, samples};
use twoforms_tests::worlds::{self, Case};

const SEED: u64 = 20_260_802;
const N: u32 = 50_000;
/// Unit roundoff of binary32.
const U: f64 = 1.0 / 16_777_216.0;
/// Roundings between the two ways to write one number: the Jacobian there and back, a reciprocal, four products, and
/// those in what they share.
const ROUNDINGS: f64 = 10.0;

/// What one point is worth through the area and through the hemisphere formulation, RGB.
type Worth = [[f32; 3]; 2];

/// Pairs of samples that should be the same, and how far they are.
#[derive(Clone, Copy, Debug, Default)]
struct Comparison {
    pairs: u64,
    /// Pairs of which one is zero: V and vp disagree.
    one_sided: u64,
    /// Largest relative difference of the others.
    worst: f64,
}

impl Comparison {
    fn of(pairs: impl IntoIterator<Item = Worth>) -> Self {
        pairs.into_iter().fold(Self::default(), |sum, [area, hemisphere]| {
            let one_sided = (area == [0.0; 3]) != (hemisphere == [0.0; 3]);
            let both = (0..3).filter(|&c| !one_sided && area[c] != 0.0);
            let apart = both.map(|c| (f64::from(hemisphere[c]) / f64::from(area[c]) - 1.0).abs()).fold(0.0, f64::max);
            Self { pairs: sum.pairs + 1, one_sided: sum.one_sided + u64::from(one_sided), worst: sum.worst.max(apart) }
        })
    }
}

/// The ways to pick a light that `area/uniform` can be sampled with.
fn selections() -> impl Iterator<Item = Selection> {
    Selection::ALL.into_iter()
}

/// Compares at all receivers, by all selections of lights. A point within rounding of a shadow's edge may be seen one
/// way and not the other: at most one in a million.
fn assert_same(compare: impl Fn(&Case, Selection) -> Comparison + Sync) {
    let stages = worlds::all();
    let each = |case: &Case| {
        let of = |selection: Selection| (format!("{case} {selection:?}"), compare(case, selection));
        selections().map(of).collect::<Vec<_>>()
    };
    let found: Vec<(String, Comparison)> = worlds::cases(&stages).par_iter().flat_map_iter(each).collect();
    for (name, comparison) in &found {
        assert!(comparison.worst <= ROUNDINGS * U, "{name}: {comparison:?}");
    }
    let pairs: u64 = found.iter().map(|(_, comparison)| comparison.pairs).sum();
    let split: Vec<String> =
        found.iter().filter(|(_, c)| c.one_sided > 0).map(|(name, c)| format!("{name}: {c:?}")).collect();
    let one_sided: u64 = found.iter().map(|(_, comparison)| comparison.one_sided).sum();
    println!("{pairs} pairs, {one_sided} of them seen one way and not the other");
    let rate = one_sided as f64 / pairs as f64;
    assert!(pairs > 1_000_000 && rate <= 1e-6, "{one_sided} of {pairs}, seed {SEED}:\n{}", split.join("\n"));
}

/// Points drawn on the lights that face x, and directions aimed at them.
fn through_both(case: &Case, selection: Selection) -> Comparison {
    let world = &case.stage.world;
    let view = View::new(&world.geometry, case.place.frame(), Effort::Gather);
    let query = Query::irradiance(&world.lights);
    let ready = AreaOnLights::prepare(&world.lights, selection);
    let lights = ready.at(&view, &Query::irradiance(&world.lights));
    let draws =
        Samples::new(SEED, &case.place, Strategy::from((Kind::AreaUniform, selection)), Sampler::Independent, N);
    Comparison::of((0..N).filter_map(|index| {
        let (Sample { at: y, pdf: p }, some) = lights.sample::<f32>(&view.from_x(), draws.xi(index)).parts();
        let xy = Segment::to(&y);
        let aim = Aim { psi: xy.psi, target: y.target, alone: true };
        let Rgb(area) = Area::integrand(&view.from_x(), &query, &y) / p;
        let Rgb(hemisphere) = Hemisphere::integrand(&view.from_x(), &query, &aim) / p.per_solid_angle(&xy);
        (some && xy.facing()).then_some([area, hemisphere])
    }))
}

#[test]
fn the_jacobian_cancels() {
    assert_same(through_both);
}

/// The crossed row of the catalogue, drawn by the program itself.
#[test]
fn toward_lights_is_area_uniform_sample_by_sample() {
    assert_same(|case, selection| {
        let draw = |strategy| samples(case, strategy, Sampler::Independent, N, SEED);
        let area = draw(Strategy::from((Kind::AreaUniform, selection)));
        let hemisphere = draw(Strategy::from((Kind::HemisphereTowardLights, selection)));
        Comparison::of(area.into_iter().zip(hemisphere).map(|(a, h)| [a, h]))
    });
}

/// p(y) → p(Ψ) → p(y), over all points that face x.
#[test]
fn a_density_goes_to_the_other_measure_and_back() {
    let stages = worlds::all();
    worlds::cases(&stages).par_iter().for_each(|case| {
        let world = &case.stage.world;
        let view = View::new(&world.geometry, case.place.frame(), Effort::Cast);
        let ready = AreaOnLights::prepare(&world.lights, Selection::Together);
        let lights = ready.at(&view, &Query::irradiance(&world.lights));
        let strategy = Strategy::from(Kind::AreaUniform);
        let draws = Samples::new(SEED, &case.place, strategy, Sampler::Independent, N);
        for index in 0..N {
            let (Sample { at: y, pdf: p }, _) = lights.sample::<f32>(&view.from_x(), draws.xi(index)).parts();
            let xy = Segment::to(&y);
            let again = p.per_solid_angle(&xy).per_area(&xy);
            let apart = (f64::from(again.value()) / f64::from(p.value()) - 1.0).abs();
            assert!(!xy.facing() || apart <= 2.0 * U, "{case} sample {index}: {p:?} became {again:?}");
        }
    });
}
