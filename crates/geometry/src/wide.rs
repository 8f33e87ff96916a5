//! Eight binary64 numbers side by side, for sums over many samples.
//!
//! A sum depends on its order in the last bits. Eight partial sums are kept whatever the width of the machine's vectors,
//! and folded in one order, so that it is the same everywhere.

use std::fmt::Debug;
use std::ops::{Add, Mul, Sub};

use crate::real::Mask;

/// How many numbers lie side by side.
pub const EIGHT: usize = 8;

/// Eight binary64 numbers.
pub trait Wide: Copy + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// The result of comparisons.
    type Mask: Mask;

    /// The same number eight times.
    fn splat(value: f64) -> Self;
    /// The first eight numbers of a slice.
    fn load(values: &[f64]) -> Self;
    /// The first eight numbers of a slice, widened.
    fn widen(values: &[f32]) -> Self;
    /// Writes the numbers to the first eight places of a slice.
    fn store(self, values: &mut [f64]);
    /// The numbers in order.
    fn to_array(self) -> [f64; EIGHT];
    /// self < other.
    fn lt(self, other: Self) -> Self::Mask;
    /// self = other.
    fn equals(self, other: Self) -> Self::Mask;
    /// `yes` where the mask holds, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// The sum of the eight: the one half to the other, until one is left.
    #[inline(always)]
    fn sum(self) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.to_array();
        ((a + e) + (c + g)) + ((b + f) + (d + h))
    }
}

/// Eight numbers one by one: the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eight([f64; EIGHT]);

/// Eight truth values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EightMask([bool; EIGHT]);

impl Eight {
    #[inline(always)]
    fn with(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|k| f(self.0[k], other.0[k])))
    }
}

impl EightMask {
    #[inline(always)]
    fn of(f: impl Fn(usize) -> bool) -> Self {
        Self(std::array::from_fn(f))
    }
}

impl Wide for Eight {
    type Mask = EightMask;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; EIGHT])
    }
    #[inline(always)]
    fn load(values: &[f64]) -> Self {
        Self(std::array::from_fn(|k| values[k]))
    }
    #[inline(always)]
    fn widen(values: &[f32]) -> Self {
        Self(std::array::from_fn(|k| f64::from(values[k])))
    }
    #[inline(always)]
    fn store(self, values: &mut [f64]) {
        values[..EIGHT].copy_from_slice(&self.0);
    }
    #[inline(always)]
    fn to_array(self) -> [f64; EIGHT] {
        self.0
    }
    #[inline(always)]
    fn lt(self, other: Self) -> EightMask {
        EightMask::of(|k| self.0[k] < other.0[k])
    }
    #[inline(always)]
    fn equals(self, other: Self) -> EightMask {
        EightMask::of(|k| self.0[k] == other.0[k])
    }
    #[inline(always)]
    fn select(mask: EightMask, yes: Self, no: Self) -> Self {
        Self(std::array::from_fn(|k| if mask.0[k] { yes.0[k] } else { no.0[k] }))
    }
}

impl Mask for EightMask {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        Self([value; EIGHT])
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.0.contains(&true)
    }
    #[inline(always)]
    fn count(self) -> u32 {
        self.0.iter().map(|&value| u32::from(value)).sum()
    }
}

impl std::ops::BitAnd for EightMask {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self::of(|k| self.0[k] & other.0[k])
    }
}

impl std::ops::BitOr for EightMask {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self::of(|k| self.0[k] | other.0[k])
    }
}

impl std::ops::Not for EightMask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self::of(|k| !self.0[k])
    }
}

impl Add for Eight {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl Sub for Eight {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl Mul for Eight {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, |a, b| a * b)
    }
}
