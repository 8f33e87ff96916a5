//! A value that some samples lack.

use crate::real::{Mask, Real};

/// `Option` for many samples at once: a value, and where there is one. A sample without a value may hold anything, NaN
/// included, so the value is reached only together with the mask.
#[derive(Clone, Copy, Debug)]
pub struct Masked<T, R: Real> {
    value: T,
    some: R::Mask,
}

impl<T: Copy, R: Real> Masked<T, R> {
    /// A value for the samples where `some` holds.
    #[inline(always)]
    pub fn new(value: T, some: R::Mask) -> Self {
        Self { value, some }
    }

    /// A value for every sample.
    #[inline(always)]
    pub fn all(value: T) -> Self {
        Self::new(value, R::Mask::splat(true))
    }

    /// Where there is a value.
    #[inline(always)]
    pub fn some(&self) -> R::Mask {
        self.some
    }

    /// The value, with the mask under which it may be used.
    #[inline(always)]
    pub fn parts(self) -> (T, R::Mask) {
        (self.value, self.some)
    }

    /// Drops the samples where `keep` does not hold.
    #[inline(always)]
    pub fn filter(self, keep: impl FnOnce(&T) -> R::Mask) -> Self {
        let some = self.some & keep(&self.value);
        Self { some, ..self }
    }

    /// Computes on the value; samples without one stay without.
    #[inline(always)]
    pub fn map<U: Copy>(self, f: impl FnOnce(T) -> U) -> Masked<U, R> {
        Masked::new(f(self.value), self.some)
    }
}

impl<R: Real> Masked<R, R> {
    /// The number, or zero: no sample is a sample worth zero.
    #[inline(always)]
    pub fn or_zero(self) -> R {
        R::select(self.some, self.value, R::zero())
    }
}
