//! The table that `compare` prints.

use crate::support::{has_all, twoforms};

/// The last paragraph of a table, its lines joined.
fn last_sentence(table: &str) -> String {
    let lines: Vec<&str> = table.trim_end().lines().collect();
    let begin = lines.iter().rposition(|line| line.is_empty()).map_or(0, |blank| blank + 1);
    lines[begin..].join(" ")
}

#[test]
fn the_table_ends_with_the_sentence_to_remember() {
    let line = "compare @cornell-box --receiver floor-lit --samples 16,64 --replicates 200 \
                --strategies hemisphere/uniform,hemisphere/cosine,area/uniform";
    let table = twoforms(line).printed();
    has_all(&table, &["1 receiver", "200 replicates", "seed 0", "floor-lit", "known 0.3798", "Rates"]);
    let sentence = last_sentence(&table);
    assert!(sentence.starts_with("area/uniform had the lowest variance: "), "{sentence}");
    has_all(&sentence, &["times lower than hemisphere/cosine", "N = 64", "± is 95 %", "the rays", "the time of"]);
    assert!(sentence.ends_with('.'), "{sentence}");
}

/// One density, both formulations: the same points, so neither can have the lower variance.
#[test]
fn the_crossed_row_ties_with_the_area_form() {
    let line = "compare @cornell-box --receiver floor-lit --samples 16 --replicates 100 \
                --strategies hemisphere/toward-lights,area/uniform";
    let sentence = last_sentence(&twoforms(line).printed());
    has_all(&sentence, &["area/uniform", "hemisphere/toward-lights", "had the same variance"]);
}

#[test]
fn many_receivers_make_a_short_table() {
    let table = twoforms("compare @cornell-box --grid 5,5 --samples 1,4 --replicates 3 --quiet").printed();
    assert!(table.contains("25 receivers") && table.lines().count() < 25 * 12, "{table}");
}
