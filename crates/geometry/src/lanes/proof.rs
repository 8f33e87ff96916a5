//! The proof that a machine has instructions, for operations that start from nothing.

use fearless_simd::Simd;

/// The proof that the machine has the instructions S, for operations that start from nothing (constants).
///
/// It costs 512-bit vectors nothing, where asking the machine again would cost more than the operation.
#[inline(always)]
#[allow(unsafe_code)]
pub(super) fn proof<S: Simd>() -> S {
    const { assert!(size_of::<S>() == 0) };
    // SAFETY: S is a token without size, so every (zero-sized) value of it is the same value, and one exists: `Lanes<S>`
    // is private to this folder and reaches other code only as the `R` of `Kernel::run` in `vectorize`, which was handed a
    // token of S. Whoever calls a function of `Lanes<S>` therefore runs on a machine for which a token of S was made.
    unsafe { std::mem::transmute_copy(&()) }
}
