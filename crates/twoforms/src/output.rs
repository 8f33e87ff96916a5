//! Standard output and result files.

use std::io::{self, BufWriter, ErrorKind, Write};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

use twoforms_report::{Detail, Document, ExactDocument, ReportError, csv, file, json, table};
use twoforms_reproduction::Text;

use crate::args::Format;

/// Results in each format.
pub trait Printed {
    /// What their files in a folder are called, without the ending.
    const NAME: &'static str;
    /// One document for scripts.
    fn json(&self, out: &mut dyn Write) -> Result<(), ReportError>;
    /// Lines for scripts.
    fn csv(&self, out: &mut dyn Write) -> Result<(), ReportError>;
    /// For people.
    fn table(&self) -> String;
}

impl Printed for Document {
    const NAME: &'static str = "compare";

    fn json(&self, out: &mut dyn Write) -> Result<(), ReportError> {
        json::write(self, out)
    }

    fn csv(&self, out: &mut dyn Write) -> Result<(), ReportError> {
        csv::write(self, out)
    }

    fn table(&self) -> String {
        table::text(self, Detail::for_receivers(self.receivers().len()))
    }
}

impl Printed for ExactDocument {
    const NAME: &'static str = "exact";

    fn json(&self, out: &mut dyn Write) -> Result<(), ReportError> {
        self.write_json(out)
    }

    fn csv(&self, out: &mut dyn Write) -> Result<(), ReportError> {
        self.write_csv(out)
    }

    fn table(&self) -> String {
        self.text()
    }
}

/// Where results go: one [`Printed`] of a kind. Made before anything is computed, so that a place that can't be written to is
/// known at once and nothing that was computed is lost.
pub struct Destination<'a, P> {
    format: Format,
    output: Option<&'a Path>,
    folder: Option<&'a Path>,
    /// The experiment's file, written into the folder too.
    experiment: Option<&'a Text>,
    what: PhantomData<P>,
}

impl<'a, P: Printed> Destination<'a, P> {
    /// Tries every place that will be written to.
    pub fn new(
        format: Format,
        output: Option<&'a Path>,
        folder: Option<&'a Path>,
        experiment: Option<&'a Text>,
    ) -> Result<Self, ReportError> {
        if let Some(path) = output {
            file::check(path)?;
        }
        if let Some(folder) = folder {
            file::make_folder(folder)?;
            for path in in_folder::<P>(folder) {
                file::check(&path)?;
            }
            if experiment.is_some() {
                file::check(&folder.join(EXPERIMENT))?;
            }
        }
        Ok(Self { format, output, folder, experiment, what: PhantomData })
    }

    /// Writes the folder, then the file or standard output.
    pub fn write(&self, results: &P) -> Result<(), ReportError> {
        if let Some(folder) = self.folder {
            let [json_path, csv_path] = in_folder::<P>(folder);
            file::save(&json_path, |out| results.json(out))?;
            file::save(&csv_path, |out| results.csv(out))?;
            if let Some(text) = self.experiment {
                save_text(&folder.join(EXPERIMENT), text)?;
            }
        }
        write_to(self.output, |out| match self.format {
            Format::Json => results.json(out),
            Format::Csv => results.csv(out),
            Format::Table => Ok(out.write_all(results.table().as_bytes())?),
        })
    }
}

/// Writes to `output`, or to standard output where there is none.
pub fn write_to(
    output: Option<&Path>,
    content: impl Fn(&mut dyn Write) -> Result<(), ReportError>,
) -> Result<(), ReportError> {
    if let Some(path) = output {
        return file::save(path, content);
    }
    let mut out = BufWriter::new(io::stdout().lock());
    content(&mut out)?;
    Ok(out.flush()?)
}

/// The experiment's file among the results.
pub const EXPERIMENT: &str = "experiment.toml";

/// Writes a file of experiments as it was run.
pub fn save_text(path: &Path, text: &Text) -> Result<(), ReportError> {
    file::save(path, |out| Ok(out.write_all(text.text.as_bytes())?))
}

fn in_folder<P: Printed>(folder: &Path) -> [PathBuf; 2] {
    ["json", "csv"].map(|ending| folder.join(P::NAME).with_extension(ending))
}

/// Prints to standard output.
pub fn print(text: &str) -> Result<(), ReportError> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    Ok(out.flush()?)
}

/// Says one line on standard error. Where that takes nothing, there is nobody left to tell.
pub fn say(line: &str) {
    let _ = writeln!(io::stderr(), "{}", plain(line));
}

/// A text in one line, without the characters that command a terminal: names come from files.
pub fn plain(text: &str) -> String {
    let written = |c: char| if c.is_control() { c.escape_default().collect() } else { String::from(c) };
    text.chars().map(written).collect()
}

/// Whether an error only says that the reader of standard output has left, as `head` does: no failure.
pub fn reader_left(error: &anyhow::Error) -> bool {
    let stream = error.downcast_ref::<ReportError>();
    stream.is_some_and(|error| matches!(error, ReportError::Stream { cause } if cause.kind() == ErrorKind::BrokenPipe))
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn a_name_from_a_file_cannot_command_the_terminal() {
        assert_eq!(plain("\u{1b}[31mred\nline é"), "\\u{1b}[31mred\\nline é");
    }
}
