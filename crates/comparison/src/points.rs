//! Files of receivers: a position and a normal in each line.

use std::fs;
use std::path::Path;

use glam::DVec3;

use crate::request::point;

/// Positions and unit normals, in the order of the lines. Empty lines and those that begin with # are passed over, and
/// so is a header: a first line that begins like no number, and in which no cell is one.
///
/// # Errors
/// Where the file can't be read or holds none, and at the first line that is none.
pub fn read(path: &Path) -> Result<Vec<(DVec3, DVec3)>, String> {
    let text = fs::read_to_string(path).map_err(|cause| {
        format!("cannot read {}: {cause}; give a text file with {FORM} in each line", path.display())
    })?;
    let points = lines(&text)
        .map(|(number, line)| parsed(line).map_err(|fault| format!("{}, line {number}: {fault}", path.display())));
    let points = points.collect::<Result<Vec<_>, String>>()?;
    if points.is_empty() {
        return Err(format!("{} holds no receiver; write {FORM} in a line for each", path.display()));
    }
    Ok(points)
}

/// Position and unit normal from six numbers between commas.
///
/// # Errors
/// What is wrong with them, and the form.
pub fn parsed(text: &str) -> Result<(DVec3, DVec3), String> {
    point(numbers(text, FORM)?)
}

/// Exactly K finite numbers, separated by commas; `form` says in errors how they are written.
///
/// # Errors
/// Where they are none, or not so many.
pub fn numbers<const K: usize>(text: &str, form: &str) -> Result<[f64; K], String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let number = |part: &&str| match part.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("\"{part}\" is not a finite number; the form is {form}")),
    };
    let values = parts.iter().map(number).collect::<Result<Vec<f64>, String>>()?;
    let count = values.len();
    values.try_into().map_err(|_| format!("has {count} numbers where {K} are needed; the form is {form}"))
}

/// What stands in a line.
const FORM: &str = "x,y,z,nx,ny,nz";

/// The lines that hold a point, by number from 1. Spreadsheets begin a file with U+FEFF.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let numbered = (1..).zip(text.trim_start_matches('\u{feff}').lines().map(str::trim));
    let mut said = numbered.filter(|(_, line)| !line.is_empty() && !line.starts_with('#')).peekable();
    said.next_if(|(_, line)| is_header(line));
    said
}

fn is_header(line: &str) -> bool {
    let begins_a_number = line.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    !begins_a_number && line.split(',').all(|cell| cell.trim().parse::<f64>().is_err())
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{lines, parsed};

    #[test]
    fn a_point_may_have_minus_signs_and_what_is_none_is_refused_with_the_form() {
        assert_eq!(parsed("-1,2,-3e-1,0,0,-7"), Ok((DVec3::new(-1.0, 2.0, -0.3), DVec3::NEG_Z)));
        for (text, says) in [
            ("1,2,3", "3 numbers where 6"),
            ("0,0,0,0,0,0", "no direction"),
            ("a,0,0,0,0,1", "\"a\""),
            ("NaN,0,0,0,0,1", "finite"),
        ] {
            assert!(parsed(text).is_err_and(|error| error.contains(says)), "{text}");
        }
    }

    #[test]
    fn comments_and_a_header_are_passed_over_and_nothing_else() {
        let held = |text| lines(text).collect::<Vec<_>>();
        assert_eq!(held("\u{feff}# mine\n\nx,y,z,nx,ny,nz\r\n 1,2,3,0,1,0 \r\n"), [(4, "1,2,3,0,1,0")]);
        assert_eq!(held("a,b\nc,d"), [(2, "c,d")]);
        assert_eq!(held("nan,0,0,0,1,0\n1"), [(1, "nan,0,0,0,1,0"), (2, "1")]);
        assert_eq!(held("0;0;0;0;1;0"), [(1, "0;0;0;0;1;0")]);
        assert_eq!(held("o.1,0,0,0,1,0"), [(1, "o.1,0,0,0,1,0")]);
    }
}
