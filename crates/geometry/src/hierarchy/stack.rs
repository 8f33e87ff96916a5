//! What is yet to be visited.

use super::node::Child;

/// Nodes and packets yet to be visited, each with a lower bound of its distance; deeper trees than the fixed part holds
/// spill to the heap. An entry is `distance bits << 32 | child`, so that entries order by distance.
pub(super) struct Stack {
    fixed: [u64; Self::FIXED],
    len: usize,
    spilled: Vec<u64>,
}

impl Stack {
    const FIXED: usize = 32;

    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { fixed: [0; Self::FIXED], len: 0, spilled: Vec::new() }
    }

    #[inline(always)]
    pub(super) fn push(&mut self, entry: u64) {
        if let Some(slot) = self.fixed.get_mut(self.len) {
            *slot = entry;
            self.len += 1;
        } else {
            self.spill(entry);
        }
    }

    #[inline(always)]
    pub(super) fn pop(&mut self) -> Option<u64> {
        if self.len == Self::FIXED
            && let Some(entry) = self.spilled.pop()
        {
            return Some(entry);
        }
        self.len = self.len.checked_sub(1)?;
        self.fixed.get(self.len).copied()
    }

    #[cold]
    #[inline(never)]
    fn spill(&mut self, entry: u64) {
        self.spilled.push(entry);
    }
}

/// A stack entry.
#[inline(always)]
pub(super) fn entry(distance: f32, child: Child) -> u64 {
    u64::from(distance.to_bits()) << 32 | u64::from(child.bits())
}

/// The distance and the child of a stack entry.
#[inline(always)]
pub(super) fn parts(entry: u64) -> (f32, Child) {
    (f32::from_bits((entry >> 32) as u32), Child::from_bits(entry as u32))
}
