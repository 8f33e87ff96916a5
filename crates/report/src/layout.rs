//! Columns that line up, and names and sentences that fit.

use comfy_table::{Cell, CellAlignment, ColumnConstraint, ContentLineStyle, LineStyle, Table, TableStyle};

use crate::number::NONE;

/// Longest line of a table.
const TABLE_WIDTH: usize = 120;

/// Longest name of a strategy in a table, and the shortest that it is cut to.
const NAMES: [usize; 2] = [33, 12];

/// Longest line of running text.
const TEXT_WIDTH: usize = 110;

/// Lines of a table: header, rule, rows; `names` columns to the left, numbers to the right. Columns that say nothing
/// are hidden: those without any value, and the sampler where there is one alone.
pub(crate) fn layout(header: &[&str], rows: impl Iterator<Item = Vec<String>>, names: usize) -> Vec<String> {
    let mut table = Table::new();
    table.load_style(STYLE).set_header(header).add_rows(rows);
    let silent: Vec<bool> = (0..header.len()).map(|column| is_silent(&table, column, header[column])).collect();
    for (i, column) in table.column_iter_mut().enumerate() {
        column.set_padding((if i == 0 { 2 } else { 0 }, u16::from(i + 1 < header.len())));
        column.set_cell_alignment(if i < names { CellAlignment::Left } else { CellAlignment::Right });
        if silent[i] {
            column.set_constraint(ColumnConstraint::Hidden);
        }
    }
    table.lines().map(|line| line.trim_end().to_owned()).collect()
}

/// The lines that `layout` makes of names of at most so many characters, which are as many as the table's width allows;
/// `longest` is the length of the longest name.
pub(crate) fn fitting(longest: usize, layout: impl Fn(usize) -> Vec<String>) -> Vec<String> {
    let [most, least] = NAMES;
    let longest = longest.min(most);
    let lines = layout(longest);
    let width = lines.iter().map(|line| line.chars().count()).max().unwrap_or(0);
    if width <= TABLE_WIDTH { lines } else { layout(longest.saturating_sub(width - TABLE_WIDTH).max(least)) }
}

const STYLE: TableStyle = TableStyle::new()
    .header_lines(ContentLineStyle::none())
    .header_separator(LineStyle::none().fill('─').junction('─'))
    .content_lines(ContentLineStyle::none());

fn is_silent(table: &Table, column: usize, name: &str) -> bool {
    let mut cells: Vec<String> = table.column_cells_iter(column).flatten().map(Cell::content).collect();
    cells.retain(|cell| !cell.is_empty() && cell != NONE);
    cells.dedup();
    cells.is_empty() || (name == "sampler" && cells.len() == 1)
}

/// A name without the characters that would break a line.
pub(crate) fn plain(name: &str) -> String {
    name.chars().flat_map(|c| if c.is_control() { c.escape_default().collect() } else { vec![c] }).collect()
}

/// A name of at most `longest` characters: its beginning, `…`, its end.
pub(crate) fn elided(name: &str, longest: usize) -> String {
    let characters: Vec<char> = plain(name).chars().collect();
    if characters.len() <= longest {
        return characters.into_iter().collect();
    }
    let (head, tail) = (&characters[..longest / 2], &characters[characters.len() + 1 + longest / 2 - longest..]);
    head.iter().chain(&['…']).chain(tail).collect()
}

/// A note under a table: wrapped, its first line indented, the others more.
pub(crate) fn note(text: &str) -> String {
    format!("  {}", wrapped(text).replace('\n', "\n    "))
}

/// `text` broken at spaces into lines of at most [`TEXT_WIDTH`] characters.
pub(crate) fn wrapped(text: &str) -> String {
    let (mut lines, mut width) = (String::new(), 0);
    for word in text.split(' ') {
        let length = word.chars().count();
        let (gap, before) = match width {
            0 => ("", 0),
            _ if width + 1 + length > TEXT_WIDTH => ("\n", 0),
            _ => (" ", width + 1),
        };
        lines += gap;
        lines += word;
        width = before + length;
    }
    lines
}
