//! What has to be known of Markdown: where code is, where links lead, and the anchors of headings.

/// A piece of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part<'a> {
    /// Prose, formulas and links.
    Text(&'a str),
    /// A fenced block or a code span, with its marks.
    Code(&'a str),
}

/// The pieces of a page in order; together they are the page.
pub fn parts(page: &str) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let mut fence: Option<(usize, &str)> = None;
    let (mut text_from, mut at) = (0, 0);
    for line in page.split_inclusive('\n') {
        let end = at + line.len();
        match fence {
            None => {
                if let Some(mark) = fence_mark(line) {
                    spans(&page[text_from..at], &mut parts);
                    fence = Some((at, mark));
                }
            }
            Some((from, mark)) if line.trim_start().starts_with(mark) => {
                parts.push(Part::Code(&page[from..end]));
                (fence, text_from) = (None, end);
            }
            Some(_) => (),
        }
        at = end;
    }
    match fence {
        Some((from, _)) => parts.push(Part::Code(&page[from..])),
        None => spans(&page[text_from..], &mut parts),
    }
    parts
}

/// The mark that begins a fenced block, where the line begins one.
fn fence_mark(line: &str) -> Option<&'static str> {
    ["```", "~~~"].into_iter().find(|mark| line.trim_start().starts_with(mark))
}

/// Splits text at its code spans: n backticks up to the next n backticks.
fn spans<'a>(text: &'a str, parts: &mut Vec<Part<'a>>) {
    let mut rest = text;
    while let Some(start) = rest.find('`') {
        let ticks = rest[start..].bytes().take_while(|&byte| byte == b'`').count();
        let inside = &rest[start + ticks..];
        let Some(length) = closing(inside, ticks) else { break };
        let end = start + ticks + length + ticks;
        parts.extend([Part::Text(&rest[..start]), Part::Code(&rest[start..end])]);
        rest = &rest[end..];
    }
    parts.push(Part::Text(rest));
}

/// Where a run of exactly so many backticks begins.
fn closing(text: &str, ticks: usize) -> Option<usize> {
    let mut at = 0;
    while let Some(found) = text[at..].find('`') {
        let run = text[at + found..].bytes().take_while(|&byte| byte == b'`').count();
        if run == ticks {
            return Some(at + found);
        }
        at += found + run;
    }
    None
}

/// The page with the target of each link and image replaced.
pub fn with_links(page: &str, mut target: impl FnMut(&str) -> String) -> String {
    let mut changed = String::with_capacity(page.len());
    for part in parts(page) {
        let mut rest = match part {
            Part::Code(code) => {
                changed += code;
                continue;
            }
            Part::Text(text) => text,
        };
        while let Some(start) = rest.find("](").map(|at| at + 2) {
            let Some(length) = rest[start..].find(')') else { break };
            changed += &rest[..start];
            changed += &target(&rest[start..start + length]);
            rest = &rest[start + length..];
        }
        changed += rest;
    }
    changed
}

/// Where the links and images of a page lead.
pub fn links(page: &str) -> Vec<String> {
    let mut links = Vec::new();
    with_links(page, |target| {
        links.push(target.to_owned());
        target.to_owned()
    });
    links
}

/// Whether a link leads to another site.
pub fn external(link: &str) -> bool {
    link.contains("://") || link.starts_with("mailto:")
}

/// The anchors of a page's headings, as GitHub and mdBook make them.
pub fn anchors(page: &str) -> Vec<String> {
    let mut anchors: Vec<String> = Vec::new();
    let mut fenced = false;
    for line in page.lines() {
        fenced ^= fence_mark(line).is_some();
        let level = line.bytes().take_while(|&byte| byte == b'#').count();
        if fenced || level == 0 || !line[level..].starts_with(' ') {
            continue;
        }
        let slug = slug(line[level..].trim());
        let again = (1..).map(|k| format!("{slug}-{k}"));
        let free = std::iter::once(slug.clone()).chain(again).find(|slug| !anchors.contains(slug));
        anchors.extend(free);
    }
    anchors
}

fn slug(heading: &str) -> String {
    let mut shown = String::new();
    let mut rest = heading;
    while let Some(start) = rest.find("](") {
        shown += &rest[..start];
        rest = rest[start..].find(')').map_or("", |end| &rest[start + end + 1..]);
    }
    shown += rest;
    let kept = shown.chars().filter(|&c| c.is_alphanumeric() || "_- ".contains(c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect::<String>().to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::{Part, anchors, links, parts};

    #[test]
    fn code_is_told_from_text() {
        let page = "a `b` c\n```sh\n$ d `e`\n```\nf ``g ` h`` `i";
        let code: Vec<&str> = parts(page)
            .into_iter()
            .filter_map(|part| if let Part::Code(code) = part { Some(code) } else { None })
            .collect();
        assert_eq!(code, ["`b`", "```sh\n$ d `e`\n```\n", "``g ` h``"]);
        let whole: String = parts(page).into_iter().map(|(Part::Text(part) | Part::Code(part))| part).collect();
        assert_eq!(whole, page);
    }

    #[test]
    fn links_are_found_outside_code() {
        assert_eq!(links("[a](b.md#c) `[d](e)` ![f](g.svg) [`h`](../i.rs)"), ["b.md#c", "g.svg", "../i.rs"]);
    }

    #[test]
    fn headings_have_anchors() {
        let page = "# The two forms\n## `a/b`: what, and why\n```\n# no\n```\n## x, y\n## x, y\n";
        assert_eq!(anchors(page), ["the-two-forms", "ab-what-and-why", "x-y", "x-y-1"]);
    }
}
