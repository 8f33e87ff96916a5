//! From the text of a file to its experiments, and errors that point at its lines.

use std::ops::Range;
use std::path::PathBuf;

use serde::de::DeserializeOwned;

use crate::schema::File;

/// What is wrong with a file or an experiment: where, what, and what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {message}")]
pub struct Error {
    /// File, line and column.
    pub place: String,
    /// What is wrong there.
    pub message: String,
}

/// The text of a file, and where it stands.
#[derive(Clone, Debug)]
pub struct Text {
    /// What messages call it.
    pub name: String,
    /// The folder that scenes are looked for in; none for the program's own.
    pub folder: Option<PathBuf>,
    /// The text.
    pub text: String,
}

impl Text {
    /// The experiments of the file.
    ///
    /// # Errors
    /// Where the text is no TOML, or a key, a type or a word is not one that a file can have.
    pub fn parse(&self) -> Result<File, Error> {
        self.read()
    }

    /// The text as a value of any kind.
    ///
    /// # Errors
    /// As [`parse`](Self::parse).
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, Error> {
        toml::from_str(&self.text).map_err(|error| {
            let message = helpful(error.message());
            error.span().map_or_else(
                || Error { place: self.name.clone(), message: message.clone() },
                |span| self.error(span, &message),
            )
        })
    }

    /// A path that the text names: relative to its folder.
    pub fn beside(&self, path: &str) -> PathBuf {
        self.folder.clone().unwrap_or_default().join(path)
    }

    /// An error at a place of the text.
    pub fn error(&self, at: Range<usize>, message: &str) -> Error {
        let before = &self.text[..at.start.min(self.text.len())];
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
        Error { place: format!("{}:{line}:{column}", self.name), message: message.to_owned() }
    }
}

/// The parser's message; of an unknown word, with the nearest known one instead of all.
fn helpful(message: &str) -> String {
    let words: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let kind = [("unknown field", "unknown key"), ("unknown variant", "unknown word")];
    let Some((_, said)) = kind.into_iter().find(|(said, _)| message.starts_with(said)) else {
        return message.to_owned();
    };
    match words[..] {
        [unknown, ref known @ ..] if !known.is_empty() => {
            format!("{said} \"{unknown}\"{}", hint(unknown, known))
        }
        _ => message.to_owned(),
    }
}

/// `; did you mean "…"?`, and otherwise what there is.
pub(crate) fn hint(unknown: &str, known: &[&str]) -> String {
    match twoforms_estimator::nearest::nearest(unknown, known) {
        Some(word) => format!("; did you mean \"{word}\"?"),
        None => format!(": there are {}", known.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::Text;

    fn error(text: &str) -> String {
        let text = Text { name: "mine.toml".into(), folder: None, text: text.into() };
        text.parse().expect_err("is wrong").to_string()
    }

    #[test]
    fn errors_point_at_the_line_and_name_the_nearest_word() {
        assert_eq!(
            error("title = \"t\"\n[[experiment]]\nreplicats = 3\n"),
            "mine.toml:3:1: unknown key \"replicats\"; did you mean \"replicates\"?"
        );
        let quantity = error("[[experiment]]\nvalues = [1]\n[[experiment.row]]\nquantity = \"variants\"\n");
        assert_eq!(quantity, "mine.toml:4:12: unknown word \"variants\"; did you mean \"variance\"?");
        let of_type = error("[[experiment]]\nreplicates = \"many\"\n");
        assert!(of_type.starts_with("mine.toml:2:14: invalid type: string \"many\""), "{of_type}");
        assert!(error("title = \n").starts_with("mine.toml:1:"), "{}", error("title = \n"));
    }
}
