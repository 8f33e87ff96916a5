//! Scenes whose irradiance and variances were computed by other methods.

use serde_json::Value as Json;
use twoforms_estimator::strategy::Strategy;
use twoforms_exact::Sight;

use crate::file::{self, numbers};

/// Irradiance and second moments to a relative 1e-9; V to 1e-6 of V + 1e-13 of its second moment,
/// or 1e-9 of V; bounds hold.
fn compare(json: &Json, sight: &Sight, wrong: &mut Vec<String>, worst: &mut f64) {
    let name = json["name"].as_str().unwrap();
    let precision = numbers(&json["precision"]);
    let e = sight.irradiance();
    let known = json["irradiance"].as_f64().unwrap();
    let scale = if known > 0.0 { known } else { json["unoccluded"].as_f64().unwrap().max(1e-3) };
    let error = (e.luminance - known).abs();
    *worst = worst.max(error / scale);
    if error > 1e-12 * scale || error > e.error_bound + 10.0 * precision[0] * scale {
        wrong.push(format!("{name}: irradiance {} known {known} bound {}", e.luminance, e.error_bound));
    }
    let open = json["unoccluded"].as_f64().unwrap();
    if (sight.irradiance_unoccluded().luminance - open).abs() > 1e-12 * open {
        wrong.push(format!("{name}: unoccluded {:?} known {open}", sight.irradiance_unoccluded()));
    }
    for (strategy, known_variance) in json["variance"].as_object().unwrap() {
        let strategy: Strategy = strategy.parse().unwrap();
        let known_v = known_variance.as_f64().unwrap();
        let got = match sight.variance(strategy) {
            Ok(got) => got,
            Err(why) => {
                wrong.push(format!("{name}: {strategy}: {why}"));
                continue;
            }
        };
        let second = known_v + known * known;
        let scale = if second > 0.0 { second } else { scale * scale };
        let error = (got.luminance - known_v).abs();
        *worst = worst.max(error / scale);
        if error / scale > 1e-11_f64.max(10.0 * precision[1])
            || error > 1e-6 * known_v + 1e-13 * second && error > 1e-9 * known_v
            || error > got.error_bound + 10.0 * precision[1] * scale
        {
            wrong.push(format!(
                "{name}: {strategy}: {} known {known_v} bound {:e}, error {error:e}",
                got.luminance, got.error_bound
            ));
        }
    }
}

#[test]
fn irradiance_and_variance_agree_with_other_methods() {
    let (mut wrong, mut worst) = (Vec::new(), 0.0);
    for case in file::cases(include_str!("../data/known.json")) {
        let (x, n) = file::receiver(&case);
        for merge in [false, true] {
            let (facing, lights) = file::scene(&case).facing(x, n, merge);
            compare(&case, &Sight::new(&facing, &lights).unwrap(), &mut wrong, &mut worst);
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    println!("worst relative error {worst:.1e}");
}
