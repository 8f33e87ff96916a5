//! Every link in the project's pages leads to something that is there, and every formula can be read.

use std::path::{Path, PathBuf};
use std::{env, fs};

use twoforms_book::formulas;
use twoforms_book::markdown::{anchors, external, links};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the repository").to_path_buf()
}

/// All pages: those at the top, the scenes' and the book's.
fn pages() -> Vec<PathBuf> {
    let mut pages: Vec<PathBuf> =
        ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "scenes/README.md"].map(|name| root().join(name)).into();
    collect(&root().join("docs"), &mut pages);
    pages
}

fn collect(folder: &Path, pages: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(&path, pages);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            pages.push(path);
        }
    }
}

fn text(page: &Path) -> String {
    fs::read_to_string(page).unwrap_or_else(|error| panic!("{}: {error}", page.display()))
}

#[test]
fn links_lead_to_files_and_headings() {
    let mut broken = Vec::new();
    for page in pages() {
        for link in links(&text(&page)).into_iter().filter(|link| !external(link)) {
            let (path, anchor) = link.split_once('#').unwrap_or((&link, ""));
            let to = if path.is_empty() { page.clone() } else { page.parent().expect("a folder").join(path) };
            let there = to.exists() && (anchor.is_empty() || has(&to, anchor));
            if !there {
                broken.push(format!("{}: {link}", page.display()));
            }
        }
    }
    assert!(broken.is_empty(), "links that lead nowhere:\n{}", broken.join("\n"));
}

/// Whether a page has a heading, or a file of code a line, of this anchor.
fn has(page: &Path, anchor: &str) -> bool {
    match anchor.strip_prefix('L').filter(|_| page.extension().is_some_and(|extension| extension == "rs")) {
        Some(line) => line.parse().is_ok_and(|line: usize| (1..=text(page).lines().count()).contains(&line)),
        None => anchors(&text(page)).iter().any(|known| known == anchor),
    }
}

#[test]
fn the_book_lists_all_its_pages() {
    let docs = root().join("docs");
    let listed: Vec<PathBuf> = links(&text(&docs.join("SUMMARY.md"))).into_iter().map(|link| docs.join(link)).collect();
    let missing: Vec<PathBuf> = pages()
        .into_iter()
        .filter(|page| page.starts_with(&docs) && !page.ends_with("SUMMARY.md") && !listed.contains(page))
        .collect();
    assert!(missing.is_empty(), "SUMMARY.md does not list {missing:?}");
}

#[test]
fn formulas_can_be_read() {
    let mut formulas = 0;
    for page in pages() {
        let made = formulas::rendered(&text(&page)).unwrap_or_else(|error| panic!("{}: {error}", page.display()));
        formulas += made.matches("<math").count();
    }
    assert!(formulas > 20, "{formulas} formulas");
}

/// The index of the lecture says which item of a file holds a formula: a link to the line where it begins, and beside it the
/// item in code type. With `TWOFORMS_WRITE_BOOK` set, the lines are written into the page instead.
#[test]
fn the_lecture_s_links_lead_to_the_lines_of_its_items() {
    let at = root().join("docs/lecture.md");
    let page = text(&at);
    let mut made = String::new();
    let mut named = 0;
    for row in page.split_inclusive('\n') {
        let link = row.starts_with('|').then(|| CodeLink::first(row)).flatten();
        named += usize::from(link.is_some());
        made += &link.map_or_else(|| row.to_owned(), |link| row.replacen(&link.written, &link.as_it_should_be(), 1));
    }
    assert!(named >= 20, "{named} items");
    if env::var_os("TWOFORMS_WRITE_BOOK").is_some() {
        fs::write(&at, &made).expect("a page");
    } else {
        let moved = made.lines().zip(page.lines()).filter(|(made, kept)| made != kept);
        let moved: Vec<&str> = moved.map(|(made, _)| made).collect();
        assert!(moved.is_empty(), "items have moved: the lines are now\n{}", moved.join("\n"));
    }
}

/// `[file.rs:7](../folder/file.rs#L7) `, and the item in code type after it.
struct CodeLink {
    written: String,
    path: String,
    item: String,
}

impl CodeLink {
    fn first(row: &str) -> Option<Self> {
        let begin = row.find(".rs:").and_then(|at| row[..at].rfind('['))?;
        let (link, rest) = row[begin..].split_once(')')?;
        let path = link.split_once("](../").and_then(|(_, path)| path.split('#').next())?;
        let item = rest.split('`').nth(1)?;
        Some(Self { written: format!("{link})"), path: path.to_owned(), item: item.to_owned() })
    }

    fn as_it_should_be(&self) -> String {
        let Self { path, item, .. } = self;
        let file = path.rsplit('/').next().expect("a name");
        let line = line_of(&text(&root().join(path)), item).unwrap_or_else(|| panic!("there is no {item} in {path}"));
        format!("[{file}:{line}](../{path}#L{line})")
    }
}

/// The line, counted from 1, where an item begins: `name`, or `Type::name` in what stands under that type.
fn line_of(code: &str, item: &str) -> Option<usize> {
    let (owner, name) = item.split_once("::").map_or((None, item), |(owner, name)| (Some(owner), name));
    let mut within = owner.is_none();
    for (k, line) in code.lines().enumerate() {
        let words: Vec<&str> = line.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
        if owner.is_some() && ["impl", "trait", "pub trait"].iter().any(|opens| line.starts_with(opens)) {
            within = words.iter().any(|word| Some(*word) == owner);
        }
        let defines = |pair: &[&str]| ["fn", "struct", "enum", "trait"].contains(&pair[0]) && pair[1] == name;
        if within && words.windows(2).any(defines) {
            return Some(k + 1);
        }
    }
    None
}
