//! Exact light against the answers that scenes carry, which another program of this repository worked out.

use twoforms_comparison::exactly::with_formula;
use twoforms_comparison::exactly::{self, ExactVariance};
use twoforms_estimator::strategy::Strategy;
use twoforms_tests::worlds::{self, Case};

/// Relative difference that the rounding of binary64 may leave.
const ROUNDING: f64 = 1e-10;
/// What it may leave of E² in a variance E[w²] − E².
const CANCELLATION: f64 = 1e-13;

/// The largest |found − expected| / allowed over the channels, and its two numbers; NaN counts as infinite.
fn apart(found: [f64; 3], expected: [f64; 3], allowed: impl Fn(usize) -> f64) -> (f64, f64, f64) {
    let excess = |c: usize| {
        let difference = (found[c] - expected[c]).abs();
        let ratio = if difference == 0.0 { 0.0 } else { difference / allowed(c) };
        (if ratio.is_nan() { f64::INFINITY } else { ratio }, found[c], expected[c])
    };
    [1, 2].into_iter().map(excess).fold(excess(0), |worst, next| if next.0 > worst.0 { next } else { worst })
}

fn irradiance_is_known(case: &Case) {
    let exact = exactly::at(&case.stage.world, &case.place, &[]);
    let found = exact.light.irradiance.expect("an exact irradiance").rgb;
    let expected = case.known.irradiance;
    let worst = apart(found, expected, |c| ROUNDING * expected[c]);
    assert!(worst.0 <= 1.0, "{case}: irradiance {worst:?}");
}

fn variance_is_cited(case: &Case, exact: &ExactVariance) -> bool {
    let strategy: Strategy = exact.strategy.parse().expect("a strategy's name");
    let Some(cited) = case.variance(strategy) else { return false };
    let found = exact.variance_of_one.expect("an exact variance").rgb;
    let e = case.known.irradiance;
    let worst = apart(found, cited, |c| ROUNDING * cited[c] + CANCELLATION * e[c] * e[c]);
    assert!(worst.0 <= 1.0, "{case} {strategy}: variance {worst:?}");
    true
}

#[test]
fn exact_irradiance_is_the_known_answer() {
    worlds::cases(&worlds::all()).iter().for_each(irradiance_is_known);
}

/// Strategies whose variance every scene cites: the hemisphere's two, and three selections of two more.
const CITED: usize = 8;

#[test]
fn exact_variances_are_the_cited_ones() {
    let stages = worlds::all();
    let mut compared = 0;
    for case in worlds::cases(&stages) {
        let exact = exactly::at(&case.stage.world, &case.place, &with_formula());
        compared += exact.light.strategies.iter().filter(|variance| variance_is_cited(&case, variance)).count();
    }
    assert!(compared >= worlds::cases(&stages).len() * CITED, "only {compared} were compared");
}
