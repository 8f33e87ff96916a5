//! Every strategy at the receivers of every scene of the repository.

use std::fs;
use std::path::Path;

use serde_json::Value;
use twoforms_estimator::strategy::Strategy;

use crate::support::{program, run, scene};

/// Beside those that the list names: teams of three, shares of none and of all, as many candidates as there may be.
const MORE: [&str; 8] = [
    "mis/optimal(area/uniform@tree,hemisphere/cosine,area/projected-solid-angle:3)",
    "mis/maximum(area/solid-angle:2,hemisphere/brdf)",
    "mis/power(area/bilinear-cosine@compensated:2,hemisphere/cosine)",
    "mixture/0",
    "mixture/1",
    "mixture/0.3(area/solid-angle@power,hemisphere/uniform)",
    "ris/1",
    "ris/1024",
];

fn scenes() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let files = fs::read_dir(folder).expect("scenes").map(|entry| entry.expect("an entry").path());
    let gltf = files.filter(|path| path.extension().is_some_and(|extension| extension == "gltf"));
    let mut names: Vec<String> = gltf.map(|path| path.file_stem().expect("a name").display().to_string()).collect();
    names.sort();
    names
}

/// All have rows and a verdict wherever there is a receiver, and none is found biased.
#[test]
fn every_strategy_is_compared_on_every_scene() {
    let mut names: Vec<String> = Strategy::all().iter().map(ToString::to_string).collect();
    names.extend(MORE.map(str::to_owned));
    let list = names.join(",");
    for name in scenes() {
        let words = ["compare", &scene(&name), "--strategies", &list, "--samples", "1,16", "--replicates", "40"];
        let document = run([&words[..], &["--check", "--format", "json"]].concat()).json();
        for receiver in document["receivers"].as_array().expect("receivers") {
            let of = |list: &str| -> Vec<Value> {
                let entries = receiver[list].as_array().expect("a list");
                entries.iter().map(|entry| entry["strategy"].clone()).collect()
            };
            let (rows, verdicts) = (of("rows"), of("verdicts"));
            for strategy in &names {
                let count = |of: &[Value]| of.iter().filter(|name| *name == strategy).count();
                assert_eq!([count(&rows), count(&verdicts)], [2, 1], "{name}, {}: {strategy}", receiver["name"]);
            }
            let without =
                receiver["rows"].as_array().expect("rows").iter().find(|row| !row["mean"]["luminance"].is_f64());
            assert!(without.is_none(), "{name}: {without:?}");
        }
    }
}

/// What cannot be is refused, and the reason comes first.
#[test]
fn impossible_strategies_are_refused_with_the_reason() {
    for (strategy, reason) in [
        ("mis/optimal(area/uniform)", "1 technique(s) named where two or three are weighted together"),
        ("mis/balance(ratio,hemisphere/cosine)", "ratio is no technique but a combination"),
        (
            "area/uniform@compensated",
            "area/uniform@compensated never picks a light of which hemisphere/cosine gives enough",
        ),
        ("area/spherical-rectangle", "there is none of this name; did you mean"),
        ("ris/4096", "ris/M needs a number M of candidates from 1 to 1024"),
        ("hemisphere/cosine@power", "there is none of this name; did you mean"),
    ] {
        let words = ["compare", &scene("two-lights"), "--strategies", strategy];
        let output = program().args(words).output().expect("the program starts");
        let said = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(&format!("strategy \"{strategy}\": {reason}")), "{said}");
    }
}
