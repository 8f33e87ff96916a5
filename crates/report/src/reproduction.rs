//! Reproductions: the document, its table, its CSV and its figures.

use std::fmt::Write as _;
use std::io::Write;

use ::csv::Writer;
use serde::Serialize;
use twoforms_reproduction::{Plot, Reproduction, Row, Section, Verdict};

use crate::error::ReportError;
use crate::figure::{Axis, Figure, Line, Scale, number};
use crate::finite;
use crate::layout::{layout, wrapped};
use crate::number::{NONE, rounded};

/// Name and version of the format.
pub const SCHEMA: &str = "twoforms.reproduce/1";

/// What `twoforms reproduce` says, in this order.
#[derive(Clone, Debug, Serialize)]
pub struct ReproductionDocument<'a> {
    schema: &'static str,
    reproductions: Vec<Entry<'a>>,
}

#[derive(Clone, Debug, Serialize)]
struct Entry<'a> {
    name: &'a str,
    title: &'a str,
    source: &'a str,
    derivation: &'a str,
    seed: String,
    rows: Vec<&'a Row>,
    #[serde(skip)]
    whole: &'a Reproduction,
}

impl<'a> ReproductionDocument<'a> {
    /// A document of these results.
    ///
    /// # Errors
    /// [`ReportError::NotFinite`] where a number is NaN or infinite.
    pub fn new(reproductions: &'a [Reproduction]) -> Result<Self, ReportError> {
        let entry = |whole: &'a Reproduction| Entry {
            name: &whole.name,
            title: &whole.title,
            source: &whole.source,
            derivation: &whole.derivation,
            seed: whole.seed.to_string(),
            rows: whole.rows().collect(),
            whole,
        };
        let document = Self { schema: SCHEMA, reproductions: reproductions.iter().map(entry).collect() };
        finite::check("document", &document)?;
        Ok(document)
    }

    /// Writes indented JSON with a final newline.
    ///
    /// # Errors
    /// [`ReportError::Stream`] where `out` takes no more.
    pub fn write_json(&self, mut out: impl Write) -> Result<(), ReportError> {
        serde_json::to_writer_pretty(&mut out, self).map_err(std::io::Error::from)?;
        Ok(out.write_all(b"\n")?)
    }

    /// Writes one line per row; a missing value is `NaN`.
    ///
    /// # Errors
    /// [`ReportError::Stream`] where `out` takes no more.
    pub fn write_csv(&self, out: impl Write) -> Result<(), ReportError> {
        let mut csv = Writer::from_writer(out);
        csv.write_record(COLUMNS).map_err(std::io::Error::from)?;
        for entry in &self.reproductions {
            for row in &entry.rows {
                csv.write_record(record(entry.name, row)).map_err(std::io::Error::from)?;
            }
        }
        Ok(csv.flush()?)
    }

    /// Tables for people: a block per experiment, and a line that says how many rows hold.
    pub fn text(&self) -> String {
        self.reproductions.iter().map(|entry| block(entry.whole)).collect::<Vec<_>>().join("\n")
    }
}

const COLUMNS: [&str; 10] = [
    "reproduction",
    "experiment",
    "quantity",
    "published",
    "exact",
    "measured",
    "interval_low",
    "interval_high",
    "verdict",
    "note",
];

fn record(name: &str, row: &Row) -> Vec<String> {
    let number = |value: Option<f64>| format!("{:?}", value.unwrap_or(f64::NAN));
    let names = [name, &row.experiment, &row.quantity].map(str::to_owned);
    let ends = [0, 1].map(|end| row.interval.map(|interval| interval[end]));
    let values = [row.published, row.exact, row.measured, ends[0], ends[1]].map(number);
    let words = [verdict(row.verdict).to_owned(), row.note.clone().unwrap_or_default()];
    [&names[..], &values, &words].concat()
}

fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Agrees => "agrees",
        Verdict::Exact => "exact",
        Verdict::Differs => "differs",
        Verdict::Undecided => "undecided",
    }
}

const HEADER: [&str; 6] = ["quantity", "published", "exact", "ours", "±", "verdict"];

fn block(of: &Reproduction) -> String {
    let mut text = format!("{}: {}\n{}\n", of.name, of.title, wrapped(&format!("source: {}", of.source)));
    if !of.derivation.is_empty() {
        let _ = writeln!(text, "{}", wrapped(&format!("derivation: {}", of.derivation)));
    }
    let _ = writeln!(text, "seed {}", of.seed);
    for section in of.sections.iter().filter(|section| !section.rows.is_empty()) {
        let _ = write!(text, "\n{}", section_text(section));
    }
    let count = |verdict: Verdict| of.rows().filter(|row| row.verdict == verdict).count();
    let [agrees, exact, differs, undecided] =
        [Verdict::Agrees, Verdict::Exact, Verdict::Differs, Verdict::Undecided].map(count);
    let _ = writeln!(
        text,
        "\n{} rows: {agrees} agree, {exact} exact, {differs} differ, {undecided} undecided",
        of.rows().count()
    );
    text
}

fn section_text(section: &Section) -> String {
    let mut text = section.title.clone() + "\n";
    for line in section.formula.iter().chain(&section.code) {
        let _ = writeln!(text, "  {line}");
    }
    for line in layout(&HEADER, section.rows.iter().map(cells), 1) {
        text += &line;
        text.push('\n');
    }
    for row in &section.rows {
        if let Some(note) = &row.note {
            let _ = writeln!(text, "  {}: {note}", row.quantity);
        }
    }
    text
}

fn cells(row: &Row) -> Vec<String> {
    let cell = |value: Option<f64>| value.map_or(NONE.to_owned(), |value| rounded(value, DIGITS));
    let half = row.interval.map(|[low, high]| rounded(0.5 * (high - low), 2));
    let printed = row.expected[0].map_or(NONE.to_owned(), |printed| printed.value.to_string());
    vec![
        row.quantity.clone(),
        printed,
        exact(row),
        cell(row.measured),
        half.unwrap_or(NONE.to_owned()),
        verdict(row.verdict).to_owned(),
    ]
}

/// What is exact in seven digits, or in as many as it stands beside; a count as one, and what its own error bound does not
/// tell from zero as zero.
fn exact(row: &Row) -> String {
    let digits = row.expected.iter().flatten().map(|printed| printed.digits).fold(DIGITS, usize::max);
    match row.finding.exact {
        None => NONE.to_owned(),
        Some([count, 0.0]) if count.fract() == 0.0 => count.to_string(),
        Some([value, error]) if value.abs() <= error => format!("0 ± {error:.0e}"),
        Some([value, _]) => rounded(value, digits),
    }
}

/// Digits of values.
const DIGITS: usize = 7;

/// Colours of lines, readable on white and on dark.
const COLOURS: [&str; 8] = ["#3b82c4", "#d9822b", "#3f9c64", "#c2495a", "#8a63c9", "#9a7b3f", "#2aa3a3", "#b15fa5"];

/// A plot as the text of an SVG file; `None` where it has no point.
pub fn svg(plot: &Plot) -> Option<String> {
    let axis = |k: usize| Axis {
        name: plot.axes[k].clone(),
        scale: if plot.logarithmic[k] { Scale::Decades(number) } else { Scale::Even },
    };
    let mixed = plot.lines.iter().any(|line| !line.exact);
    let line = |(k, line): (usize, &twoforms_reproduction::plot::Line)| Line {
        name: line.name.clone(),
        colour: COLOURS[k % COLOURS.len()],
        dashed: line.exact && mixed,
        marked: line.points.len() <= MOST_MARKED && !(line.exact && mixed),
        points: line.points.clone(),
    };
    let lines: Vec<Line> = plot.lines.iter().enumerate().map(line).collect();
    let some = lines.iter().any(|line| !line.points.is_empty());
    some.then(|| Figure { title: plot.title.clone(), across: axis(0), up: axis(1), lines }.to_svg())
}

/// Points of a line from which on they are not marked.
const MOST_MARKED: usize = 20;
