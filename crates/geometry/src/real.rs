//! The numbers that formulas are written in.
//!
//! Every formula of sampling is generic over [`Real`] and stands once. `f32` is the scalar reference; a type that holds
//! several samples side by side can be added without touching a formula. A comparison yields a mask, a choice is a
//! [`select`](Real::select), and whatever must be looked up or traced one sample at a time goes through
//! [`gather`](Real::gather) or [`each`](Real::each).

use std::fmt::Debug;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A truth value per sample.
pub trait Mask: Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// The same truth value for every sample.
    fn splat(value: bool) -> Self;
    /// Whether it is true for some sample.
    fn any(self) -> bool;
    /// How many samples it is true for.
    fn count(self) -> u32;
}

/// One binary32 number per sample, with IEEE 754 arithmetic and no contraction, so that every implementation computes
/// the same bits.
pub trait Real:
    Copy + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The result of comparisons.
    type Mask: Mask;
    /// A 32-bit word per sample: random words, indices.
    type Word: Copy + Debug;

    /// The same number for every sample.
    fn splat(value: f32) -> Self;
    /// The same word for every sample.
    fn splat_word(value: u32) -> Self::Word;
    /// The nearest number to a word taken as an unsigned integer.
    fn from_word(word: Self::Word) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// self < other.
    fn lt(self, other: Self) -> Self::Mask;
    /// self <= other.
    fn le(self, other: Self) -> Self::Mask;
    /// Where two words are equal.
    fn same(one: Self::Word, other: Self::Word) -> Self::Mask;
    /// `yes` where the mask holds, else `no`; the other side may hold anything, NaN included.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// The same choice between words.
    fn select_word(mask: Self::Mask, yes: Self::Word, no: Self::Word) -> Self::Word;
    /// Looks up a row of numbers by each sample's index.
    fn gather<const K: usize>(index: Self::Word, row: impl Fn(u32) -> [f32; K]) -> [Self; K];
    /// Looks up words by each sample's word.
    fn map_word<const K: usize>(word: Self::Word, f: impl Fn(u32) -> [u32; K]) -> [Self::Word; K];
    /// Asks a question of each sample where `mask` holds: its word and values to a word, or to nothing.
    fn each<const K: usize>(
        mask: Self::Mask,
        word: Self::Word,
        values: [Self; K],
        f: impl Fn(u32, [f32; K]) -> Option<u32>,
    ) -> (Self::Mask, Self::Word);
    /// Hands over the samples in order.
    fn for_each(self, f: impl FnMut(f32));

    /// Zero.
    fn zero() -> Self {
        Self::splat(0.0)
    }
    /// One.
    fn one() -> Self {
        Self::splat(1.0)
    }
}

impl Mask for bool {
    fn splat(value: bool) -> Self {
        value
    }
    fn any(self) -> bool {
        self
    }
    fn count(self) -> u32 {
        u32::from(self)
    }
}

impl Real for f32 {
    type Mask = bool;
    type Word = u32;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        value
    }
    #[inline(always)]
    fn splat_word(value: u32) -> u32 {
        value
    }
    #[inline(always)]
    fn from_word(word: u32) -> Self {
        word as f32
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn same(one: u32, other: u32) -> bool {
        one == other
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn select_word(mask: bool, yes: u32, no: u32) -> u32 {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn gather<const K: usize>(index: u32, row: impl Fn(u32) -> [f32; K]) -> [Self; K] {
        row(index)
    }
    #[inline(always)]
    fn map_word<const K: usize>(word: u32, f: impl Fn(u32) -> [u32; K]) -> [u32; K] {
        f(word)
    }
    #[inline(always)]
    fn each<const K: usize>(
        mask: bool,
        word: u32,
        values: [Self; K],
        f: impl Fn(u32, [f32; K]) -> Option<u32>,
    ) -> (bool, u32) {
        let answer = if mask { f(word, values) } else { None };
        (answer.is_some(), answer.unwrap_or_default())
    }
    #[inline(always)]
    fn for_each(self, mut f: impl FnMut(f32)) {
        f(self);
    }
}

/// sin and cos of 2π·t for t in \[0, 1\], to 2·10⁻⁷ absolute.
///
/// The angle is reduced to f = t − q/4 with |f| <= 1/8, which is exact in binary arithmetic; sin 2πf and cos 2πf are
/// their Taylor polynomials of degree 9 and 8 in φ = 2πf, whose remainders stay below 7·10⁻⁹ for |φ| <= π/4 (degree 9:
/// φ¹¹/11!) and 3·10⁻⁸ (degree 8: φ¹⁰/10!); the quadrant then swaps and negates.
#[inline(always)]
pub fn sin_cos_turns<R: Real>(t: R) -> (R, R) {
    let beyond = |bound: f32| R::splat(bound).le(t);
    let (q1, q2, q3, q4) = (beyond(0.125), beyond(0.375), beyond(0.625), beyond(0.875));
    let quarter = R::select(q4, R::one(), R::zero());
    let quarter = R::select(q3 & !q4, R::splat(0.75), quarter);
    let quarter = R::select(q2 & !q3, R::splat(0.5), quarter);
    let quarter = R::select(q1 & !q2, R::splat(0.25), quarter);

    let phi = (t - quarter) * R::splat(std::f32::consts::TAU);
    let x2 = phi * phi;
    let horner = |terms: &[f32]| {
        let start = R::splat(terms[0]);
        terms[1..].iter().fold(start, |sum, &term| sum * x2 + R::splat(term))
    };
    let sin = phi * horner(&[1.0 / 362_880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0, 1.0]);
    let cos = horner(&[1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5, 1.0]);

    let swap = (q1 & !q2) | (q3 & !q4);
    let (s, c) = (R::select(swap, cos, sin), R::select(swap, sin, cos));
    let negate_sin = q2 & !q4;
    let negate_cos = q1 & !q3;
    (R::select(negate_sin, -s, s), R::select(negate_cos, -c, c))
}

#[cfg(test)]
mod tests {
    use super::sin_cos_turns;

    #[test]
    fn sine_and_cosine_hold_their_stated_error() {
        let steps = 1 << 16;
        let worst = (0..=steps)
            .map(|k| k as f32 / steps as f32)
            .map(|t| {
                let (s, c) = sin_cos_turns(t);
                let (s0, c0) = (f64::from(t) * std::f64::consts::TAU).sin_cos();
                (f64::from(s) - s0).abs().max((f64::from(c) - c0).abs())
            })
            .fold(0.0, f64::max);
        assert!(worst < 2e-7, "worst error {worst:e}");
    }
}
