//! The reproductions that come with the program: they hold with several seeds, and notice what they say they notice.

use std::sync::OnceLock;

use twoforms_reproduction::{Hears, Reproduction, Row, Settings, Text, Verdict, catalogue, run};

/// The chance that an honest run fails is the reproductions' own: 10⁻³ for each of them and seed.
const SEEDS: [u64; 3] = [0, 1, 2];

fn text(name: &str) -> Text {
    let found = catalogue::reproductions().find(|(known, _)| *known == name);
    Text { name: name.to_owned(), folder: None, text: found.expect("a reproduction").1.to_owned() }
}

fn done(name: &str, seed: u64, quick: bool) -> Reproduction {
    let text = text(name).with(&[format!("seed={seed}")]).expect("a seed");
    run(name, &text, Settings { quick }, Hears::NOBODY).unwrap_or_else(|error| panic!("{error}"))
}

/// In full with the first seed: worked out once for the tests that ask for it.
fn in_full() -> &'static [(&'static str, Reproduction)] {
    static DONE: OnceLock<Vec<(&str, Reproduction)>> = OnceLock::new();
    DONE.get_or_init(|| names().map(|name| (name, done(name, SEEDS[0], false))).collect())
}

fn names() -> impl Iterator<Item = &'static str> {
    catalogue::reproductions().map(|(name, _)| name)
}

#[test]
fn every_reproduction_holds_with_three_seeds() {
    let others = SEEDS[1..].iter().flat_map(|seed| names().map(|name| (name, done(name, *seed, false))));
    for (name, done) in in_full().iter().cloned().chain(others) {
        let failed: Vec<&Row> = done.rows().filter(|row| !held(row)).collect();
        assert!(failed.is_empty() && done.passed(), "{name}, seed {}: {failed:#?}", done.seed);
    }
}

fn held(row: &Row) -> bool {
    matches!(row.verdict, Verdict::Agrees | Verdict::Exact)
}

/// A row that was measured notices a change of its results by what it says, either way; one that was not, a change beyond the
/// digits of what is printed or derived.
#[test]
fn every_row_notices_what_it_says_it_does() {
    for (name, done) in in_full() {
        let mut noticed = 0;
        for row in done.rows().filter(|row| can_notice(row)) {
            for change in [1.01 * row.detects, -1.01 * row.detects] {
                let perturbed = row.perturbed(change);
                assert_eq!(perturbed.verdict, Verdict::Differs, "{name}: {} by {change}: {perturbed:#?}", row.quantity);
            }
            noticed += 1;
        }
        assert!(noticed > 0 || *name == "projected-solid-angle", "{name} notices nothing");
    }
}

/// Bounds and zeros do not change by a factor; a rule's value that nobody printed stands beside nothing.
fn can_notice(row: &Row) -> bool {
    let expected = || row.expected.iter().flatten().next();
    let exact = row.finding.exact.map(|[value, error]| if value.abs() <= error { 0.0 } else { value });
    let reference = exact.or(expected().map(|printed| printed.value));
    let beside = row.measured.is_some() || expected().is_some();
    row.finding.at_most.is_none() && beside && reference.is_some_and(|value| value != 0.0)
}

/// Where no variance is claimed, one that is there is an error: the same rows with another density.
#[test]
fn a_variance_where_there_should_be_none_is_noticed() {
    let text = text("projected-solid-angle");
    let other = Text { text: text.text.replace("area/projected-solid-angle", "area/solid-angle"), ..text };
    let done = run("other", &other, Settings::default(), Hears::NOBODY).expect("it runs");
    assert!(done.rows().all(|row| row.verdict == Verdict::Differs), "{:#?}", done.sections);
}

/// The lecture's printed numbers are all there, in its order.
#[test]
fn the_lecture_prints_its_numbers() {
    let done = done("lecture", 0, true);
    let published: Vec<f64> = done.rows().filter_map(|row| row.published).collect();
    assert_eq!(published, [3.5, 0.916, 1.0, 2.74, 1.44, 0.96, 0.75, 8.0, 0.0, 8.0, 21.3, 8.0, 6.3]);
    let exact = |quantity: &str, experiment: &str| {
        let found = done.rows().find(|row| row.quantity == quantity && row.experiment.contains(experiment));
        found.and_then(|row| row.exact).expect("a row")
    };
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9 * b, "{a} {b}");
    close(exact("variance", "die"), 11.0 / 12.0);
    close(exact("variance", "primary estimator"), 16.0 / 9.0);
    close(exact("variance", "p = 1/4"), 64.0 / 3.0);
    close(exact("variance", "p = (x + 2)/16"), 64.0 * 3.0_f64.ln() - 64.0);
}

/// What lies in the folders is what the program carries.
#[test]
fn the_program_carries_every_reproduction_and_scene() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let files = |folder: &str, extension: &str| {
        let entries = std::fs::read_dir(root.join(folder)).expect("a folder").map(|entry| entry.expect("an entry"));
        let names = entries.map(|entry| entry.file_name().into_string().expect("UTF-8"));
        let mut names: Vec<String> = names.filter(|name| name.ends_with(extension)).collect();
        names.sort();
        names
    };
    let sorted = |mut names: Vec<String>| {
        names.sort();
        names
    };
    let reproductions = names().map(|name| format!("{name}.toml")).collect();
    for (name, text) in catalogue::reproductions() {
        let named = text.lines().filter_map(|line| line.strip_prefix("code = \"")?.strip_suffix('"'));
        let missing: Vec<&str> = named.filter(|code| !root.join(code).is_file()).collect();
        assert!(missing.is_empty(), "{name} names code that is not there: {missing:?}");
    }
    assert_eq!(sorted(reproductions), files("docs/reproductions", ".toml"));
    assert_eq!(sorted(catalogue::scenes().map(|(name, _)| name.to_owned()).collect()), files("scenes", ".gltf"));
}
