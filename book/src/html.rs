//! Links in a built book.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{fs, io};

use crate::markdown::external;

/// The links of all pages in a folder that lead nowhere: to a file that is not there, or to a place that a page does not have.
///
/// # Errors
/// Where the folder or a page cannot be read.
pub fn broken(folder: &Path) -> io::Result<Vec<String>> {
    let mut pages = BTreeMap::new();
    read(folder, &mut pages)?;
    let wrong = |(page, text): (&PathBuf, &String)| {
        let links = ["href", "src"].into_iter().flat_map(|name| attributes(text, name));
        let nowhere = links.filter(|link| !leads(page, link, &pages));
        nowhere.map(|link| format!("{}: {link}", page.display())).collect::<Vec<_>>()
    };
    Ok(pages.iter().flat_map(wrong).collect())
}

fn read(folder: &Path, pages: &mut BTreeMap<PathBuf, String>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            read(&path, pages)?;
        } else if path.extension().is_some_and(|extension| extension == "html") {
            pages.insert(path.clone(), fs::read_to_string(&path)?);
        }
    }
    Ok(())
}

/// The values of an attribute.
fn attributes<'a>(text: &'a str, name: &str) -> impl Iterator<Item = &'a str> {
    let begins = format!(" {name}=\"");
    let from: Vec<usize> = text.match_indices(&begins).map(|(at, _)| at + begins.len()).collect();
    from.into_iter().map(|from| text[from..].split('"').next().unwrap_or_default())
}

fn leads(page: &Path, link: &str, pages: &BTreeMap<PathBuf, String>) -> bool {
    let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
    if external(link) || link.starts_with("data:") || link == "#" {
        return true;
    }
    let to = match path {
        "" => page.to_path_buf(),
        path => page.parent().unwrap_or(Path::new("")).join(path),
    };
    let Ok(to) = to.canonicalize() else { return false };
    let has = |(other, text): (&PathBuf, &String)| {
        other.canonicalize().is_ok_and(|other| other == to) && attributes(text, "id").any(|id| id == anchor)
    };
    anchor.is_empty() || pages.iter().any(has)
}
