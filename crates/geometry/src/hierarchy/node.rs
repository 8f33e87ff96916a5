//! A node of the wide tree: sixteen boxes side by side.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16};

use super::probe::Probe;

/// Boxes in a node: the more there are, the fewer nodes a walk waits for, one after another.
pub(super) const FAN: usize = 16;
/// Triangles in a packet.
pub(super) const WIDTH: usize = 8;

/// Up to sixteen children, the largest first. Rows 0 to 2 hold the lower bounds of their boxes along x, y, z, rows 3 to 5
/// the upper ones. A slot without a child holds a box that nothing meets.
#[repr(C, align(64))]
pub(super) struct Node {
    bounds: [[f32; FAN]; 6],
    pub(super) children: [Child; FAN],
    /// The children that are packets, a bit each.
    pub(super) packets: u32,
}

impl Node {
    /// A node without children.
    pub(super) const EMPTY: Self = Self {
        bounds: [
            [f32::INFINITY; FAN],
            [f32::INFINITY; FAN],
            [f32::INFINITY; FAN],
            [f32::NEG_INFINITY; FAN],
            [f32::NEG_INFINITY; FAN],
            [f32::NEG_INFINITY; FAN],
        ],
        children: [Child::NONE; FAN],
        packets: 0,
    };

    /// Puts a child into a slot.
    pub(super) fn put(&mut self, slot: usize, child: Child, [low, high]: [[f32; 3]; 2]) {
        for axis in 0..3 {
            self.bounds[axis][slot] = low[axis];
            self.bounds[axis + 3][slot] = high[axis];
        }
        self.children[slot] = child;
        self.packets |= u32::from(child.is_packet()) << slot;
    }

    /// The children there are.
    pub(super) fn children(&self) -> impl Iterator<Item = Child> {
        self.children.iter().copied().filter(|&child| child != Child::NONE)
    }

    /// A row of bounds.
    #[inline(always)]
    pub(super) fn face<S: Simd>(&self, simd: S, row: usize) -> f32x16<S> {
        f32x16::from_slice(simd, &self.bounds[row])
    }

    /// Which children the ray enters before `reach`, a bit each, and where: at most the true distance, never more.
    ///
    /// The slab test (Kay and Kajiya 1986), with the faces moved apart by what rounding can do: see [`Probe`].
    #[inline(always)]
    pub(super) fn enter<S: Simd>(&self, simd: S, probe: &Probe, reach: f32) -> (u32, f32x16<S>) {
        let near = |k: usize| self.met(simd, probe.near[k], probe.rate[k], probe.enter[k]);
        let far = |k: usize| self.met(simd, probe.far[k], probe.stretched[k], probe.leave[k]);
        let entry = near(0).max(near(1)).max(near(2).max(0.0));
        let exit = far(0).min(far(1)).min(far(2).min(f32x16::splat(simd, reach)));
        (entry.simd_le(exit).to_bitmask() as u32, entry)
    }

    /// Where a ray meets a row of faces.
    #[inline(always)]
    fn met<S: Simd>(&self, simd: S, row: usize, rate: f32, start: f32) -> f32x16<S> {
        self.face(simd, row).mul_add(rate, f32x16::splat(simd, start))
    }
}

/// A node or a packet, by its place among its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Child(u32);

impl Child {
    const PACKET: u32 = 1 << 31;
    /// No child.
    pub(super) const NONE: Self = Self(u32::MAX);

    pub(super) fn node(index: usize) -> Self {
        Self(index as u32)
    }

    pub(super) fn packet(index: usize) -> Self {
        Self(index as u32 | Self::PACKET)
    }

    pub(super) fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    pub(super) fn bits(self) -> u32 {
        self.0
    }

    pub(super) fn is_packet(self) -> bool {
        self.0 & Self::PACKET != 0
    }

    pub(super) fn index(self) -> usize {
        (self.0 & !Self::PACKET) as usize
    }
}
