//! What is yet to be visited.

use super::node::Child;

/// Nodes and packets yet to be visited, each with a lower bound of its distance. An entry is `distance bits << 32 | child`,
/// so that entries order by distance.
pub(super) trait Stack {
    /// An empty stack.
    fn new() -> Self;
    /// Puts an entry on top.
    fn push(&mut self, entry: u64);
    /// Takes the top entry.
    fn pop(&mut self) -> Option<u64>;
}

/// A stack for trees that never need more than `ROOM` entries, a power of two: it does not grow, so that nothing is called
/// from the loops that use it.
pub(super) struct Fixed<const ROOM: usize> {
    entries: [u64; ROOM],
    len: usize,
}

impl<const ROOM: usize> Stack for Fixed<ROOM> {
    #[inline(always)]
    fn new() -> Self {
        Self { entries: [0; ROOM], len: 0 }
    }

    #[inline(always)]
    fn push(&mut self, entry: u64) {
        debug_assert!(self.len < ROOM, "the tree is too deep for this stack");
        self.entries[self.len % ROOM] = entry;
        self.len += 1;
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<u64> {
        self.len = self.len.checked_sub(1)?;
        Some(self.entries[self.len % ROOM])
    }
}

/// A stack for trees of any depth.
pub(super) struct Growing(Vec<u64>);

impl Stack for Growing {
    #[inline(always)]
    fn new() -> Self {
        Self(Vec::with_capacity(256))
    }

    #[inline(always)]
    fn push(&mut self, entry: u64) {
        self.0.push(entry);
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<u64> {
        self.0.pop()
    }
}

/// The stack that a tree needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Depth {
    /// At most [`Self::SHALLOW`] entries.
    Shallow,
    /// At most [`Self::MIDDLING`] entries: that of a million triangles.
    Middling,
    /// More.
    Deep,
}

impl Depth {
    pub(super) const SHALLOW: usize = 32;
    pub(super) const MIDDLING: usize = 128;

    /// The stack for walks that hold up to this many entries.
    pub(super) fn of(entries: usize) -> Self {
        match entries {
            _ if entries <= Self::SHALLOW => Self::Shallow,
            _ if entries <= Self::MIDDLING => Self::Middling,
            _ => Self::Deep,
        }
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
