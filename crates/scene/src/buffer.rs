//! Buffers: the GLB chunk, data URIs and files.

use std::borrow::Cow;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::json;
use percent_encoding::percent_decode_str;

use crate::error::{Problem, malformed};

/// The bytes of one buffer.
pub(crate) struct Buffer<'a> {
    /// The bytes; `None` for a buffer that the file only declares.
    pub bytes: Option<Cow<'a, [u8]>>,
    /// Whether they stand in a file of their own.
    pub external: bool,
}

/// Reads every buffer; `blob` is the binary chunk of a GLB file, and files are looked for in `folder`.
pub(crate) fn read_all<'a>(
    root: &json::Root,
    mut blob: Option<Cow<'a, [u8]>>,
    folder: &Path,
) -> Result<Vec<Buffer<'a>>, Problem> {
    let read = |(index, buffer)| {
        let own_blob = if index == 0 { blob.take() } else { None };
        read(&format!("buffers[{index}]"), buffer, own_blob, folder)
    };
    root.buffers.iter().enumerate().map(read).collect()
}

fn read<'a>(
    place: &str,
    buffer: &json::Buffer,
    blob: Option<Cow<'a, [u8]>>,
    folder: &Path,
) -> Result<Buffer<'a>, Problem> {
    let declared = buffer.byte_length.0;
    let (bytes, external) = match buffer.uri.as_deref() {
        None => (blob, false),
        Some(uri) if uri.starts_with("data:") => (Some(decode(place, uri)?.into()), false),
        Some(uri) => (Some(read_file(place, uri, folder, declared)?.into()), true),
    };
    match bytes.as_ref().map(|bytes| bytes.len()) {
        Some(held) if (held as u64) < declared => {
            Err(malformed(place, format!("promises {declared} bytes, but only {held} are there")))
        }
        _ => Ok(Buffer { bytes, external }),
    }
}

/// The bytes of a data URI; messages are about `place`.
pub(crate) fn decode(place: &str, uri: &str) -> Result<Vec<u8>, Problem> {
    let (_, data) =
        uri.split_once(";base64,").ok_or_else(|| malformed(place, "has a data URI that is not in base64"))?;
    STANDARD.decode(data).map_err(|error| malformed(place, format!("has broken base64 data ({error})")))
}

/// Reads the file that `uri` names in `folder`, no more of it than is declared, and nothing but a plain file: a device or a
/// pipe might never end.
pub(crate) fn read_file(place: &str, uri: &str, folder: &Path, declared: u64) -> Result<Vec<u8>, Problem> {
    let name = file_name(place, uri)?;
    let path = folder.join(&name);
    let unreadable = |error: io::Error| Problem::Unreadable {
        what: format!("{place}, the file {:?}", path.display().to_string()),
        reason: error.to_string(),
    };
    read_plain(&path, declared).map_err(unreadable)
}

/// The first `most` bytes of the plain file at `path`.
pub(crate) fn read_plain(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let kind = fs::metadata(path)?;
    if !kind.is_file() {
        let what = if kind.is_dir() { "it is a folder" } else { "it is not a plain file" };
        return Err(io::Error::new(io::ErrorKind::InvalidInput, what));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn file_name(place: &str, uri: &str) -> Result<String, Problem> {
    if let Some((scheme, _)) = uri.split_once(':') {
        let fault = format!("has a {scheme:?} address; only files beside the scene are read");
        return Err(malformed(place, fault));
    }
    let name = percent_decode_str(uri).decode_utf8();
    let name = name.map_err(|_| malformed(place, format!("has an address that is no text ({uri:?})")))?;
    Ok(name.into_owned())
}
