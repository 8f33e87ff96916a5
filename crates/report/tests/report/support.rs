//! Small documents and images made by hand.

use std::collections::BTreeMap;
use std::path::PathBuf;

use twoforms_comparison::result::{Chebyshev, Colour, Exact, Known, Rate, ReceiverResult, Row, Verdict, Why};
use twoforms_report::{Channel, Document, Image, Provenance};

/// A provenance with every field set.
pub fn provenance() -> Provenance {
    Provenance {
        version: "0.1.0".into(),
        command: "twoforms compare scenes/box.gltf".into(),
        seed: "18446744073709551615".into(),
        scene: "scenes/box.gltf".into(),
        scene_sha256: "00".repeat(32),
        threads: 2,
        started: "2025-11-22T10:47:23Z".into(),
        platform: "linux x86_64".into(),
        settings: BTreeMap::new(),
    }
    .with("replicates", 1000)
    .with("quantity", "irradiance")
}

/// A row of `samples` samples whose variance of one sample is `variance`, with an interval of ± 4 %.
pub fn row(strategy: &str, samples: u64, mean: f64, variance: f64) -> Row {
    let of_mean = variance / samples as f64;
    Row {
        strategy: strategy.into(),
        sampler: "independent".into(),
        samples,
        replicates: 1000,
        mean: Colour::from([mean, mean / 2.0, mean / 4.0]),
        error: None,
        variance_of_mean: Some(of_mean),
        variance_interval: Some([of_mean * 0.96, of_mean * 1.04]),
        variance_exact: None,
        variance_ratio: None,
        variance_ratio_interval: None,
        variance_of_one: Some(variance),
        chebyshev: Some(Chebyshev { delta: 0.1, bound: (of_mean / 0.1).sqrt(), outside: 0.003, about: "mean" }),
        rays: samples as f64,
        seconds: samples as f64 * if strategy.starts_with("area") { 2.6e-8 } else { 2e-8 },
        setup_rays: 0,
        setup_seconds: samples as f64 * 1e-9,
        efficiency: (variance > 0.0).then(|| 1.0 / (of_mean * samples as f64 * 2e-8)),
        why: Why::new(),
    }
}

/// The same row beside an exact variance.
pub fn beside_exact(row: Row, variance_exact: f64) -> Row {
    let over = |variance: f64| variance / variance_exact;
    Row {
        variance_exact: Some(variance_exact),
        variance_ratio: row.variance_of_mean.map(over),
        variance_ratio_interval: row.variance_interval.map(|ends| ends.map(over)),
        ..row
    }
}

/// The rows of three strategies at N = 1 and N = 1024; `scale` is the receiver's brightness.
pub fn rows(scale: f64) -> Vec<Row> {
    let of = |strategy, variance: f64| [1, 1024].map(|n| row(strategy, n, scale, variance * scale * scale));
    [of("hemisphere/uniform", 73.0), of("hemisphere/cosine", 41.0), of("area/uniform", 1.0)].concat()
}

/// A fitted rate near −1.
pub fn rate(strategy: &str) -> Rate {
    Rate {
        strategy: strategy.into(),
        sampler: "independent".into(),
        slope: Some(-1.003),
        interval: Some([-1.033, -0.973]),
        regime: Some("1/N".into()),
        candidates: vec!["1/N".into()],
        why: Why::new(),
    }
}

/// A receiver with `rows`, and a rate for each of the three strategies.
pub fn receiver(name: &str, rows: Vec<Row>) -> ReceiverResult {
    ReceiverResult {
        name: name.into(),
        position: [0.1, 0.0, -0.25],
        normal: [0.0, 1.0, 0.0],
        exact: None,
        known: None,
        setup_seconds: 1.5e-5,
        rows,
        verdicts: Vec::new(),
        rates: ["hemisphere/uniform", "hemisphere/cosine", "area/uniform"].map(rate).into(),
        why: Why::from([("exact", "not computed".to_owned())]),
    }
}

/// Two receivers, one of them with a known answer, an exact value and a verdict.
pub fn receivers() -> Vec<ReceiverResult> {
    let of_area = |row: Row| row.strategy == "area/uniform";
    let with_exact =
        |row: Row| if of_area(row.clone()) { beside_exact(row.clone(), 0.353 / row.samples as f64) } else { row };
    let mut lit = receiver("floor lit", rows(1.0).into_iter().map(with_exact).collect());
    let variance = BTreeMap::from([("area/uniform".to_owned(), [1.02, 0.255, 0.063_75])]);
    let irradiance = Colour::from([1.0, 0.5, 0.25]);
    lit.known = Some(Known { irradiance, variance, derivation: "a square light, in closed form".into() });
    lit.exact = Some(Exact { irradiance, error_bound: 2e-12 });
    let detectable = Some(2e-3);
    let unbiased = verdict("area/uniform", "unbiased", "any bias is below the margin");
    lit.verdicts.push(Verdict { difference: 1e-4, interval: Some([-1e-3, 1e-3]), detectable, ..unbiased });
    let note = "the interval reaches beyond the margin: take more samples";
    lit.verdicts.push(Verdict {
        interval: Some([-0.07, 0.09]),
        detectable: Some(0.1),
        samples_needed: Some(1.234e6),
        ..verdict("hemisphere/cosine", "undecided", note)
    });
    vec![lit, receiver("in \"penumbra\", left", rows(0.01))]
}

/// A verdict of these words where E = 0.5883, without figures.
pub fn verdict(strategy: &str, verdict: &'static str, note: &str) -> Verdict {
    Verdict {
        strategy: strategy.into(),
        sampler: "independent".into(),
        reference: Colour::from([1.0, 0.5, 0.25]).luminance,
        difference: 0.0,
        interval: None,
        level: 0.01,
        margin: 0.01,
        arithmetic_budget: 3e-6,
        detectable: None,
        samples_needed: None,
        verdict,
        note: note.into(),
    }
}

/// A document of `receivers`.
pub fn document(receivers: Vec<ReceiverResult>) -> Document {
    Document::new(provenance(), receivers).expect("all figures are finite")
}

/// A 5 × 3 image with R, G, B, a layer and a depth, values from 0 to 2.
pub fn image() -> Image {
    let ramp = |scale: f32| (0..15).map(|i| i as f32 * scale / 7.0).collect();
    let named = |(name, scale): (&str, f32)| Channel { name: name.into(), samples: ramp(scale) };
    let channels = [("R", 1.0), ("G", 0.5), ("B", 0.25), ("area/uniform.Variance.R", 3.0), ("depth.Z", f32::INFINITY)];
    Image {
        width: 5,
        height: 3,
        channels: channels.map(named).into(),
        samples_per_pixel: 64,
        render_seconds: Some(1.25),
        provenance: Provenance { scene: "scènes/𝄞.gltf".into(), ..provenance() },
    }
}

/// A fresh, empty folder for the test `name`.
pub fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("the target folder is ours");
    folder
}
