//! Verdicts over many runs: honest estimators are not called biased more often than the level says.

use twoforms_comparison::experiment::{Experiment, Repeatable};
use twoforms_comparison::place::Place;
use twoforms_comparison::result::Verdict;
use twoforms_comparison::verdict::Criteria;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_tests::statistics::BinomialTest;
use twoforms_tests::worlds::{self, Stage};

const SEEDS: u64 = 300;
/// Familywise level of each run.
const LEVEL: f64 = 0.01;
/// Level at which too many alarms among the runs are found out.
const LEVEL_OF_COUNT: f64 = 1e-3;

fn places(stage: &Stage) -> Vec<Place> {
    stage.world.scene.receivers.iter().map(Place::of_receiver).collect()
}

fn experiment(replicates: u32) -> Experiment {
    Experiment {
        strategies: Strategy::all().into_iter().filter(|strategy| !strategy.is_biased()).collect(),
        samplers: vec![Sampler::Independent],
        samples: vec![16],
        replicates,
        seed: 0,
        criteria: Criteria { level: LEVEL, margin: 0.01 },
    }
}

fn verdicts(experiment: &Repeatable, seed: u64) -> Vec<Verdict> {
    let results = experiment.run(seed).expect("finite samples");
    results.into_iter().flat_map(|receiver| receiver.verdicts).collect()
}

fn is_alarm(verdicts: &[Verdict]) -> bool {
    verdicts.iter().any(|verdict| verdict.verdict == "biased")
}

/// How many of 300 runs with 16 × `replicates` samples call some strategy biased, and whether that is too many for runs
/// that each do so with probability 0.01 at most: P(K ≥ 11) = 3·10⁻⁴.
fn alarms_stay_within_the_level(scene: &str, replicates: u32) {
    let stage = worlds::stage(scene);
    let places = places(&stage);
    let experiment = experiment(replicates).repeatable(&stage.world, &places);
    let runs = (0..SEEDS).map(|seed| verdicts(&experiment, seed));
    let alarming: Vec<Vec<Verdict>> = runs.filter(|verdicts| is_alarm(verdicts)).collect();
    let count = BinomialTest { hits: alarming.len() as u64, trials: SEEDS, probability: LEVEL };
    println!("{scene}, {replicates} replicates: {count}");
    let biased: Vec<&Verdict> = alarming.iter().flatten().filter(|verdict| verdict.verdict == "biased").collect();
    let too_many = count.hits as f64 > SEEDS as f64 * LEVEL && count.p() < 2.0 * LEVEL_OF_COUNT;
    assert!(!too_many, "{scene}: {count}: {biased:#?}");
}

#[test]
fn false_alarms_stay_within_the_level_where_lights_are_near() {
    alarms_stay_within_the_level("square-light", 50);
}

#[test]
fn false_alarms_stay_within_the_level_among_several_lights() {
    alarms_stay_within_the_level("two-lights", 50);
}

#[test]
fn false_alarms_stay_within_the_level_with_occlusion() {
    alarms_stay_within_the_level("cornell-box", 50);
}

/// Receivers near walls that emit: tails as heavy as 1/s² makes them.
#[test]
fn false_alarms_stay_within_the_level_under_heavy_tails() {
    alarms_stay_within_the_level("furnace", 50);
}

/// One in a thousand directions meets the light, and fewer: too few hits for the normal law.
#[test]
fn false_alarms_stay_within_the_level_with_few_hits() {
    alarms_stay_within_the_level("tiny-far-light", 50);
}

/// What is worked out once for all runs changes none of them.
#[test]
fn a_run_that_is_repeated_is_the_run() {
    let stage = worlds::stage("two-lights");
    let places = places(&stage);
    let alone = Experiment { seed: 7, ..experiment(10) }.run(&stage.world, &places, &|_| ()).expect("finite samples");
    let alone: Vec<Verdict> = alone.into_iter().flat_map(|receiver| receiver.verdicts).collect();
    assert_eq!(alone, verdicts(&experiment(10).repeatable(&stage.world, &places), 7));
}

/// A verdict of `unbiased` is reached too, once there are enough samples: all that `samples_needed` asked for.
#[test]
fn the_samples_asked_for_decide() {
    let stage = worlds::stage("square-light");
    let place = &places(&stage)[..1];
    let first = verdicts(&experiment(50).repeatable(&stage.world, place), 1);
    let most = first.iter().filter_map(|verdict| verdict.samples_needed).fold(0.0, f64::max);
    assert!(most > 800.0, "something is undecided at first: {first:#?}");
    let replicates = (2.0 * most / 16.0).ceil() as u32;
    let then = verdicts(&experiment(replicates).repeatable(&stage.world, place), 2);
    assert!(then.iter().all(|verdict| verdict.verdict == "unbiased"), "after {replicates}: {then:#?}");
    for (before, after) in first.iter().zip(&then) {
        let certain = before.note == "nothing varies" && after.detectable == before.detectable;
        // Where few samples carried the variance, nothing was known before.
        let less = |after: f64| before.detectable.is_none_or(|before| after < before);
        assert!(certain || after.detectable.is_some_and(less), "{before:#?} {after:#?}");
    }
}
