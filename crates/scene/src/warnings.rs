//! Warnings, gathered: one line for each kind, with how often and where.

/// How many places a line names.
const NAMED: usize = 3;

/// The warnings of one load.
#[derive(Default)]
pub(crate) struct Warnings {
    kinds: Vec<Kind>,
}

struct Kind {
    text: String,
    count: usize,
    places: Vec<String>,
    /// Whether there are places that are not named.
    more: bool,
}

impl Warnings {
    /// Notes that `text` holds at the place called `name`.
    pub fn at(&mut self, text: &str, name: &str) {
        let kind = self.kind(text);
        kind.count += 1;
        let name = format!("{name:?}");
        if kind.places.contains(&name) {
            return;
        }
        kind.more = kind.places.len() == NAMED;
        if !kind.more {
            kind.places.push(name);
        }
    }

    /// Notes that `text` holds, of no particular place.
    pub fn say(&mut self, text: &str) {
        self.kind(text).count += 1;
    }

    /// One line for each kind, in the order in which they were first noted.
    pub fn lines(&self) -> Vec<String> {
        self.kinds.iter().map(Kind::line).collect()
    }

    fn kind(&mut self, text: &str) -> &mut Kind {
        let known = self.kinds.iter().position(|kind| kind.text == text);
        let index = known.unwrap_or(self.kinds.len());
        if known.is_none() {
            self.kinds.push(Kind { text: text.to_owned(), count: 0, places: Vec::new(), more: false });
        }
        &mut self.kinds[index]
    }
}

impl Kind {
    fn line(&self) -> String {
        let Self { text, count, places, more } = self;
        let names = places.join(", ");
        let more = if *more { ", …" } else { "" };
        match (places.len(), count) {
            (0, _) => text.clone(),
            (_, 1) => format!("{text}: {names}"),
            _ => format!("{text}: {count} ({names}{more})"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Warnings;

    #[test]
    fn lines_are_one_per_kind_with_counts_and_escaped_names() {
        let mut warnings = Warnings::default();
        warnings.say("animations are ignored");
        for name in ["a", "b\n", "c", "d"] {
            warnings.at("black metal", name);
        }
        warnings.at("unlit", "e");
        let expected = ["animations are ignored", r#"black metal: 4 ("a", "b\n", "c", …)"#, r#"unlit: "e""#];
        assert_eq!(warnings.lines(), expected);
    }
}
