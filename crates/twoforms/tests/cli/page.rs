//! Pages with commands and what they print.

use std::collections::BTreeSet;

/// The fenced blocks of a page: language and text.
pub fn blocks(page: &str) -> Vec<(&str, String)> {
    let mut blocks: Vec<(&str, String)> = Vec::new();
    let mut open = false;
    for line in page.lines() {
        match line.trim_start().strip_prefix("```") {
            Some(_) if open => open = false,
            Some(language) => {
                blocks.push((language, String::new()));
                open = true;
            }
            None if open => blocks.last_mut().expect("an open block").1.extend([line, "\n"]),
            None => (),
        }
    }
    blocks
}

/// The words after `twoforms` in each command of a block that runs it.
pub fn commands(block: &str) -> Vec<String> {
    let whole = block.replace("\\\n", " ");
    let words = whole.lines().filter_map(|line| {
        let line = line.trim();
        line.strip_prefix("twoforms ").or_else(|| line.strip_prefix("cargo run --release -- "))
    });
    let words = words.map(|words| words.split([';', '|', '#']).next().unwrap_or_default());
    words.map(|words| words.split_whitespace().collect::<Vec<_>>().join(" ")).collect()
}

/// A line without what its width moves, and without a time at its end.
pub fn plain(line: &str) -> String {
    let words: Vec<&str> = line.split_whitespace().collect();
    let timed = matches!(words.last(), Some(&("ns" | "µs" | "ms" | "s")));
    words[..words.len() - if timed { 2 } else { 0 }].join(" ")
}

/// The lines of a text block that were not printed. `…` stands for lines, or for the rest of one, that are left out.
pub fn unprinted<'a>(text: &'a str, printed: &[String]) -> Vec<&'a str> {
    let known: BTreeSet<String> = printed.iter().map(|line| plain(line)).collect();
    let there = |line: &&str| match plain(line).strip_suffix('…') {
        Some(begin) => known.iter().any(|known| known.starts_with(begin.trim_end())),
        None => known.contains(&plain(line)) || line.trim_start().starts_with('─'),
    };
    text.lines().filter(|line| !there(line)).collect()
}

/// The text block with each line as it was printed: the next line that differs from it in numbers alone, if there is one.
pub fn mended(text: &str, printed: &[String]) -> String {
    let mut rest = printed.iter();
    let mut mend = |line: &str| {
        let same = |printed: &&String| !line.ends_with('…') && shape(printed) == shape(line);
        let found = rest.clone().position(|printed| same(&printed));
        let mended = found.and_then(|ahead| rest.nth(ahead)).map_or(line, |printed| printed);
        format!("{mended}\n")
    };
    text.lines().map(&mut mend).collect()
}

/// The words of a line, with one sign for all numbers and one for all rules.
fn shape(line: &str) -> String {
    let sign = |word: &str| {
        let bare = word.trim_matches(|c| "[](),;%".contains(c));
        match word {
            _ if bare == "–" || bare.parse::<f64>().is_ok() => "#".to_owned(),
            _ if word.starts_with('─') => "─".to_owned(),
            _ => word.to_owned(),
        }
    };
    plain(line).split(' ').map(sign).collect::<Vec<_>>().join(" ")
}

#[test]
fn lines_are_mended_by_those_that_differ_in_numbers_alone() {
    let printed = ["a  1", "────", "b  2.50 [1, 3]", "b  4 [1, 5]", "c"].map(str::to_owned);
    assert_eq!(mended("b 3 [2, 4]\n…\nb 3 [2, 4]\nd\n", &printed), "b  2.50 [1, 3]\n…\nb  4 [1, 5]\nd\n");
    assert_eq!(unprinted("a 1\n──\nb 4…\nb 3\n…\n", &printed), ["b 3"]);
    assert_eq!(commands("# x\ntwoforms a \\\n  --b 'c' | grep d\nls\n"), ["a --b 'c'"]);
}
