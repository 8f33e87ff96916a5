//! Sixteen samples side by side, in the widest vectors that the machine has.
//!
//! [`run`] asks the machine once what it can do and runs a [`Kernel`] in vectors of 512, 256 or 128 bits. Sixteen samples
//! go together whatever the width, no operation is contracted, and every operation rounds as IEEE 754 says, so the
//! bits are those of the scalar reference [`f32`] everywhere.
//!
//! A kernel and all that it calls on samples must be `#[inline(always)]`: a function that is not inlined is compiled for
//! the plainest machine.

mod eight;
mod instructions;
mod long;
mod operators;
mod proof;
mod sixteen;

pub use instructions::{Instructions, run};

use crate::real::Real;

/// Something to compute in numbers of any kind.
pub trait Kernel {
    /// What comes of it.
    type Output;
    /// Computes it. Implementations are `#[inline(always)]`.
    fn run<R: Real>(self) -> Self::Output;
}
