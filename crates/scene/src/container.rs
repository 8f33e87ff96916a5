//! The two forms of a glTF file: JSON text, and the binary container (GLB) that holds such text and one buffer.

use std::borrow::Cow;

use gltf::binary::Glb;

use crate::error::Problem;

/// A GLB file's header: magic, version, length, four bytes each.
const HEADER: usize = 12;

/// The JSON text and the binary chunk of a file.
#[derive(Debug)]
pub(crate) struct Container<'a> {
    /// The JSON text.
    pub json: Cow<'a, [u8]>,
    /// The binary chunk of a GLB file, which is its first buffer.
    pub blob: Option<Cow<'a, [u8]>>,
}

/// Takes the file apart.
pub(crate) fn open(bytes: &[u8]) -> Result<Container<'_>, Problem> {
    if bytes.is_empty() {
        return Err(Problem::NotGltf("the file is empty".into()));
    }
    if !bytes.starts_with(b"glTF") {
        return Ok(Container { json: bytes.into(), blob: None });
    }
    let declared = declared_length(bytes)?;
    let glb = Glb::from_slice(&bytes[..declared]).map_err(|error| broken(&error.to_string()))?;
    Ok(Container { json: glb.json, blob: glb.bin })
}

/// The length that the header gives, checked against the file: the reader of chunks relies on both.
fn declared_length(bytes: &[u8]) -> Result<usize, Problem> {
    let word = |at: usize| bytes.get(at..at + 4).and_then(|word| word.try_into().ok()).map(u32::from_le_bytes);
    let length = word(8).ok_or_else(|| broken("its header is cut short"))? as usize;
    if length < HEADER {
        return Err(broken(&format!("its header gives a length of {length} bytes")));
    }
    if length > bytes.len() {
        let held = bytes.len();
        return Err(broken(&format!("its header promises {length} bytes, but it holds {held}")));
    }
    Ok(length)
}

fn broken(reason: &str) -> Problem {
    Problem::NotGltf(format!("the binary container is broken, {reason}"))
}
