//! Files that are whole or not there.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::error::ReportError;

/// Writes the file `path` with `content`: first under a temporary name in the same folder, then renamed.
///
/// So a reader sees the old file or the new one, never half of it. A link keeps pointing where it did. What is no
/// regular file (`/dev/null`, a pipe) is written to as it is.
///
/// # Errors
/// [`ReportError::File`] where the folder is missing or may not be written, and whatever `content` returns.
///
/// # Example
/// `file::save("results.csv".as_ref(), |out| csv::write(&document, out))`
pub fn save<F>(path: &Path, content: F) -> Result<(), ReportError>
where
    F: FnOnce(&mut dyn Write) -> Result<(), ReportError>,
{
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    match fs::metadata(&target) {
        Ok(found) if found.is_dir() => Err(io::Error::from(io::ErrorKind::IsADirectory).into()),
        Ok(found) if !found.is_file() => write_to(&target, content),
        _ => write_beside(&target, content),
    }
    .map_err(|error| error.at(path))
}

/// Tries whether `path` can be written, and leaves what is there untouched: to be known before hours of computing.
///
/// # Errors
/// [`ReportError::File`] where [`save`] would fail for the folder's sake.
pub fn check(path: &Path) -> Result<(), ReportError> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    match fs::metadata(&target) {
        Ok(found) if found.is_dir() => Err(io::Error::from(io::ErrorKind::IsADirectory).into()),
        Ok(found) if !found.is_file() => Ok(()),
        _ => try_beside(&target),
    }
    .map_err(|error: ReportError| error.at(path))
}

fn try_beside(target: &Path) -> Result<(), ReportError> {
    let temporary = temporary_name(target)?;
    File::create(&temporary)?;
    Ok(fs::remove_file(&temporary)?)
}

/// Makes the folder `path` and all above it; one that is there already will do.
///
/// # Errors
/// [`ReportError::File`] where that is not possible.
pub fn make_folder(path: &Path) -> Result<(), ReportError> {
    fs::create_dir_all(path).map_err(|cause| ReportError::file(path, cause))
}

/// Writes under a temporary name and renames; on failure the temporary file goes.
fn write_beside<F>(target: &Path, content: F) -> Result<(), ReportError>
where
    F: FnOnce(&mut dyn Write) -> Result<(), ReportError>,
{
    let temporary = temporary_name(target)?;
    let done = write_to(&temporary, content).and_then(|()| Ok(fs::rename(&temporary, target)?));
    if done.is_err() {
        // The first error is the one to tell; there may be no file to remove.
        let _ = fs::remove_file(&temporary);
    }
    done
}

/// Writes straight to `path`.
fn write_to<F>(path: &Path, content: F) -> Result<(), ReportError>
where
    F: FnOnce(&mut dyn Write) -> Result<(), ReportError>,
{
    let mut out = BufWriter::new(File::create(path)?);
    content(&mut out)?;
    Ok(out.flush()?)
}

/// `.name.PID.part` beside `target`.
fn temporary_name(target: &Path) -> Result<PathBuf, ReportError> {
    let name = target.file_name().ok_or_else(|| io::Error::from(io::ErrorKind::InvalidInput))?;
    let part = format!(".{}.{}.part", name.to_string_lossy(), std::process::id());
    Ok(target.with_file_name(part))
}
