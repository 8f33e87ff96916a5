//! What is yet to be visited.

use std::mem::MaybeUninit;

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
///
/// Places that were never pushed to stay unwritten: clearing all takes 5 to 8 % of the time of rays among a million
/// triangles, and 1 to 3 % among a few.
///
/// It begins a cache line, and with it the frame of a walk: what the walk's registers do not hold is kept in lines of its
/// own, from where it comes back at once.
#[repr(C, align(64))]
pub(super) struct Fixed<const ROOM: usize> {
    entries: [MaybeUninit<u64>; ROOM],
    len: usize,
}

impl<const ROOM: usize> Stack for Fixed<ROOM> {
    #[inline(always)]
    fn new() -> Self {
        Self { entries: [MaybeUninit::uninit(); ROOM], len: 0 }
    }

    #[inline(always)]
    fn push(&mut self, entry: u64) {
        debug_assert!(self.len < ROOM, "the tree is too deep for this stack");
        self.entries[self.len % ROOM].write(entry);
        self.len += 1;
    }

    #[inline(always)]
    #[allow(unsafe_code, reason = "entries are written before they are read, which the compiler does not see")]
    fn pop(&mut self) -> Option<u64> {
        self.len = self.len.checked_sub(1)?;
        // SAFETY: `len` is 0 at first and grows by 1 with each entry written at `len % ROOM`, so that all places
        // k % ROOM with k < `len` before the subtraction are written, the one of k = `len` after it among them.
        Some(unsafe { self.entries[self.len % ROOM].assume_init() })
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
