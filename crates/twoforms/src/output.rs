//! Standard output and result files.

use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use anyhow::Result;
use twoforms_report::{Detail, Document, ReportError, csv, file, json, table};

use crate::args::Format;

/// Where the results of `compare` go. Made before anything is computed, so that a place that can't be written to is
/// known at once and nothing that was computed is lost.
pub struct Destination<'a> {
    format: Format,
    output: Option<&'a Path>,
    folder: Option<&'a Path>,
}

impl<'a> Destination<'a> {
    /// Tries every place that will be written to.
    pub fn new(format: Format, output: Option<&'a Path>, folder: Option<&'a Path>) -> Result<Self> {
        if let Some(path) = output {
            file::check(path)?;
        }
        if let Some(folder) = folder {
            file::make_folder(folder)?;
            for path in in_folder(folder) {
                file::check(&path)?;
            }
        }
        Ok(Self { format, output, folder })
    }

    /// Writes the folder, then the file or standard output.
    pub fn write(&self, document: &Document) -> Result<()> {
        if let Some(folder) = self.folder {
            let [json_path, csv_path] = in_folder(folder);
            file::save(&json_path, |out| json::write(document, out))?;
            file::save(&csv_path, |out| csv::write(document, out))?;
        }
        match self.output {
            Some(path) => file::save(path, |out| self.print(document, out))?,
            None => {
                let mut out = BufWriter::new(io::stdout().lock());
                self.print(document, &mut out)?;
                out.flush()?;
            }
        }
        Ok(())
    }

    fn print(&self, document: &Document, mut out: &mut dyn Write) -> Result<(), ReportError> {
        match self.format {
            Format::Json => json::write(document, &mut out),
            Format::Csv => csv::write(document, &mut out),
            Format::Table => {
                let detail = Detail::for_receivers(document.receivers().len());
                Ok(out.write_all(table::text(document, detail).as_bytes())?)
            }
        }
    }
}

fn in_folder(folder: &Path) -> [PathBuf; 2] {
    [folder.join("compare.json"), folder.join("compare.csv")]
}

/// Prints to standard output.
pub fn print(text: &str) -> Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    Ok(out.flush()?)
}

/// Whether an error only says that the reader of standard output has left, as `head` does: no failure.
pub fn reader_left(error: &anyhow::Error) -> bool {
    let broken = |cause: &(dyn std::error::Error + 'static)| {
        cause.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == ErrorKind::BrokenPipe)
    };
    error.chain().any(broken)
}
