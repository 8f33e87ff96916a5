//! The book on its way through mdBook: JSON in, JSON out.

use std::path::{Component, Path};

use serde_json::Value;

use crate::formulas;
use crate::markdown::{external, with_links};

/// Where links out of the book lead.
const REPOSITORY: &str = concat!(env!("CARGO_PKG_REPOSITORY"), "/blob/main");
/// The folder of the book in the repository.
const FOLDER: &str = "docs";

/// Why a book cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// mdBook said something else than a context and a book.
    #[error("standard input is no book from mdBook: {0}")]
    NoBook(String),
    /// A formula that is none.
    #[error("{page}: {error}")]
    Formula {
        /// The page.
        page: String,
        /// What is wrong with it.
        error: formulas::Error,
    },
}

/// The book in mdBook's `[context, book]`, with formulas as MathML and links that lead out of it led to the repository.
///
/// # Errors
/// Where the input is no book, or a formula no LaTeX.
pub fn prepared(input: &str) -> Result<Value, Error> {
    let mut both: Value = serde_json::from_str(input).map_err(|error| Error::NoBook(error.to_string()))?;
    let book = both.get_mut(1).map(Value::take).filter(Value::is_object);
    let mut book = book.ok_or_else(|| Error::NoBook("it has no second part".into()))?;
    prepare(&mut book)?;
    Ok(book)
}

/// Every chapter at or below a value.
fn prepare(value: &mut Value) -> Result<(), Error> {
    let page = value.get("source_path").and_then(Value::as_str).map(str::to_owned);
    if let (Some(page), Some(content)) = (page, value.get_mut("content")) {
        let text = content.as_str().unwrap_or_default();
        let led = with_links(text, |link| led(link, &page));
        let made = formulas::rendered(&led).map_err(|error| Error::Formula { page, error })?;
        *content = made.into();
    }
    match value {
        Value::Object(fields) => fields.values_mut().try_for_each(prepare),
        Value::Array(items) => items.iter_mut().try_for_each(prepare),
        _ => Ok(()),
    }
}

/// Where a link of a page leads in the book. A folder's README is its index there.
fn led(link: &str, page: &str) -> String {
    if external(link) || link.starts_with('#') {
        return link.to_owned();
    }
    let folder = Path::new(FOLDER).join(page);
    match normal(&folder.parent().unwrap_or(Path::new("")).join(link)) {
        path if path.starts_with(&format!("{FOLDER}/")) => link.replace("README.md", "index.md"),
        path => format!("{REPOSITORY}/{path}"),
    }
}

/// A path without `..`.
fn normal(path: &Path) -> String {
    let mut parts: Vec<String> = Vec::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(parts.pop()),
            Component::Normal(part) => parts.push(part.to_string_lossy().into_owned()),
            _ => (),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::{REPOSITORY, led, prepared};

    #[test]
    fn links_lead_within_the_book_or_to_the_repository() {
        assert_eq!(led("design.md#types", "reproductions/nori.md"), "design.md#types");
        assert_eq!(led("reproductions/README.md", "lecture.md"), "reproductions/index.md");
        assert_eq!(led("../../crates/a.rs", "reproductions/nori.md"), format!("{REPOSITORY}/crates/a.rs"));
        assert_eq!(led("https://a.b/c", "lecture.md"), "https://a.b/c");
    }

    #[test]
    fn chapters_are_prepared_at_any_depth() {
        let input = r#"[{}, {"items": [{"Chapter": {"source_path": "a.md", "content": "x",
            "sub_items": [{"Chapter": {"source_path": "b.md", "content": "$y$", "sub_items": []}}]}}]}]"#;
        let book = prepared(input).expect("a book");
        let below = &book["items"][0]["Chapter"]["sub_items"][0]["Chapter"]["content"];
        assert!(below.as_str().is_some_and(|content| content.starts_with("<math")), "{below}");
        assert!(prepared("{}").is_err() && prepared("[").is_err());
    }
}
