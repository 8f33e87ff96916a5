//! The nearest word to one that nothing is called.

/// The word most like `name` by the Jaro–Winkler similarity, the first of several; `None` without words.
pub fn nearest(name: &str, words: &[impl AsRef<str>]) -> Option<String> {
    let likeness = |word: &str| strsim::jaro_winkler(word, name);
    let words = words.iter().map(AsRef::as_ref);
    words.rev().max_by(|a, b| likeness(a).total_cmp(&likeness(b))).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn the_most_alike_wins_and_of_equals_the_first() {
        assert_eq!(nearest("flor", &["wall", "floor"]).as_deref(), Some("floor"));
        assert_eq!(nearest("light", &["light.x", "light.y"]).as_deref(), Some("light.x"));
        assert_eq!(nearest("any", &[] as &[&str]), None);
    }
}
