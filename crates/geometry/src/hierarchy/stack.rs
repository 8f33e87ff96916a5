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

/// A stack for trees that need no more than [`Shallow::ROOM`] entries: it never grows, so that nothing is called from the
/// loops that use it and all they know of a ray stays in registers.
pub(super) struct Shallow {
    entries: [u64; Self::ROOM],
    len: usize,
}

impl Shallow {
    /// Most entries that it holds; a power of two.
    pub(super) const ROOM: usize = 32;
}

impl Stack for Shallow {
    #[inline(always)]
    fn new() -> Self {
        Self { entries: [0; Self::ROOM], len: 0 }
    }

    #[inline(always)]
    fn push(&mut self, entry: u64) {
        debug_assert!(self.len < Self::ROOM, "the tree is too deep for this stack");
        self.entries[self.len % Self::ROOM] = entry;
        self.len += 1;
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<u64> {
        self.len = self.len.checked_sub(1)?;
        Some(self.entries[self.len % Self::ROOM])
    }
}

/// A stack for trees of any depth.
pub(super) struct Deep(Vec<u64>);

impl Stack for Deep {
    #[inline(always)]
    fn new() -> Self {
        Self(Vec::with_capacity(4 * Shallow::ROOM))
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
