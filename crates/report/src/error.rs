//! What can go wrong between a result and its file.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// A report that could not be made: what, where, and what to do.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A figure is NaN or infinite, so that the result cannot be trusted.
    #[error(
        "{place} is {value}, not a finite number: measure that receiver and strategy alone to find the sample behind it"
    )]
    NotFinite {
        /// Path of the figure in the document, for example `receivers[0].rows[3].mean.rgb[1]`.
        place: String,
        /// NaN or an infinity.
        value: f64,
    },
    /// A file or a folder could not be written.
    #[error("cannot write {}: {cause}; {}", path.display(), remedy(cause))]
    File {
        /// The file or folder.
        path: PathBuf,
        /// What the operating system said.
        cause: io::Error,
    },
    /// A stream (standard output, say) took no more.
    #[error("cannot write the output: {cause}; send it to a file or to a program that reads to the end")]
    Stream {
        /// What the operating system said.
        cause: io::Error,
    },
    /// An image whose parts do not fit together, or that its format cannot hold.
    #[error("cannot make the image: {what}; {remedy}")]
    Image {
        /// What is wrong.
        what: String,
        /// What to do.
        remedy: &'static str,
    },
}

impl ReportError {
    /// The error of a file at `path`.
    pub(crate) fn file(path: &Path, cause: io::Error) -> Self {
        Self::File { path: path.to_owned(), cause }
    }

    /// The same error, with the path that the stream leads to.
    pub(crate) fn at(self, path: &Path) -> Self {
        match self {
            Self::Stream { cause } => Self::file(path, cause),
            other => other,
        }
    }
}

impl From<io::Error> for ReportError {
    fn from(cause: io::Error) -> Self {
        Self::Stream { cause }
    }
}

/// What to do about a refused write.
fn remedy(cause: &io::Error) -> &'static str {
    match cause.kind() {
        io::ErrorKind::NotFound => "make its folder first, or choose one that exists",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => "choose a folder that you may write to",
        io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => {
            "a file stands where a folder is needed: choose another"
        }
        io::ErrorKind::IsADirectory | io::ErrorKind::InvalidInput => "give the name of a file, not of a folder",
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "free some space, or choose another disk",
        _ => "choose another place",
    }
}
