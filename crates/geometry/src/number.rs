//! The arithmetic of formulas that serve samples and exact light alike.
//!
//! Sampling computes in [`Real`], binary32 side by side; exact light in binary64. A formula that both need is generic over
//! [`Number`] and stands once.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Sub};

use crate::real::Real;

/// A number, whatever its precision and however many lie side by side.
pub trait Number:
    Copy + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// The nearest number to this one.
    fn number(value: f64) -> Self;
    /// Square root.
    fn root(self) -> Self;
}

impl<R: Real> Number for R {
    #[inline(always)]
    fn number(value: f64) -> Self {
        Self::splat(value as f32)
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
}

impl Number for f64 {
    #[inline(always)]
    fn number(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
}
