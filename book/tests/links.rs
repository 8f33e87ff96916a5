//! Every link in the project's pages leads to something that is there, and every formula can be read.

use std::fs;
use std::path::{Path, PathBuf};

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
            let there = to.exists() && (anchor.is_empty() || anchors(&text(&to)).iter().any(|known| known == anchor));
            if !there {
                broken.push(format!("{}: {link}", page.display()));
            }
        }
    }
    assert!(broken.is_empty(), "links that lead nowhere:\n{}", broken.join("\n"));
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

/// The index of the lecture says which item of a file holds a formula: a link to the file, and beside it the item in code type.
#[test]
fn the_lecture_names_items_that_are_there() {
    let page = text(&root().join("docs/lecture.md"));
    let rows = page.lines().filter(|line| line.starts_with('|')).flat_map(|line| line.split("](../").skip(1));
    let mut named = 0;
    for (path, rest) in rows.filter_map(|after| after.split_once(')')) {
        let item = rest.split('`').nth(1).unwrap_or_else(|| panic!("no item beside {path}"));
        let code = text(&root().join(path));
        let defined =
            |name: &str| ["fn", "struct", "enum", "trait"].iter().any(|word| code.contains(&format!("{word} {name}")));
        assert!(item.split("::").all(|name| defined(name) || code.contains(&format!("impl {name}"))), "{path}: {item}");
        named += 1;
    }
    assert!(named >= 20, "{named} items");
}
