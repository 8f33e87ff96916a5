//! The pages do what they say: every command in them runs, and prints what stands below it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::{env, fs};

use crate::page::{self, blocks, commands};
use crate::support::{finished, folder, names, program};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// README.md and all pages of the book.
fn pages() -> Vec<PathBuf> {
    let mut pages = vec![root().join("README.md")];
    for folder in ["docs", "docs/reproductions"] {
        let entries = fs::read_dir(root().join(folder)).expect("a folder");
        let paths = entries.map(|entry| entry.expect("an entry").path());
        pages.extend(paths.filter(|path| path.extension().is_some_and(|extension| extension == "md")));
    }
    pages
}

/// A folder like the repository's, with its scenes and reproductions and no results.
fn repository() -> PathBuf {
    let copy = folder("book");
    for part in ["scenes", "docs/reproductions", "out"] {
        fs::create_dir_all(copy.join(part)).expect("a folder");
    }
    for part in ["scenes", "docs/reproductions"] {
        for entry in fs::read_dir(root().join(part)).expect("a folder") {
            let path = entry.expect("an entry").path();
            fs::copy(&path, copy.join(part).join(path.file_name().expect("a name"))).expect("a copy");
        }
    }
    copy
}

fn printed(command: &str, at: &Path) -> String {
    let words = command.split(' ').map(|word| word.trim_matches('\''));
    let output = program().args(words).current_dir(at).output().expect("the program starts");
    let run = finished(output);
    assert_eq!(run.code, Some(0), "twoforms {command}: {}", run.err);
    run.out
}

/// With `TWOFORMS_WRITE_BOOK` set, lines that differ in numbers alone are written into the pages instead.
#[test]
fn every_command_in_the_pages_runs_and_prints_what_stands_below_it() {
    let (at, write) = (repository(), env::var_os("TWOFORMS_WRITE_BOOK").is_some());
    let (mut known, mut wrong) = (BTreeMap::new(), Vec::new());
    for page in pages() {
        let text = fs::read_to_string(&page).expect("a page");
        let (mut lines, mut mended) = (Vec::new(), text.clone());
        for (language, block) in blocks(&text) {
            match language {
                "toml" => written(&block, &at),
                "sh" => {
                    let outputs = commands(&block)
                        .into_iter()
                        .map(|command| known.entry(command).or_insert_with_key(|c| lines_of(c, &at)).clone());
                    lines = outputs.flatten().collect();
                }
                // The README's table is held to the program by `.ci/run`.
                "text" if !lines.is_empty() && !page.ends_with("../../README.md") => {
                    let missing = page::unprinted(&block, &lines);
                    wrong.extend(missing.iter().map(|line| format!("{}: {line}", page.display())));
                    if !missing.is_empty() {
                        mended = mended.replacen(&block, &page::mended(&block, &lines), 1);
                    }
                }
                _ => (),
            }
        }
        if write && mended != text {
            fs::write(&page, mended).expect("a page");
        }
    }
    assert!(known.len() > 20, "{} commands", known.len());
    assert!(write || wrong.is_empty(), "lines that are not printed:\n{}", wrong.join("\n"));
}

fn lines_of(command: &str, at: &Path) -> Vec<String> {
    printed(command, at).lines().map(str::to_owned).collect()
}

/// Writes a file of a page that begins with its name, `# experiment.toml`.
fn written(block: &str, at: &Path) {
    let name = block.lines().next().and_then(|line| line.strip_prefix("# ")).filter(|name| ends(name, "toml"));
    if let Some(name) = name {
        fs::write(at.join(name), block).expect("a file");
    }
}

/// The index of the lecture gives numbers in code type in its last column, and figures: the program prints and draws them.
#[test]
fn the_lectures_numbers_are_printed_and_its_figures_drawn() {
    let (page, at) = (fs::read_to_string(root().join("docs/lecture.md")).expect("a page"), folder("lecture"));
    let output = printed("reproduce lecture --quiet --out .", &at);
    let known: BTreeSet<&str> = output.split([' ', '\n', ',']).collect();
    let rows = page.lines().filter(|line| line.starts_with('|'));
    let last = rows.filter_map(|row| row.trim_end_matches('|').rsplit(" | ").next());
    let numbers: Vec<&str> = last.flat_map(|cell| cell.split('`').skip(1).step_by(2)).collect();
    let unknown: Vec<&&str> = numbers.iter().filter(|number| !known.contains(**number)).collect();
    assert!(numbers.len() > 40 && unknown.is_empty(), "not printed: {unknown:?}");
    are_drawn("lecture", &at, 3);
}

#[test]
fn the_figures_of_reproductions_are_drawn_by_the_program() {
    for (name, count) in [("square-crossings", 2), ("rates", 2)] {
        let at = folder(name);
        printed(&format!("reproduce {name} --quiet --out ."), &at);
        are_drawn(name, &at, count);
    }
}

/// Checks that the figures of a reproduction that pages show are those that were drawn into a folder.
fn are_drawn(reproduction: &str, folder: &Path, count: usize) {
    let mut shown = names(&root().join("docs/figures"));
    shown.retain(|name| name.starts_with(&format!("{reproduction}-")));
    assert_eq!(shown.len(), count, "{shown:?}");
    for name in shown {
        let kept = fs::read(root().join("docs/figures").join(&name)).ok();
        assert!(
            kept == fs::read(folder.join(&name)).ok(),
            "draw docs/figures/{name} anew: reproduce {reproduction} --out"
        );
    }
}

fn ends(name: &str, extension: &str) -> bool {
    Path::new(name).extension().is_some_and(|found| found == extension)
}
