//! The attributes of an EXR header in the order of their names, as the format's own library writes them.
//!
//! The exr crate keeps its users' attributes in a hash map and writes them in that map's order, which differs from run
//! to run. A header is `magic, version`, then for each attribute `name 0, type 0, size, value`, then `0` (the format's
//! "File Layout", section "Header"). Its length stays the same, so that the offsets of the blocks behind it stay true.

/// Bytes of the magic number and the version.
const PREAMBLE: usize = 8;

/// The single-part file `file` with its attributes in order; none where its header breaks off.
pub(crate) fn sorted(file: &[u8]) -> Option<Vec<u8>> {
    let mut attributes = Vec::new();
    let mut at = PREAMBLE;
    while *file.get(at)? != 0 {
        let end = attribute_end(file, at)?;
        attributes.push(&file[at..end]);
        at = end;
    }
    attributes.sort_unstable(); // distinct names, each ended by 0
    let header = attributes.concat();
    Some([&file[..PREAMBLE], &header, &file[at..]].concat())
}

/// Where the attribute that begins at `start` ends.
fn attribute_end(file: &[u8], start: usize) -> Option<usize> {
    let type_name = after_zero(file, start)?;
    let size = after_zero(file, type_name)?;
    let bytes = file.get(size..size + 4)?.try_into().ok()?;
    let end = size + 4 + u32::from_le_bytes(bytes) as usize;
    (end <= file.len()).then_some(end)
}

/// The position behind the next zero byte.
fn after_zero(file: &[u8], from: usize) -> Option<usize> {
    file.get(from..)?.iter().position(|byte| *byte == 0).map(|length| from + length + 1)
}
