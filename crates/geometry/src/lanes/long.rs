//! Sixteen words in places of 64 bits: even and odd ones apart.

use std::ops::BitXor;

use fearless_simd::{Bytes, Simd, SimdBase, u64x8};

use super::proof::proof;
use super::sixteen::LaneWord;
use crate::real::Long;

/// The even words, and the odd ones.
#[derive(Clone, Copy)]
pub(super) struct LaneLong<S: Simd>([u64x8<S>; 2]);

impl<S: Simd> LaneLong<S> {
    #[inline(always)]
    pub(super) fn of(word: LaneWord<S>) -> Self {
        let even: u64x8<S> = word.0.bitcast();
        Self([even, (even >> 32) | (even << 32)])
    }
}

#[inline(always)]
fn low<S: Simd>() -> u64x8<S> {
    u64x8::splat(proof(), 0xFFFF_FFFF)
}

impl<S: Simd> Long<LaneWord<S>> for LaneLong<S> {
    #[inline(always)]
    fn times(self, factor: u32) -> Self {
        let (Self([even, odd]), factor) = (self, u64x8::splat(proof(), u64::from(factor)));
        Self([(even & low()) * factor, (odd & low()) * factor])
    }
    #[inline(always)]
    fn high(self) -> Self {
        let Self([even, odd]) = self;
        Self([even >> 32, odd >> 32])
    }
    #[inline(always)]
    fn word(self) -> LaneWord<S> {
        let Self([even, odd]) = self;
        LaneWord(((even & low()) | (odd << 32)).bitcast())
    }
}

impl<S: Simd> BitXor for LaneLong<S> {
    type Output = Self;
    #[inline(always)]
    fn bitxor(self, other: Self) -> Self {
        let (Self([a, b]), Self([c, d])) = (self, other);
        Self([a ^ c, b ^ d])
    }
}
