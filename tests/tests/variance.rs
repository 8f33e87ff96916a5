//! The variance of an estimator is what theory says, and falls as 1/N.

use std::f64::consts::PI;

use rayon::prelude::*;
use twoforms_comparison::exactly::{self, ExactLight};
use twoforms_comparison::experiment::Experiment;
use twoforms_comparison::place::Place;
use twoforms_comparison::result::{Rate, ReceiverResult};
use twoforms_comparison::statistics::Z_95;
use twoforms_comparison::verdict::Criteria;
use twoforms_estimator::moments::Moments;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::Kind;
use twoforms_tests::samples::{moments, samples};
use twoforms_tests::statistics::{BinomialTest, Family, Outcome, ZTest};
use twoforms_tests::worlds::{self, Case, Stage};

const SEED: u64 = 20_260_804;
const LEVEL: f64 = 1e-3;
/// What binary32 arithmetic may add to a sample, as a share of the mean.
const BUDGET: f64 = 3e-6;
/// Fewer samples that are not zero say too little of a variance.
const LEAST_HITS: f64 = 100.0;
const N: u32 = 300_000;

/// The sample variance s² of n independent samples against the cited V, by Var(s²) ≈ (μ₄ − σ⁴)/n. Rounding may add as
/// much as a deviation of δ = 3·10⁻⁶ E.
fn variance_test(found: &Moments, expected: f64, mean: f64) -> ZTest {
    let Moments { n, m2, m4, .. } = *found;
    let delta = BUDGET * mean;
    ZTest {
        found: m2 / (n - 1.0),
        expected,
        sigma: ((m4 / n - (m2 / n) * (m2 / n)) / n).max(0.0).sqrt(),
        // What lies below zero is rounding.
        budget: (2.0 * expected.max(0.0).sqrt() + delta) * delta,
    }
}

/// Combinations of other techniques than the default ones, beside those that are listed.
const MORE: [&str; 10] = [
    "mis/balance(area/uniform:2,hemisphere/cosine)",
    "mis/power(area/solid-angle,area/projected-solid-angle,hemisphere/uniform)",
    "mis/cutoff(area/solid-angle,hemisphere/cosine)",
    "mis/maximum(area/uniform@power,hemisphere/uniform)",
    "mis/optimal(area/solid-angle,hemisphere/cosine)",
    "mis/optimal(area/uniform,area/solid-angle:2,hemisphere/uniform)",
    "mis/power(area/solid-angle@compensated:2,hemisphere/cosine:3)",
    "mis/optimal(hemisphere/cosine,area/projected-solid-angle@compensated)",
    "mixture/0.25(area/solid-angle,hemisphere/uniform)",
    "mixture/0.75(area/uniform@tree,area/projected-solid-angle)",
];

/// All strategies that have an exact variance.
fn strategies() -> Vec<Strategy> {
    let more = MORE.iter().map(|name| name.parse().expect("a strategy"));
    exactly::with_formula().into_iter().chain(more).collect()
}

/// The variance that a scene cites, RGB, or else the exact one, with bounds of their errors.
fn expected(case: &Case, strategy: Strategy, exact: &ExactLight) -> Result<([f64; 3], f64), String> {
    if let Some(cited) = case.variance(strategy) {
        return Ok((cited, 0.0));
    }
    let name = strategy.to_string();
    let found = exact.strategies.iter().find(|variance| variance.strategy == name).ok_or("it was not asked for")?;
    let value = found.variance_of_one.ok_or_else(|| found.why.clone().unwrap_or_default())?;
    let relative = if value.luminance > 0.0 { value.error_bound / value.luminance } else { 0.0 };
    Ok((value.rgb, relative))
}

fn outcomes(case: &Case, strategy: Strategy, exact: &ExactLight) -> Vec<Outcome> {
    let name = format!("{case} {strategy}");
    let (variance, relative) = match expected(case, strategy, exact) {
        Ok(expected) => expected,
        Err(why) => return vec![Outcome::Skipped { why: format!("{name}: {why}") }],
    };
    let drawn = samples(case, strategy, Sampler::Independent, N, SEED);
    let hits_of = |variance: [f64; 3], c: usize| {
        let e = case.known.irradiance[c];
        f64::from(N) * e * e / (variance[c] + e * e)
    };
    // The rare hits of one technique may be all that a combination of it varies by.
    let alone: Vec<[f64; 3]> = strategy
        .techniques()
        .into_iter()
        .filter_map(|technique| expected(case, technique.into(), exact).ok())
        .map(|(variance, _)| variance)
        .collect();
    let of_channel = |c: usize| {
        let (v, e) = (variance[c], case.known.irradiance[c]);
        let hits = alone.iter().map(|&variance| hits_of(variance, c)).fold(hits_of(variance, c), f64::min);
        if hits < LEAST_HITS {
            return Outcome::Skipped {
                why: format!("{name} channel {c}: {hits:.2} samples are expected not to be zero"),
            };
        }
        let mut test = variance_test(&moments(&drawn, c), v, e);
        test.budget += relative * v;
        Outcome::Tested { p: test.p(), evidence: format!("{name} channel {c} N = {N}: s² = {test}") }
    };
    (0..3).map(of_channel).collect()
}

#[test]
fn measured_variances_are_the_exact_ones() {
    let (stages, strategies) = (worlds::all(), strategies());
    let cases = worlds::cases(&stages);
    let all = |case: &Case| {
        let exact = exactly::at(&case.stage.world, &case.place, &strategies).light;
        strategies.iter().flat_map(|&strategy| outcomes(case, strategy, &exact)).collect::<Vec<_>>()
    };
    let outcomes = cases.par_iter().flat_map_iter(all).collect();
    Family::new("variances against exact ones", LEVEL, SEED, outcomes).assert_holds(0.05);
}

/// Where all light has one radiance L, a cosine-weighted sample is a coin: πL with probability E/(πL), else zero, whatever
/// is hidden; so its variance is E (πL − E).
#[test]
fn a_cosine_weighted_sample_of_one_radiance_is_a_coin() {
    let stages = worlds::all();
    let mut outcomes = Vec::new();
    for case in worlds::cases(&stages) {
        let lights = &case.stage.world.lights;
        let radiance = lights.radiance(0);
        if (0..lights.targets() as u32).any(|k| lights.radiance(k) != radiance) {
            continue;
        }
        let drawn = samples(&case, Strategy::from(Kind::HemisphereCosine), Sampler::Independent, N, SEED);
        let (l, e) = (f64::from(radiance[0]), case.known.irradiance[0]);
        let hits: Vec<f64> = drawn.iter().map(|w| f64::from(w[0])).filter(|&w| w != 0.0).collect();
        let other = hits.iter().find(|&&w| (w / (PI * l) - 1.0).abs() > 1e-6);
        assert_eq!(other, None, "{case}: a sample that is neither 0 nor {}", PI * l);
        let cited = case.variance(Strategy::from(Kind::HemisphereCosine)).expect("a cited variance")[0];
        assert!((cited - e * (PI * l - e)).abs() <= 1e-12 * PI * l * e, "{case}: {cited} is cited");
        let test = BinomialTest { hits: hits.len() as u64, trials: N.into(), probability: e / (PI * l) };
        outcomes.push(Outcome::Tested { p: test.p(), evidence: format!("{case}: {test}") });
    }
    Family::new("hits of cosine-weighted samples", LEVEL, SEED, outcomes).assert_holds(0.0);
}

/// The slope of log variance against log N, whose 95 % interval tells its standard error.
fn slope_test(rate: &Rate) -> Option<ZTest> {
    let (slope, [low, high]) = (rate.slope?, rate.interval?);
    Some(ZTest { found: slope, expected: -1.0, sigma: (high - low) / (2.0 * Z_95), budget: 0.0 })
}

fn slopes(stage: &Stage) -> Vec<Outcome> {
    let experiment = Experiment {
        strategies: Strategy::all().into_iter().filter(|strategy| !strategy.is_biased()).collect(),
        samplers: vec![Sampler::Independent],
        samples: vec![8, 32, 128],
        replicates: 600,
        seed: SEED,
        criteria: Criteria::default(),
    };
    let places: Vec<Place> = stage.cases().iter().map(|case| case.place.clone()).collect();
    let results = experiment.run(&stage.world, &places, &|_| ()).expect("finite samples");
    let rates = results.iter().flat_map(|result| result.rates.iter().map(move |rate| (result, rate)));
    let outcome = |(result, rate): (&ReceiverResult, &Rate)| {
        let name = format!("{} {} {}", stage.name, result.name, rate.strategy);
        match slope_test(rate) {
            Some(test) => Outcome::Tested { p: test.p(), evidence: format!("{name}: slope {test}") },
            None => Outcome::Skipped { why: format!("{name}: {:?}", rate.why) },
        }
    };
    rates.map(outcome).collect()
}

#[test]
fn variance_falls_as_one_over_n() {
    let outcomes = worlds::all().iter().flat_map(slopes).collect();
    Family::new("slopes of log variance against −1", LEVEL, SEED, outcomes).assert_holds(0.1);
}
