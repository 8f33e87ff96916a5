//! All strategies agree with the answer that a scene carries, on all scenes.

use std::collections::BTreeMap;

use twoforms_comparison::experiment::Experiment;
use twoforms_comparison::place::{Place, Quantity, Reflection};
use twoforms_comparison::result::{ReceiverResult, Row};
use twoforms_comparison::verdict::Criteria;
use twoforms_estimator::rgb::luminance;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_tests::statistics::{Family, Outcome, ZTest};
use twoforms_tests::worlds::{self, Case, Stage};

const SEED: u64 = 20_260_803;
const LEVEL: f64 = 1e-3;
/// What binary32 arithmetic may add to a mean, as a share of it.
const BUDGET: f64 = 3e-6;
/// Fewer samples that are not zero say nothing by a z-test.
const LEAST_HITS: f64 = 30.0;

/// All strategies with independent samples, and the basic ones with every sampler.
fn experiments() -> [Experiment; 2] {
    let all = Strategy::all().into_iter().filter(|strategy| !strategy.is_biased()).collect();
    let others = Sampler::ALL.iter().copied().filter(|s| s.is_random() && *s != Sampler::Independent).collect();
    [experiment(all, vec![Sampler::Independent]), experiment(Strategy::defaults(), others)]
}

fn experiment(strategies: Vec<Strategy>, samplers: Vec<Sampler>) -> Experiment {
    Experiment {
        strategies,
        samplers,
        samples: vec![16, 256],
        replicates: 1000,
        seed: SEED,
        criteria: Criteria { level: LEVEL, margin: 0.05 },
    }
}

/// Runs everything at these receivers.
fn measure(stage: &Stage, places: &[Place]) -> Vec<ReceiverResult> {
    let run = |experiment: Experiment| experiment.run(&stage.world, places, &|_| ()).expect("finite samples");
    experiments().map(run).into_iter().flatten().collect()
}

fn outcomes(stage: &Stage) -> Vec<Outcome> {
    let cases = stage.cases();
    let places: Vec<Place> = cases.iter().map(|case| case.place.clone()).collect();
    let results = measure(stage, &places);
    let rows =
        cases.iter().cycle().zip(&results).flat_map(|(case, result)| result.rows.iter().map(move |row| (case, row)));
    rows.flat_map(|(case, row)| by_channel(case, row)).collect()
}

/// One test per channel where the variance is cited, else one of the luminance, with the exact variance where samples are
/// independent and one is known, else with that measured.
fn by_channel(case: &Case, row: &Row) -> Vec<Outcome> {
    let strategy: Strategy = row.strategy.parse().expect("a strategy's name");
    let name = format!("{case} {} {} N = {} R = {}", row.strategy, row.sampler, row.samples, row.replicates);
    let independent = row.sampler == Sampler::Independent.to_string();
    let (known, found) = (case.known.irradiance, row.mean);
    let Some(cited) = case.variance(strategy).filter(|_| independent) else {
        let of_mean = row.variance_of_mean.expect("several replicates");
        let means = [found.luminance, luminance(known)];
        let name = format!("{name} luminance");
        if let Some(exact) = row.variance_exact {
            return vec![outcome(&name, row, means, exact, exact)];
        }
        let cited = case.variance(strategy).map(|variance| luminance(variance) / row.samples as f64);
        return vec![outcome(&name, row, means, of_mean, cited.unwrap_or(of_mean).max(of_mean))];
    };
    let of_channel = |c: usize| {
        let of_mean = cited[c] / row.samples as f64;
        outcome(&format!("{name} channel {c}"), row, [found.rgb[c], known[c]], of_mean, of_mean)
    };
    (0..3).map(of_channel).collect()
}

/// The test of a row's mean; `if_independent` is its variance were the samples independent, as far as that is known. Skipped where fewer than [`LEAST_HITS`] samples are expected not to be zero, which by Cauchy and
/// Schwarz has at least the probability E[w]²/E[w²]. With E = 0 every sample must be zero.
fn outcome(name: &str, row: &Row, [found, expected]: [f64; 2], variance_of_mean: f64, if_independent: f64) -> Outcome {
    let second = if_independent * row.samples as f64 + expected * expected;
    let hits = (row.samples * row.replicates) as f64 * expected * expected / second;
    if expected > 0.0 && hits < LEAST_HITS {
        return Outcome::Skipped { why: format!("{name}: {hits:.2} samples are expected not to be zero") };
    }
    let sigma = (variance_of_mean / row.replicates as f64).sqrt();
    let test = ZTest { found, expected, sigma, budget: BUDGET * expected };
    Outcome::Tested { p: test.p(), evidence: format!("{name}: {test}") }
}

#[test]
fn every_strategy_finds_every_known_answer() {
    let outcomes = worlds::all().iter().flat_map(outcomes).collect();
    Family::new("means against known answers", LEVEL, SEED, outcomes).assert_holds(0.05);
}

/// The program's own verdicts: none of its strategies is found biased, and most are found unbiased.
#[test]
fn no_verdict_says_biased() {
    let few = Experiment {
        samples: vec![256],
        replicates: 200,
        ..experiment(Strategy::defaults(), vec![Sampler::Independent])
    };
    let mut said: BTreeMap<&str, usize> = BTreeMap::new();
    for stage in worlds::all() {
        let places: Vec<Place> = stage.cases().iter().map(|case| case.place.clone()).collect();
        for result in few.run(&stage.world, &places, &|_| ()).expect("finite samples") {
            for verdict in result.verdicts {
                assert_ne!(verdict.verdict, "biased", "{} {}, seed {SEED}: {verdict:?}", stage.name, result.name);
                *said.entry(verdict.verdict).or_default() += 1;
            }
        }
    }
    println!("{said:?}");
    assert!(said["unbiased"] > 2 * said.values().sum::<usize>() / 3, "{said:?}");
}

/// nori's test of direct light: radiance ρE/π at the origin, ρ = 1/2, as `scenes/pa5/tests/test-direct.xml` states it, to
/// about six digits.
#[test]
fn nori_s_five_lights_reach_their_closed_form() {
    let stated = [0.089_839_4, 0.022_92, 0.053_419_8, 0.020_531_4, 0.261_74];
    let mut outcomes = Vec::new();
    for (k, expected) in (1..).zip(stated) {
        let stage = worlds::stage(&format!("nori-light-{k}"));
        let quantity = Quantity::Radiance { surface: Reflection::Lambertian([0.5; 3]), emission: [0.0; 3] };
        let place = Place { quantity, ..stage.case("origin").place };
        for row in measure(&stage, &[place]).iter().flat_map(|result| &result.rows) {
            let of_mean = row.variance_of_mean.expect("several replicates");
            let sigma = (of_mean / row.replicates as f64).sqrt();
            let test = ZTest { found: row.mean.luminance, expected, sigma, budget: 1e-6 };
            let evidence = format!("light {k} {} {} N = {}: {test}", row.strategy, row.sampler, row.samples);
            outcomes.push(Outcome::Tested { p: test.p(), evidence });
        }
    }
    Family::new("nori's radiances", LEVEL, SEED, outcomes).assert_holds(0.0);
}
