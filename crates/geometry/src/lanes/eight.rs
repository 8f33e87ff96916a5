//! Eight binary64 numbers side by side: [`Wide`] in vectors.

use std::fmt;

use fearless_simd::{Select, Simd, SimdBase, SimdCombine, SimdMask, SimdWiden, f32x8, f64x8, mask64x8};

use super::proof::proof;
use crate::real::Mask;
use crate::wide::{EIGHT, Wide};

/// Eight wide numbers.
#[derive(Clone, Copy)]
pub(super) struct LaneWide<S: Simd>(pub(super) f64x8<S>);

/// Eight truth values.
#[derive(Clone, Copy)]
pub(super) struct WideMask<S: Simd>(pub(super) mask64x8<S>);

impl<S: Simd> Wide for LaneWide<S> {
    type Mask = WideMask<S>;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(f64x8::splat(proof(), value))
    }
    #[inline(always)]
    fn load(values: &[f64]) -> Self {
        Self(f64x8::from_slice(proof(), &values[..EIGHT]))
    }
    #[inline(always)]
    fn widen(values: &[f32]) -> Self {
        let narrow = f32x8::from_slice(proof::<S>(), &values[..EIGHT]);
        let (low, high) = narrow.widen();
        Self(low.combine(high))
    }
    #[inline(always)]
    fn store(self, values: &mut [f64]) {
        self.0.store_slice(&mut values[..EIGHT]);
    }
    #[inline(always)]
    fn to_array(self) -> [f64; EIGHT] {
        *self.0
    }
    #[inline(always)]
    fn lt(self, other: Self) -> WideMask<S> {
        WideMask(self.0.simd_lt(other.0))
    }
    #[inline(always)]
    fn equals(self, other: Self) -> WideMask<S> {
        WideMask(self.0.simd_eq(other.0))
    }
    #[inline(always)]
    fn select(mask: WideMask<S>, yes: Self, no: Self) -> Self {
        Self(mask.0.select(yes.0, no.0))
    }
}

impl<S: Simd> Mask for WideMask<S> {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        Self(mask64x8::splat(proof(), value))
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.0.any_true()
    }
    #[inline(always)]
    fn count(self) -> u32 {
        self.0.to_bitmask().count_ones()
    }
}

impl<S: Simd> fmt::Debug for LaneWide<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.to_array().fmt(f)
    }
}

impl<S: Simd> fmt::Debug for WideMask<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:08b}", self.0.to_bitmask())
    }
}
