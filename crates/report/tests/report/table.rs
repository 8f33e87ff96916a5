//! The tables for people.

use crate::support::{document, receiver, receivers, row, rows, verdict};
use twoforms_comparison::result::{Chebyshev, Rate, ReceiverResult, Verdict};
use twoforms_report::table::{Detail, text};

#[test]
fn every_row_of_two_receivers() {
    let expected = include_str!("table_every_row.txt");
    assert_eq!(text(&document(receivers()), Detail::EveryRow), expected);
}

#[test]
fn the_largest_count_of_two_receivers() {
    let expected = include_str!("table_largest_count.txt");
    assert_eq!(text(&document(receivers()), Detail::LargestCount), expected);
}

#[test]
fn many_receivers_are_condensed() {
    assert_eq!(Detail::for_receivers(12), Detail::EveryRow);
    assert_eq!(Detail::for_receivers(13), Detail::LargestCount);
}

#[test]
fn nothing_is_wider_than_120_columns_and_no_name_breaks_a_line() {
    let mut receivers = receivers();
    receivers[0].name = "a name of two\nlines".into();
    let mut long = row("mis/balance(area/solid-angle:2,hemisphere/brdf:1)", 65_536, 123_456.0, 1e-12);
    let fits = |receivers: &[ReceiverResult], name: &str| {
        let text = text(&document(receivers.to_vec()), Detail::LargestCount);
        assert!(text.lines().all(|line| line.chars().count() <= 120 && line == line.trim_end()), "{text}");
        assert!(text.contains("a name of two\\nlines\n"), "{text}");
        assert!(text.contains(name), "{text}");
    };
    receivers[0].rows.push(long.clone());
    fits(&receivers, "  mis/balance(area…misphere/brdf:1)  ");
    long.sampler = "multi-jittered".into();
    receivers[0].rows.push(long);
    fits(&receivers, "multi-jittered");
}

#[test]
fn a_value_that_is_missing_is_a_dash_and_a_broken_bound_shows() {
    let mut rows = rows(1.0);
    (rows[0].variance_of_mean, rows[0].variance_interval) = (None, None);
    rows[1].chebyshev = rows[1].chebyshev.map(|chebyshev| Chebyshev { outside: 0.12, ..chebyshev });
    let text = text(&document(vec![receiver("x", rows)]), Detail::EveryRow);
    assert!(text.contains("hemisphere/uniform     1  0.5883         –        –       0.30 %"), "{text}");
    assert!(text.contains("12 % > 10 %"), "{text}");
    assert!(!text.contains("  exact  "), "no row has an exact variance, so there is no column for it: {text}");
}

#[test]
fn no_receiver_gives_no_table() {
    let text = text(&document(Vec::new()), Detail::EveryRow);
    assert!(text.starts_with("scenes/box.gltf · 0 receivers · seed"), "{text}");
}

#[test]
fn rates_are_pooled_and_regimes_counted() {
    let mut receivers = vec![receiver("x", rows(1.0)), receiver("y", rows(1.0)), receiver("z", rows(1.0))];
    let [one, two, three] = [0, 1, 2].map(|strategy| receivers[1].rates[strategy].clone());
    receivers[1].rates = vec![
        Rate { slope: None, interval: None, regime: None, candidates: Vec::new(), ..one },
        Rate { slope: Some(-1.303), regime: Some("other".into()), candidates: vec!["other".into()], ..two },
        Rate { interval: None, ..three },
    ];
    let text = text(&document(receivers), Detail::EveryRow);
    // Half-widths of 0.03: 0.03/√2 = 0.021 over two receivers, 0.03/√3 = 0.017 over three.
    assert!(text.contains("  hemisphere/uniform  -1.003  [-1.024, -0.982]  "), "{text}");
    assert!(text.contains("  hemisphere/cosine   -1.103  [-1.120, -1.086]  "), "{text}");
    assert!(text.contains("1/N at 2 of 3 receivers, other at 1 of 3 receivers\n"), "{text}");
    assert!(text.contains("  area/uniform        -1.003                 –  "), "{text}");
}

#[test]
fn verdicts_are_counted_and_biases_named() {
    let mut receivers = [1.0, 1.0, 1.0].map(|scale| receiver("far", rows(scale)));
    let note = "there is a bias, below the margin";
    let biased = Verdict {
        interval: Some([-0.003, -0.001]),
        detectable: Some(0.001),
        ..verdict("area/uniform", "biased", note)
    };
    let few = verdict("area/uniform", "undecided", "too few to judge by");
    receivers[0].name = "near a\nlamp".into();
    receivers[0].verdicts.push(biased);
    receivers[1].verdicts.push(Verdict { samples_needed: Some(5e5), ..few.clone() });
    receivers[2].verdicts.push(Verdict { samples_needed: Some(4e5), detectable: Some(0.01), ..few });
    let text = text(&document(receivers.into()), Detail::EveryRow);
    let lines: Vec<&str> =
        text.lines().skip_while(|line| !line.starts_with("Bias")).take_while(|l| !l.is_empty()).collect();
    assert_eq!(lines[0], "Bias: at familywise level 0.01, against a margin of 1.0 % of E");
    assert_eq!(lines[3], "  area/uniform         0          2       1   0.17 % to 1.7 %         5.000e5");
    assert_eq!(
        lines[4],
        format!("  biased: area/uniform at near a\\nlamp, by -0.003000 to -0.001000 where E = 0.5883: {note}")
    );
    assert_eq!(lines[5], "  undecided, too few to judge by: area/uniform at 2 receivers");
    assert_eq!(lines.len(), 6, "{text}");
}
