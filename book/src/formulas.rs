//! `$…$` and `$$…$$` to MathML.

use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser, Storage, push_mathml};

use crate::markdown::{Part, parts};

/// A formula that is no LaTeX.
#[derive(Debug, thiserror::Error)]
#[error("the formula {latex} cannot be read: {reason}")]
pub struct Error {
    latex: String,
    reason: String,
}

/// The page with its formulas outside code as MathML.
///
/// `$$` stands around a formula of its own paragraph; a single `$` touches its formula on the inside, on one line.
///
/// # Errors
/// Where a formula is no LaTeX.
pub fn rendered(page: &str) -> Result<String, Error> {
    let mut made = String::with_capacity(2 * page.len());
    for part in parts(page) {
        match part {
            Part::Code(code) => made += code,
            Part::Text(text) => of_text(text, &mut made)?,
        }
    }
    Ok(made)
}

fn of_text(text: &str, made: &mut String) -> Result<(), Error> {
    let mut rest = text;
    while let Some(start) = rest.find('$') {
        made.push_str(&rest[..start]);
        rest = &rest[start..];
        let (mark, formula) = match rest.strip_prefix("$$") {
            Some(inside) => ("$$", inside.find("$$").map(|end| &inside[..end])),
            None => ("$", inline(&rest[1..])),
        };
        let Some(latex) = formula else {
            made.push_str(mark);
            rest = &rest[mark.len()..];
            continue;
        };
        made.push_str(&mathml(latex, mark == "$$")?);
        rest = &rest[2 * mark.len() + latex.len()..];
    }
    made.push_str(rest);
    Ok(())
}

/// The formula up to the next `$`, where it is one and not two sums of money.
fn inline(inside: &str) -> Option<&str> {
    let formula = &inside[..inside.find('$')?];
    let after = inside[formula.len() + 1..].chars().next();
    let tight = !formula.is_empty() && formula.trim() == formula && !formula.contains('\n');
    (tight && !after.is_some_and(|next| next.is_ascii_digit())).then_some(formula)
}

fn mathml(latex: &str, displayed: bool) -> Result<String, Error> {
    let wrong = |reason: String| Error { latex: latex.trim().to_owned(), reason };
    let storage = Storage::new();
    let events = Parser::new(latex.trim(), &storage).collect::<Result<Vec<_>, _>>();
    let events = events.map_err(|error| wrong(error.to_string()))?;
    let display_mode = if displayed { DisplayMode::Block } else { DisplayMode::Inline };
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    let mut math = String::new();
    let events = events.into_iter().map(Ok::<_, std::convert::Infallible>);
    push_mathml(&mut math, events, config).map_err(|error| wrong(error.to_string()))?;
    let math = shielded(&math.replace('\n', " "));
    Ok(if displayed { format!("\n<div class=\"formula\">{math}</div>\n") } else { math })
}

/// MathML whose text Markdown lets alone.
fn shielded(math: &str) -> String {
    let mut inside_tag = false;
    let shield = |c: char| {
        inside_tag = (inside_tag || c == '<') && c != '>';
        match c {
            '*' | '_' | '[' | ']' | '\\' | '|' | '~' | '`' if !inside_tag => format!("&#{};", u32::from(c)),
            c => c.to_string(),
        }
    };
    math.chars().map(shield).collect()
}

#[cfg(test)]
mod tests {
    use super::rendered;

    #[test]
    fn formulas_become_mathml_and_code_stays() {
        let page = rendered("so $a_b$ is, `$c$` not\n\n$$\n\\frac{1}{N}\n$$\n").expect("formulas");
        assert!(
            page.starts_with("so <math") && page.contains("`$c$` not") && page.contains("display=\"block\""),
            "{page}"
        );
        assert!(page.contains("<mfrac>") && !page.contains("$$"), "{page}");
    }

    #[test]
    fn money_is_no_formula() {
        let page = "it costs $5 or $6, and a $ alone";
        assert_eq!(rendered(page).expect("none"), page);
    }

    #[test]
    fn what_is_no_formula_is_told() {
        let error = rendered("$$\\frac{1}$$").expect_err("half a fraction").to_string();
        assert!(error.contains("\\frac{1}"), "{error}");
    }
}
