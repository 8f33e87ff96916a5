//! JSON, CSV and the hash of the results.

use crate::support::{document, provenance, receiver, receivers, row};
use serde_json::Value;
use twoforms_comparison::result::ReceiverResult;
use twoforms_report::{Document, ReportError, csv, json};

fn parsed(document: &Document) -> Value {
    let mut out = Vec::new();
    json::write(document, &mut out).unwrap();
    assert!(out.ends_with(b"}\n"));
    serde_json::from_slice(&out).unwrap()
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

fn csv_lines(document: &Document) -> Vec<::csv::StringRecord> {
    let mut out = Vec::new();
    csv::write(document, &mut out).unwrap();
    assert!(!out.contains(&b'\r'));
    ::csv::ReaderBuilder::new().has_headers(false).from_reader(&out[..]).records().map(Result::unwrap).collect()
}

#[test]
fn json_has_the_fields_of_the_schema_in_their_order() {
    let json = parsed(&document(receivers()));
    assert_eq!(keys(&json), ["schema", "results_sha256", "provenance", "receivers"]);
    assert_eq!(json["schema"], "twoforms.compare/1");
    assert_eq!(json["provenance"]["seed"], "18446744073709551615");
    assert_eq!(json["provenance"]["replicates"], 1000);
    let common = ["version", "command", "seed", "scene", "scene_sha256", "threads", "started", "platform"];
    assert_eq!(keys(&json["provenance"])[..8], common);
    let receiver = &json["receivers"][0];
    let fields = ["name", "position", "normal", "exact", "known", "setup_seconds", "rows", "verdicts", "rates", "why"];
    assert_eq!(keys(receiver), fields);
    assert_eq!(keys(&receiver["exact"]), ["irradiance", "error_bound"]);
    assert_eq!(keys(&receiver["exact"]["irradiance"]), ["rgb", "luminance"]);
    assert_eq!(json["receivers"][1]["exact"], Value::Null);
}

#[test]
fn json_rows_verdicts_and_rates_have_the_fields_of_the_schema() {
    let json = parsed(&document(receivers()));
    let receiver = &json["receivers"][0];
    let row = keys(&receiver["rows"][0]);
    for field in ["strategy", "sampler", "samples", "replicates", "mean", "variance_of_mean", "variance_interval"] {
        assert!(row.contains(&field), "{field}");
    }
    for field in ["variance_exact", "variance_ratio", "variance_ratio_interval", "variance_of_one", "rays", "seconds"] {
        assert!(row.contains(&field), "{field}");
    }
    assert!(row.contains(&"setup_rays") && row.contains(&"setup_seconds"));
    let verdict = keys(&receiver["verdicts"][0]);
    for field in ["strategy", "sampler", "difference", "interval", "level", "margin", "arithmetic_budget"] {
        assert!(verdict.contains(&field), "{field}");
    }
    for field in ["reference", "detectable", "samples_needed", "verdict", "note"] {
        assert!(verdict.contains(&field), "{field}");
    }
    assert_eq!(keys(&receiver["rates"][0]), ["strategy", "sampler", "slope", "interval", "regime", "candidates"]);
}

#[test]
fn json_numbers_read_back_to_the_same_bits() {
    let third = 1.0 / 3.0e7;
    let json = parsed(&document(vec![receiver("x", vec![row("area/uniform", 3, 0.1 + 0.2, third)])]));
    assert_eq!(json["receivers"][0]["rows"][0]["variance_of_one"].as_f64(), Some(third));
    assert_eq!(json["receivers"][0]["rows"][0]["mean"]["rgb"][0].as_f64(), Some(0.1 + 0.2));
}

/// Puts a number that is not finite somewhere.
type Spoil = fn(&mut ReceiverResult);

#[test]
fn a_number_that_is_not_finite_is_an_error_that_names_its_place() {
    let spoil: [(Spoil, &str); 4] = [
        (|receiver| receiver.rows[2].mean.rgb[1] = f64::NAN, "receivers[1].rows[2].mean.rgb[1] is NaN"),
        (|receiver| receiver.rows[0].variance_of_mean = Some(f64::INFINITY), "rows[0].variance_of_mean is inf"),
        (|receiver| receiver.rates[1].interval = Some([f64::NEG_INFINITY, 0.0]), "rates[1].interval[0] is -inf"),
        (|receiver| receiver.setup_seconds = f64::NAN, "receivers[1].setup_seconds is NaN"),
    ];
    for (spoil, message) in spoil {
        let mut receivers = receivers();
        spoil(&mut receivers[1]);
        let error = Document::new(provenance(), receivers).unwrap_err();
        assert!(matches!(error, ReportError::NotFinite { .. }));
        assert!(error.to_string().contains(message), "{error}");
    }
}

#[test]
fn the_hash_covers_results_alone() {
    let hash = |change: fn(&mut ReceiverResult)| {
        let mut receivers = receivers();
        change(&mut receivers[1]);
        document(receivers).results_sha256().to_owned()
    };
    let same = hash(|_| {});
    assert_eq!(same.len(), 64);
    assert_eq!(same, hash(|receiver| receiver.rows[0].seconds = 1.0));
    assert_eq!(same, hash(|receiver| receiver.setup_seconds = 0.0));
    assert_eq!(same, hash(|receiver| receiver.rows[1].setup_seconds = 2.0));
    assert_eq!(
        same,
        hash(|receiver| {
            receiver.rows[0].efficiency = None;
            receiver.rows[0].why.insert("efficiency", "the clock did not move".into());
        })
    );
    assert_ne!(same, hash(|receiver| receiver.rows[0].mean.rgb[2] = receiver.rows[0].mean.rgb[2].next_up()));
    assert_ne!(same, hash(|receiver| receiver.rows[0].variance_interval = None));
    assert_ne!(same, hash(|receiver| receiver.name.push('!')));
    let mut other = provenance();
    other.threads = 7;
    assert_eq!(same, Document::new(other, receivers()).unwrap().results_sha256());
}

#[test]
fn csv_has_a_header_and_a_line_for_every_row() {
    let lines = csv_lines(&document(receivers()));
    assert_eq!(lines.len(), 1 + 2 * 6);
    assert_eq!(lines[0], csv::COLUMNS.to_vec());
    assert!(lines.iter().all(|line| line.len() == csv::COLUMNS.len()));
    assert_eq!(&lines[7][0], "in \"penumbra\", left");
}

#[test]
fn csv_numbers_read_back_to_the_same_bits() {
    let receivers = receivers();
    let lines = csv_lines(&document(receivers.clone()));
    let cell = |line: usize, name: &str| -> f64 {
        let column = csv::COLUMNS.iter().position(|column| *column == name).unwrap();
        lines[line][column].parse().unwrap()
    };
    let rows = receivers.iter().flat_map(|receiver| receiver.rows.iter().map(move |row| (receiver, row)));
    for (i, (receiver, row)) in rows.enumerate() {
        assert_eq!(["x", "y", "z"].map(|name| cell(i + 1, name)), receiver.position);
        assert_eq!(["mean_r", "mean_g", "mean_b"].map(|name| cell(i + 1, name)), row.mean.rgb);
        assert_eq!(cell(i + 1, "mean_luminance"), row.mean.luminance);
        assert_eq!(Some(cell(i + 1, "variance_of_mean")), row.variance_of_mean);
        assert_eq!(Some(["variance_lo", "variance_hi"].map(|name| cell(i + 1, name))), row.variance_interval);
        assert_eq!(Some(cell(i + 1, "variance_of_one")), row.variance_of_one);
        assert_eq!(Some(cell(i + 1, "chebyshev_outside")), row.chebyshev.map(|chebyshev| chebyshev.outside));
        assert_eq!([cell(i + 1, "rays"), cell(i + 1, "seconds")], [row.rays, row.seconds]);
        assert_eq!(Some(cell(i + 1, "efficiency")), row.efficiency);
        assert_eq!(cell(i + 1, "setup_seconds"), receiver.setup_seconds);
        let of_strategy = ["strategy_setup_rays", "strategy_setup_seconds"].map(|name| cell(i + 1, name));
        assert_eq!(of_strategy, [row.setup_rays as f64, row.setup_seconds]);
        let same = |name: &str, value: Option<f64>| match value {
            Some(value) => assert_eq!(cell(i + 1, name), value),
            None => assert!(cell(i + 1, name).is_nan(), "{name}"),
        };
        same("variance_exact", row.variance_exact);
        same("variance_ratio", row.variance_ratio);
        same("variance_ratio_lo", row.variance_ratio_interval.map(|[lo, _]| lo));
        same("variance_ratio_hi", row.variance_ratio_interval.map(|[_, hi]| hi));
    }
    assert_eq!(cell(1, "irradiance_known"), receivers[0].known.as_ref().unwrap().irradiance.luminance);
    assert!(cell(7, "irradiance_known").is_nan() && cell(7, "irradiance_exact").is_nan());
}
