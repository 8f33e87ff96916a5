//! Scenes on which plain binary64 cancels: far and tiny lights, slits, specks, receivers next to a
//! light's plane.

use serde_json::Value as Json;
use twoforms_estimator::strategy::Strategy;
use twoforms_exact::Sight;

use crate::file;

/// |value − known| <= the stated bound, irradiance to a relative 1e-9, V to 1e-6 of itself wherever
/// V/E² >= 1e-9 (and to 1e-15 E² below).
fn compare(case: &Json, sight: &Sight, wrong: &mut Vec<String>) {
    let name = case["name"].as_str().unwrap();
    for (value, field) in [(sight.irradiance(), "irradiance"), (sight.irradiance_unoccluded(), "unoccluded")] {
        let known = case[field].as_f64().unwrap();
        let error = (value.luminance - known).abs();
        if error > value.error_bound || error > 1e-9 * known {
            wrong.push(format!(
                "{name}: {field} {} known {known} error {error:e} bound {:e}",
                value.luminance, value.error_bound
            ));
        }
    }
    let e = case["irradiance"].as_f64().unwrap();
    for (strategy, known) in case["variance"].as_object().unwrap() {
        let known = known.as_f64().unwrap();
        let value = match sight.variance(strategy.parse::<Strategy>().unwrap()) {
            Ok(value) => value,
            Err(why) => {
                wrong.push(format!("{name}: {strategy} {why}"));
                continue;
            }
        };
        let error = (value.luminance - known).abs();
        if error > value.error_bound || error > (1e-6 * known).max(1e-15 * e * e) {
            wrong.push(format!(
                "{name}: {strategy} {:e} known {known:e} error {error:e} bound {:e}, V/E² {:e}",
                value.luminance,
                value.error_bound,
                known / (e * e)
            ));
        }
    }
}

#[test]
fn values_hold_where_plain_sums_cancel() {
    let mut wrong = Vec::new();
    for case in file::cases(include_str!("../data/stress.json")) {
        let (x, n) = file::receiver(&case);
        for merge in [false, true] {
            let (facing, lights) = file::scene(&case).facing(x, n, merge);
            compare(&case, &Sight::new(&facing, &lights).unwrap(), &mut wrong);
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
