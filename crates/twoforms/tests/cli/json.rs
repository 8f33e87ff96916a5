//! `compare --format json`: the fields that scripts rely on, and the hash.

use serde_json::Value;
use twoforms_estimator::strategy::Strategy;

use crate::support::twoforms;

const LINE: &str =
    "compare @cornell-box --receiver floor-lit --receiver on-left-wall --samples 1,16 --replicates 40 --format json";

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}

fn has_keys(value: &Value, wanted: &[&str]) {
    let found = keys(value);
    for key in wanted {
        assert!(found.contains(key), "{key} is not among {found:?}");
    }
}

#[test]
fn the_fields_of_the_schema_are_there() {
    let document = twoforms(&format!("{LINE} --seed 18446744073709551615")).json();
    assert_eq!(document["schema"], "twoforms.compare/1");
    assert_eq!(document["results_sha256"].as_str().map(str::len), Some(64));
    has_keys(&document["provenance"], &["version", "command", "seed", "scene", "scene_sha256", "threads", "started"]);
    assert_eq!(document["provenance"]["seed"], "18446744073709551615");
    let receivers = document["receivers"].as_array().expect("receivers");
    assert_eq!(receivers.len(), 2);
    for receiver in receivers {
        has_keys(receiver, &["name", "position", "normal", "exact", "known", "rows", "verdicts", "rates"]);
        assert_eq!(receiver["rows"].as_array().map(Vec::len), Some(2 * Strategy::defaults().len()));
        assert_eq!(receiver["rates"].as_array().map(Vec::len), Some(Strategy::defaults().len()));
        for row in receiver["rows"].as_array().expect("rows") {
            has_keys(row, &ROW);
            assert_eq!(row["mean"]["rgb"].as_array().map(Vec::len), Some(3));
            assert!(row["mean"]["luminance"].is_f64());
        }
        for rate in receiver["rates"].as_array().expect("rates") {
            has_keys(rate, &["strategy", "sampler", "slope", "interval", "regime"]);
        }
    }
}

const ROW: [&str; 13] = [
    "strategy",
    "sampler",
    "samples",
    "replicates",
    "mean",
    "error",
    "variance_of_mean",
    "variance_interval",
    "variance_exact",
    "variance_of_one",
    "rays",
    "seconds",
    "efficiency",
];

/// With one replicate no variance is known, and every null says why.
#[test]
fn a_missing_value_has_its_reason_beside_it() {
    let line = "compare @cornell-box --receiver floor-lit --samples 4 --replicates 1 --format json";
    let document = twoforms(line).json();
    let rows = document["receivers"][0]["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), Strategy::defaults().len());
    for row in rows {
        for field in ["variance_of_mean", "variance_interval", "efficiency"] {
            assert!(row[field].is_null() && row["why"][field].is_string(), "{field} in {row}");
        }
    }
}

#[test]
fn the_scenes_own_answer_stands_beside_the_measurement() {
    let document = twoforms(LINE).json();
    let known = &document["receivers"][0]["known"];
    let luminance = known["irradiance"]["luminance"].as_f64().expect("a number");
    assert!((luminance - 0.379_826).abs() < 1e-5, "{luminance}");
    assert!(known["derivation"].as_str().is_some_and(|text| !text.is_empty()));
}

#[test]
fn equal_seeds_give_equal_hashes_on_any_number_of_threads_and_other_seeds_others() {
    let hash = |options: &str| twoforms(&format!("{LINE} {options}")).json()["results_sha256"].clone();
    let one = hash("--threads 1");
    assert_eq!([hash("-t 2"), hash("--nthreads 7"), hash("--seed 0")], [(); 3].map(|()| one.clone()));
    assert_ne!(hash("--seed 1"), one);
}

#[test]
fn every_strategy_goes_by_its_name_and_comes_back_under_it() {
    let names: Vec<String> = Strategy::all().iter().map(ToString::to_string).collect();
    let line = format!(
        "compare @two-lights --strategies {} --sampler independent --samples 4 --replicates 2 --format json",
        names.join(",")
    );
    let document = twoforms(&line).json();
    let rows = document["receivers"][0]["rows"].as_array().expect("rows");
    let back: Vec<&str> = rows.iter().map(|row| row["strategy"].as_str().expect("text")).collect();
    assert_eq!(back, names);
}

#[test]
fn what_is_said_twice_is_measured_once() {
    let line = "compare @cornell-box --receiver floor-lit --strategy area/uniform,area/uniform --samples 4,1,4 \
                --replicates 2 --format json";
    let document = twoforms(line).json();
    let rows = document["receivers"][0]["rows"].as_array().expect("rows");
    assert_eq!(rows.iter().map(|row| row["samples"].as_u64()).collect::<Vec<_>>(), [Some(4), Some(1)]);
}
