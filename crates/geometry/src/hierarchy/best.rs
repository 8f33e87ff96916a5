//! The nearest triangle so far.

use super::Hierarchy;
use super::node::Child;
use crate::ray::Hit;

/// The nearest triangle so far, by where it stands. Its index in the mesh is asked for at the end, or where two are at one
/// distance, so that no walk waits until it comes from memory.
#[derive(Clone, Copy)]
pub(super) struct Best {
    /// Distance in units of the ray's direction.
    pub(super) t: f64,
    /// The packet that it stands in.
    pub(super) packet: Child,
    /// Its lane there.
    pub(super) lane: usize,
}

impl Best {
    /// What is met where nothing is.
    pub(super) const NOTHING: Self = Self { t: f64::INFINITY, packet: Child::NONE, lane: 0 };

    /// Whether this comes before another, as [`Hit::before`] says.
    #[inline(always)]
    pub(super) fn before(&self, other: &Self, tree: &Hierarchy) -> bool {
        self.t < other.t || (self.t == other.t && self.triangle(tree) < other.triangle(tree))
    }

    /// The triangle that is met, if any.
    #[inline(always)]
    pub(super) fn hit(&self, tree: &Hierarchy) -> Option<Hit> {
        (self.packet != Child::NONE).then(|| Hit { t: self.t, triangle: self.triangle(tree) })
    }

    /// The triangle's index in the mesh, beyond all others where there is none.
    #[inline(always)]
    fn triangle(&self, tree: &Hierarchy) -> u32 {
        tree.triangles.get(self.packet.index()).map_or(u32::MAX, |triangles| triangles[self.lane])
    }
}
