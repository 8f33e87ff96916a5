//! Views of buffers, with every bound checked.

use std::borrow::Cow;

use crate::document::Document;
use crate::error::{Problem, malformed};

/// A run of elements in a buffer: where it begins in the view, the size of an element in bytes, how many there are.
#[derive(Clone, Copy)]
pub(crate) struct Run {
    pub offset: u64,
    pub size: usize,
    pub count: usize,
}

impl Document<'_> {
    /// The elements of `run` in buffer view `view`, without gaps; messages are about `place`.
    pub fn elements(&self, place: &str, view: usize, run: Run) -> Result<Cow<'_, [u8]>, Problem> {
        let fault = |what: &str| malformed(place, format!("stands in bufferViews[{view}], which {what}"));
        let view = self.root.buffer_views.get(view).ok_or_else(|| fault("does not exist"))?;
        let buffer = self.buffers.get(view.buffer.value()).and_then(|b| b.bytes.as_deref());
        let buffer = buffer.ok_or_else(|| fault("stands in a buffer without data"))?;
        let bytes = slice(buffer, view.byte_offset.unwrap_or_default().0, view.byte_length.0);
        let bytes = bytes.ok_or_else(|| fault("reaches beyond its buffer"))?;
        let stride = view.byte_stride.map_or(run.size, |stride| stride.0);
        if stride < run.size {
            return Err(fault(&format!("has a byteStride of {stride} for {} bytes", run.size)));
        }
        gather(bytes, run, stride).ok_or_else(|| fault("ends before it"))
    }
}

/// The elements of `run` at a distance of `stride` >= `run.size` bytes; `None` where they reach beyond `bytes`.
fn gather(bytes: &[u8], run: Run, stride: usize) -> Option<Cow<'_, [u8]>> {
    let last = (run.count as u64).checked_sub(1);
    let length = last.map_or(0, |last| last * stride as u64 + run.size as u64);
    let bytes = slice(bytes, run.offset, length)?;
    if stride == run.size {
        return Some(bytes.into());
    }
    Some(bytes.chunks(stride).flat_map(|element| &element[..run.size]).copied().collect())
}

fn slice(bytes: &[u8], offset: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(offset).ok()?;
    let end = start.checked_add(usize::try_from(length).ok()?)?;
    bytes.get(start..end)
}

#[cfg(test)]
mod tests {
    use super::{Run, gather, slice};

    #[test]
    fn slices_stay_inside() {
        let bytes = [1, 2, 3];
        assert_eq!(slice(&bytes, 1, 2), Some(&bytes[1..]));
        assert_eq!(slice(&bytes, 3, 0), Some(&bytes[3..]));
        for (offset, length) in [(1, 3), (4, 0), (u64::MAX, 1), (1, u64::MAX)] {
            assert_eq!(slice(&bytes, offset, length), None);
        }
    }

    #[test]
    fn elements_are_gathered_and_the_last_needs_no_gap() {
        let run = Run { offset: 1, size: 2, count: 2 };
        assert_eq!(gather(&[0, 1, 2, 9, 9, 3, 4], run, 4).as_deref(), Some(&[1, 2, 3, 4][..]));
        assert_eq!(gather(&[0, 1, 2, 9, 9, 3], run, 4), None);
    }
}
