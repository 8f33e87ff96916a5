//! JSON for scripts.

use std::io::Write;

use crate::document::Document;
use crate::error::ReportError;

/// Writes `document` as indented JSON with a final newline. Numbers carry the shortest digits that read back to the same bits.
///
/// # Errors
/// [`ReportError::Stream`] where `out` takes no more. A document holds no NaN and no infinity, so that every `null`
/// means "no value".
pub fn write(document: &Document, mut out: impl Write) -> Result<(), ReportError> {
    serde_json::to_writer_pretty(&mut out, document).map_err(std::io::Error::from)?;
    Ok(out.write_all(b"\n")?)
}
