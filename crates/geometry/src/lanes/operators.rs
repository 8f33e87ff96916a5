//! Operators between lanes.

use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Shl, Shr, Sub};

use fearless_simd::Simd;

use super::eight::{LaneWide, WideMask};
use super::sixteen::{LaneMask, LaneWord, Lanes};

macro_rules! lane_by_lane {
    ($($operation:ident $function:ident $lanes:ident),*) => {$(
        impl<S: Simd> $operation for $lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(self.0.$function(other.0))
            }
        }
    )*};
}
lane_by_lane!(Add add Lanes, Sub sub Lanes, Mul mul Lanes, Div div Lanes, BitXor bitxor LaneWord);
lane_by_lane!(BitAnd bitand LaneWord, BitOr bitor LaneWord);
lane_by_lane!(Add add LaneWide, Sub sub LaneWide, Mul mul LaneWide);
lane_by_lane!(BitAnd bitand LaneMask, BitOr bitor LaneMask, BitAnd bitand WideMask, BitOr bitor WideMask);

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! shifts {
    ($($operation:ident $function:ident),*) => {$(
        impl<S: Simd> $operation<u32> for LaneWord<S> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, bits: u32) -> Self {
                Self(self.0.$function(bits))
            }
        }
    )*};
}
shifts!(Shl shl, Shr shr);

macro_rules! negations {
    ($($mask:ident),*) => {$(
        impl<S: Simd> Not for $mask<S> {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                Self(!self.0)
            }
        }
    )*};
}
negations!(LaneMask, WideMask);
