//! Files of receivers: a position and a normal in each line.

use std::fs;
use std::path::Path;

use anyhow::{Result, anyhow, bail};
use glam::DVec3;

use crate::args;

/// Positions and unit normals, in the order of the lines. Empty lines and those that begin with # are passed over, and
/// so is a header: a first line that begins like no number, and in which no cell is one.
///
/// # Errors
/// Where the file can't be read or holds none, and at the first line that is none.
pub fn read(path: &Path) -> Result<Vec<(DVec3, DVec3)>> {
    let text = fs::read_to_string(path).map_err(|cause| {
        anyhow!("cannot read {}: {cause}; give a text file with {FORM} in each line", path.display())
    })?;
    let points = lines(&text)
        .map(|(number, line)| args::point(line).map_err(|fault| anyhow!("{}, line {number}: {fault}", path.display())));
    let points = points.collect::<Result<Vec<_>>>()?;
    if points.is_empty() {
        bail!("{} holds no receiver; write {FORM} in a line for each", path.display());
    }
    Ok(points)
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
    use super::lines;

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
