//! The sentence to remember.

use crate::support::{document, receiver, row, rows};
use twoforms_comparison::result::{ReceiverResult, Row};
use twoforms_report::summary::sentence;

fn of(receivers: Vec<ReceiverResult>) -> String {
    sentence(&document(receivers))
}

/// One receiver at N = 16 with these strategies and variances of one sample.
fn at_one(variances: &[(&str, f64)]) -> String {
    let rows = variances.iter().map(|(strategy, variance)| row(strategy, 16, 1.0, *variance)).collect();
    of(vec![receiver("floor", rows)])
}

/// A row whose estimates are all `mean`.
fn constant(strategy: &str, mean: f64) -> Row {
    Row { variance_of_mean: Some(0.0), variance_interval: None, ..row(strategy, 16, mean, 0.0) }
}

#[test]
fn the_lowest_the_next_and_the_worst() {
    // Four receivers with ± 4 % each: 0.04·√2/√4 = 2.8 % for a ratio, 41 ± 1.2 and 73 ± 2.1.
    let receivers = [1.0, 0.1, 1e-6, 30.0].map(|scale| receiver("x", rows(scale)));
    assert_eq!(
        of(receivers.into()),
        "area/uniform had the lowest variance: 41.0 ± 1.2 times lower than hemisphere/cosine and 73 ± 2 times lower \
         than hemisphere/uniform (geometric mean over 4 receivers at N = 1024; ± is 95 %), at 1.0 times the rays and \
         1.3 times the time of hemisphere/cosine."
    );
}

#[test]
fn the_factor_is_the_geometric_mean_of_the_receivers_factors() {
    let at = |factor: f64| receiver("x", vec![row("a", 16, 1.0, 1.0), row("b", 16, 1.0, factor)]);
    let sentence = of(vec![at(2.0), at(50.0)]);
    assert!(sentence.starts_with("a had the lowest variance: 10.0 ± 0.4 times lower than b ("), "{sentence}");
}

#[test]
fn a_wide_uncertainty_is_an_interval_and_none_is_said() {
    let mut rows = vec![row("a", 16, 1.0, 1.0), row("b", 16, 1.0, 10.0)];
    let of_mean = rows[1].variance_of_mean.unwrap();
    rows[1].variance_interval = Some([of_mean / 2.0, of_mean * 2.0]);
    let wide = of(vec![receiver("floor", rows.clone())]);
    assert!(wide.contains("10 (5.0 to 20) times lower than b (at floor, N = 16; ± is 95 %)"), "{wide}");
    rows[1].variance_interval = None;
    let unknown = of(vec![receiver("floor", rows)]);
    assert!(unknown.contains("about 10 times (no interval) lower than b (at floor, N = 16), at"), "{unknown}");
}

#[test]
fn strategies_within_the_uncertainty_are_tied() {
    let sentence = at_one(&[("hemisphere/cosine", 9.0), ("hemisphere/toward-lights", 1.0), ("area/uniform", 1.02)]);
    assert_eq!(
        sentence,
        "hemisphere/toward-lights and area/uniform had the lowest variance, equal within its uncertainty: 9.0 ± 0.5 \
         times lower than hemisphere/cosine (at floor, N = 16; ± is 95 %), at 1.0 times the rays and 1.0 and 1.3 times \
         the time of hemisphere/cosine."
    );
    assert_eq!(
        at_one(&[("a", 1.0), ("b", 1.0)]),
        "a and b had the same variance within its uncertainty (at floor, N = 16), at 16 rays and 320 ns an estimate."
    );
}

#[test]
fn one_strategy_alone() {
    assert_eq!(
        at_one(&[("area/uniform", 1.6)]),
        "area/uniform had a variance of 0.1000 ± 4.0 % (at floor, N = 16; ± is 95 %), at 16 rays and 416 ns an estimate."
    );
}

#[test]
fn no_variance_at_all_is_named_apart() {
    let with = |mut rows: Vec<Row>| {
        rows.insert(0, constant("exact", 1.0));
        of(vec![receiver("floor", rows)])
    };
    assert_eq!(with(vec![]), "exact had no variance at all (at floor, N = 16).");
    let others = with(vec![row("a", 16, 1.0, 1.0), row("b", 16, 1.0, 4.0)]);
    assert!(
        others.starts_with("exact had no variance at all; of the others, a had the lowest variance: 4.0"),
        "{others}"
    );
}

#[test]
fn a_strategy_that_varies_by_rounding_alone_is_no_factor() {
    let rounding = |scale: f64| row("exact", 16, 1.0, scale * 1e-14);
    let at = |first: Row| receiver("x", vec![first, row("a", 16, 1.0, 1.0), row("b", 16, 1.0, 4.0)]);
    let sentence = of(vec![at(rounding(1.0)), at(rounding(30.0)), at(row("exact", 16, 1.0, 0.5))]);
    let expected = "exact had no variance at 2 of 3 receivers; of the others, a had the lowest variance: 4.0";
    assert!(sentence.starts_with(expected), "{sentence}");
    assert!(sentence.contains("over 3 receivers"), "{sentence}");
}

#[test]
fn a_strategy_that_met_no_light_does_not_win() {
    let rows = vec![constant("hemisphere/uniform", 0.0), row("a", 16, 1.0, 1.0), row("b", 16, 1.0, 4.0)];
    let sentence = of(vec![receiver("floor", rows)]);
    assert!(sentence.starts_with("a had the lowest variance"), "{sentence}");
    assert!(sentence.ends_with("; no sample of hemisphere/uniform met a light."), "{sentence}");
}

#[test]
fn receivers_without_a_variance_are_left_out_and_counted() {
    let pair = |a: Row, b: Row| receiver("x", vec![a, b]);
    let sentence = of(vec![
        pair(row("a", 16, 1.0, 1.0), row("b", 16, 1.0, 4.0)),
        pair(row("a", 16, 1.0, 1.0), row("b", 16, 1.0, 4.0)),
        pair(constant("a", 0.0), constant("b", 0.0)),
        pair(row("a", 16, 1.0, 1.0), constant("b", 0.0)),
    ]);
    assert!(sentence.contains("(geometric mean over 2 of 4 receivers at N = 16; ± is 95 %)"), "{sentence}");
    assert!(!sentence.contains("met a light"), "{sentence}");
}

#[test]
fn where_nothing_can_be_compared_it_says_so() {
    assert_eq!(of(vec![]), "The strategies share no sample count, so their variances are not compared.");
    let apart = vec![row("a", 1, 1.0, 1.0), row("b", 4, 1.0, 1.0)];
    assert!(of(vec![receiver("x", apart)]).starts_with("The strategies share no sample count"));
    assert!(of(vec![receiver("x", vec![constant("a", 0.0)])]).starts_with("All estimates are zero"));
    let single = Row { variance_of_mean: None, variance_interval: None, ..row("a", 16, 1.0, 1.0) };
    assert!(of(vec![receiver("x", vec![single])]).contains("needs more replicates"));
}

#[test]
fn the_largest_shared_count_is_compared_and_samplers_are_named() {
    let sobol = |row: Row| Row { sampler: "sobol".into(), ..row };
    let rows = vec![
        row("a", 16, 1.0, 8.0),
        row("a", 100, 1.0, 8.0),
        sobol(row("a", 16, 1.0, 1.0)),
        sobol(row("a", 128, 1.0, 99.0)),
    ];
    let sentence = of(vec![receiver("floor", rows)]);
    assert!(
        sentence.starts_with(
            "a (sobol) had the lowest variance: 8.0 ± 0.5 times lower than a (independent) (at floor, N = 16"
        ),
        "{sentence}"
    );
}
