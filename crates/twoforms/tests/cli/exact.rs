//! `exact`: what it prints.

use serde_json::Value;
use twoforms_comparison::exactly::with_formula;

use crate::support::{folder, has_all, names, twoforms};

const LINE: &str = "exact @cornell-box --receiver floor-lit";

#[test]
fn the_fields_of_the_schema_are_there() {
    let document = twoforms(&format!("{LINE} --format json")).json();
    assert_eq!(document["schema"], "twoforms.exact/1");
    assert!(document["scene"].as_str().is_some_and(|path| path.ends_with("cornell-box.gltf")));
    let receiver = &document["receivers"][0];
    assert_eq!(receiver["name"], "floor-lit");
    for irradiance in ["irradiance", "irradiance_unoccluded"] {
        has_value(&receiver[irradiance]);
    }
    let strategies = receiver["strategies"].as_object().expect("strategies");
    assert_eq!(strategies.len(), with_formula().len());
    strategies.values().for_each(|strategy| has_value(&strategy["variance_of_one"]));
}

fn has_value(value: &Value) {
    assert_eq!(value["rgb"].as_array().map(Vec::len), Some(3), "{value}");
    assert!(value["luminance"].is_f64() && value["error_bound"].is_f64(), "{value}");
}

/// The answer that the scene carries was worked out apart from the program.
#[test]
fn the_scenes_own_answer_is_met() {
    let exact = twoforms(&format!("{LINE} --format json")).json();
    let known = twoforms("inspect @cornell-box --format json").json();
    for c in 0..3 {
        let number = |value: &Value| value[c].as_f64().expect("a number");
        let exact = number(&exact["receivers"][0]["irradiance"]["rgb"]);
        assert!((exact / number(&known["receivers"][0]["irradiance"]) - 1.0).abs() < 1e-9);
    }
}

#[test]
fn nothing_is_random() {
    let csv = |options: &str| twoforms(&format!("{LINE} --format csv {options}")).printed();
    let one = csv("--seed 1 --threads 1");
    assert_eq!(csv("--seed 2 --threads 2"), one);
    assert_eq!(one.lines().count() - 1, with_formula().len());
}

#[test]
fn the_table_says_why_a_strategy_has_no_variance() {
    let table = twoforms(&format!("{LINE} --strategies ratio,area/uniform,ris/8")).printed();
    has_all(&table, &["area/uniform ", "  ratio, ris/8: no formula is known for its variance"]);
    let table = twoforms(&format!("{LINE} --strategies area/uniform")).printed();
    assert!(!table.contains("no formula"), "{table}");
}

#[test]
fn the_table_and_the_file_hold_the_strategies_asked_for() {
    let folder = folder("exact");
    let path = folder.join("exact.txt");
    let line = format!("{LINE} --strategies area/solid-angle,mixture/0.25");
    let table = twoforms(&line).printed();
    has_all(&table, &["floor-lit", "area/solid-angle ", "mixture/0.25 "]);
    assert_eq!(twoforms(&format!("{line} -o {}", path.display())).printed(), "");
    assert_eq!(names(&folder), ["exact.txt"]);
    assert_eq!(std::fs::read_to_string(path).expect("a file"), table);
}
