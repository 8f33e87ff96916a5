//! `compare --check`: exit code 3 where an estimator is found to be biased.

use crate::support::{has_all, twoforms};

/// At a level near one an interval has next to no width, so that any estimate lies outside: seed 0, 800 samples.
const ALARM: &str = "compare @cornell-box --receiver floor-lit --strategies area/uniform --samples 16 --replicates 50 \
                     --level 0.9999 --margin 1e-9";

#[test]
fn a_bias_that_is_found_is_named_and_makes_the_exit_code_three() {
    let run = twoforms(&format!("{ALARM} --check --quiet"));
    assert_eq!(run.code, Some(3), "{}", run.err);
    assert_eq!(run.err.lines().count(), 1, "{}", run.err);
    has_all(&run.err, &["biased: area/uniform (independent) at floor-lit by "]);
    has_all(&run.out, &["area/uniform had a variance of"]);
}

#[test]
fn without_the_check_a_bias_is_reported_alone() {
    let document = twoforms(&format!("{ALARM} --format json")).json();
    assert_eq!(document["receivers"][0]["verdicts"][0]["verdict"], "biased");
}

/// At the default level of 0.01, seed 0.
#[test]
fn no_strategy_is_biased() {
    twoforms("compare @cornell-box --receiver floor-lit --samples 16,64 --replicates 200 --check").printed();
}
