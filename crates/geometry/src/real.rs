//! The numbers that formulas are written in.
//!
//! Every formula of sampling is generic over [`Real`] and stands once. `f32` is the scalar reference, and the lanes of
//! [`lanes`](crate::lanes) hold sixteen samples side by side. A comparison yields a mask, a choice is a
//! [`select`](Real::select), and whatever must be looked up or traced one sample at a time goes through
//! [`gather`](Real::gather) or [`each`](Real::each).

use std::borrow::Borrow;
use std::fmt::Debug;
use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Shl, Shr, Sub};

use crate::wide::{EIGHT, Eight, Wide};

/// A truth value per sample.
pub trait Mask: Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// The same truth value for every sample.
    fn splat(value: bool) -> Self;
    /// Whether it is true for some sample.
    fn any(self) -> bool;
    /// How many samples it is true for.
    fn count(self) -> u32;
}

/// An unsigned 32-bit word per sample: random words, indices.
pub trait Word:
    Copy
    + Debug
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + BitXor<Output = Self>
    + Shl<u32, Output = Self>
    + Shr<u32, Output = Self>
{
    /// Words in places of 64 bits.
    type Long: Long<Self>;

    /// The same word for every sample.
    fn splat(value: u32) -> Self;
    /// One word for each sample in order: first, first + 1, …, modulo 2³².
    fn counting(first: u32) -> Self;
    /// As many words as lie side by side, from the beginning of a slice.
    fn load(words: &[u32]) -> Self;
    /// Writes the words in order to the beginning of a slice.
    fn store(self, words: &mut [u32]);
    /// The sum modulo 2³².
    fn wrapping_add(self, other: Self) -> Self;
    /// The difference modulo 2³².
    fn wrapping_sub(self, other: Self) -> Self;
    /// The product modulo 2³².
    fn wrapping_mul(self, other: Self) -> Self;
    /// The sum of all samples' words modulo 2³².
    fn sum(self) -> u32;
    /// The same words in places of 64 bits.
    fn long(self) -> Self::Long;
    /// The high word of the product with a constant.
    #[inline(always)]
    fn multiply_high(self, factor: u32) -> Self {
        self.long().times(factor).high().word()
    }
    /// The bits in the opposite order.
    #[inline(always)]
    fn reverse_bits(self) -> Self {
        let word = swap_bits(swap_bits(self, 1, 0x5555_5555), 2, 0x3333_3333);
        let word = swap_bits(swap_bits(word, 4, 0x0F0F_0F0F), 8, 0x00FF_00FF);
        (word >> 16) | (word << 16)
    }
}

/// Words in places of 64 bits, where they are multiplied. Only the low 32 bits are the word.
pub trait Long<W>: Copy + BitXor<Output = Self> {
    /// The products of the words with a constant, all 64 bits of them; their low words are where the words were.
    fn times(self, factor: u32) -> Self;
    /// The high words.
    fn high(self) -> Self;
    /// The words by themselves.
    fn word(self) -> W;
}

/// Swaps neighbouring groups of so many bits; the lower group of each two is where `low` has ones.
#[inline(always)]
fn swap_bits<W: Word>(word: W, bits: u32, low: u32) -> W {
    let low = W::splat(low);
    ((word >> bits) & low) | ((word & low) << bits)
}

/// One binary32 number per sample, with IEEE 754 arithmetic and no contraction, so that every implementation computes
/// the same bits.
pub trait Real:
    Copy + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// How many samples lie side by side.
    const LANES: usize;
    /// The result of comparisons.
    type Mask: Mask;
    /// A 32-bit word per sample.
    type Word: Word;
    /// Binary64 numbers for sums, by the same instructions.
    type Wide: Wide;

    /// The same number for every sample.
    fn splat(value: f32) -> Self;
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
    /// Where one word is below another.
    fn below(one: Self::Word, other: Self::Word) -> Self::Mask;
    /// `yes` where the mask holds, else `no`; the other side may hold anything, NaN included.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// The same choice between words.
    fn select_word(mask: Self::Mask, yes: Self::Word, no: Self::Word) -> Self::Word;
    /// Looks up a row of numbers by each sample's index.
    fn gather<const K: usize, T: Borrow<[f32; K]>>(index: Self::Word, row: impl Fn(u32) -> T) -> [Self; K];
    /// Looks up a word by each sample's index.
    fn gather_word(index: Self::Word, word: impl Fn(u32) -> u32) -> Self::Word;
    /// Computes with each sample's word by itself.
    fn map_word(word: Self::Word, f: impl Fn(u32) -> u32) -> Self::Word;
    /// Asks a question of each sample where `mask` holds: its word and values to a word, or to nothing.
    fn each<const K: usize>(
        mask: Self::Mask,
        word: Self::Word,
        values: [Self; K],
        f: impl FnMut(u32, [f32; K]) -> Option<u32>,
    ) -> (Self::Mask, Self::Word);
    /// As many numbers as lie side by side, from the beginning of a slice.
    fn load(numbers: &[f32]) -> Self;
    /// Writes the numbers in order to the beginning of a slice.
    fn store(self, numbers: &mut [f32]);

    /// Runs a function in a place of its own, compiled for the same instructions: what many callers share and is too large to
    /// be inlined into each.
    fn apart<T>(f: impl FnOnce() -> T) -> T;

    /// The numbers widened, in order; zeros after them.
    fn widen(self) -> [Self::Wide; 2];

    /// Zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(0.0)
    }
    /// One.
    #[inline(always)]
    fn one() -> Self {
        Self::splat(1.0)
    }
}

impl Mask for bool {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        value
    }
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn count(self) -> u32 {
        u32::from(self)
    }
}

impl Word for u32 {
    type Long = u64;

    #[inline(always)]
    fn splat(value: u32) -> Self {
        value
    }
    #[inline(always)]
    fn counting(first: u32) -> Self {
        first
    }
    #[inline(always)]
    fn load(words: &[u32]) -> Self {
        words[0]
    }
    #[inline(always)]
    fn store(self, words: &mut [u32]) {
        words[0] = self;
    }
    #[inline(always)]
    fn wrapping_add(self, other: Self) -> Self {
        self.wrapping_add(other)
    }
    #[inline(always)]
    fn wrapping_sub(self, other: Self) -> Self {
        self.wrapping_sub(other)
    }
    #[inline(always)]
    fn wrapping_mul(self, other: Self) -> Self {
        self.wrapping_mul(other)
    }
    #[inline(always)]
    fn sum(self) -> u32 {
        self
    }
    #[inline(always)]
    fn long(self) -> u64 {
        u64::from(self)
    }
}

impl Long<u32> for u64 {
    #[inline(always)]
    fn times(self, factor: u32) -> Self {
        Self::from(self.word()) * Self::from(factor)
    }
    #[inline(always)]
    fn high(self) -> Self {
        self >> 32
    }
    #[inline(always)]
    fn word(self) -> u32 {
        self as u32
    }
}

impl Real for f32 {
    const LANES: usize = 1;
    type Mask = bool;
    type Word = u32;
    type Wide = Eight;

    #[inline(always)]
    fn splat(value: f32) -> Self {
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
    fn below(one: u32, other: u32) -> bool {
        one < other
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
    fn gather<const K: usize, T: Borrow<[f32; K]>>(index: u32, row: impl Fn(u32) -> T) -> [Self; K] {
        *row(index).borrow()
    }
    #[inline(always)]
    fn gather_word(index: u32, word: impl Fn(u32) -> u32) -> u32 {
        word(index)
    }
    #[inline(always)]
    fn map_word(word: u32, f: impl Fn(u32) -> u32) -> u32 {
        f(word)
    }
    #[inline(always)]
    fn each<const K: usize>(
        mask: bool,
        word: u32,
        values: [Self; K],
        mut f: impl FnMut(u32, [f32; K]) -> Option<u32>,
    ) -> (bool, u32) {
        let answer = if mask { f(word, values) } else { None };
        (answer.is_some(), answer.unwrap_or_default())
    }
    #[inline(always)]
    fn load(numbers: &[f32]) -> Self {
        numbers[0]
    }
    #[inline(always)]
    fn store(self, numbers: &mut [f32]) {
        numbers[0] = self;
    }
    #[inline(always)]
    fn apart<T>(f: impl FnOnce() -> T) -> T {
        f()
    }
    #[inline(always)]
    fn widen(self) -> [Eight; 2] {
        let mut first = [0.0; EIGHT];
        first[0] = f64::from(self);
        [Eight::load(&first), Eight::splat(0.0)]
    }
}

/// sin and cos of 2π·t for t in \[0, 1\], to 2·10⁻⁷ absolute.
///
/// The angle is reduced to f = t − q/4 with |f| <= 1/8, which is exact in binary arithmetic; sin 2πf and cos 2πf are
/// their Taylor polynomials of degree 9 and 8 in φ = 2πf, whose remainders stay below 7·10⁻⁹ for |φ| <= π/4 (degree 9:
/// φ¹¹/11!) and 3·10⁻⁸ (degree 8: φ¹⁰/10!); the quadrant then swaps and negates.
#[inline(always)]
pub fn sin_cos_turns<R: Real>(t: R) -> (R, R) {
    let number = R::splat;
    let beyond = |bound: f32| R::splat(bound).le(t);
    let (q1, q2, q3, q4) = (beyond(0.125), beyond(0.375), beyond(0.625), beyond(0.875));
    let quarter = R::select(q1, number(0.25), number(0.0));
    let quarter = R::select(q2, number(0.5), quarter);
    let quarter = R::select(q3, number(0.75), quarter);
    let quarter = R::select(q4, number(1.0), quarter);

    let phi = (t - quarter) * number(std::f32::consts::TAU);
    let x2 = phi * phi;
    let sin = number(1.0 / 362_880.0);
    let sin = sin * x2 + number(-1.0 / 5040.0);
    let sin = sin * x2 + number(1.0 / 120.0);
    let sin = sin * x2 + number(-1.0 / 6.0);
    let sin = phi * (sin * x2 + number(1.0));
    let cos = number(1.0 / 40320.0);
    let cos = cos * x2 + number(-1.0 / 720.0);
    let cos = cos * x2 + number(1.0 / 24.0);
    let cos = cos * x2 + number(-0.5);
    let cos = cos * x2 + number(1.0);

    let swap = (q1 & !q2) | (q3 & !q4);
    let (s, c) = (R::select(swap, cos, sin), R::select(swap, sin, cos));
    let negate_sin = q2 & !q4;
    let negate_cos = q1 & !q3;
    (R::select(negate_sin, -s, s), R::select(negate_cos, -c, c))
}

/// x − atan x for x in \[0, 1\], to 5·10⁻⁷ of itself: what an arc tangent lacks of its argument, which loses no digits where x
/// is small.
///
/// x³ times a polynomial in x² that interpolates it at the Chebyshev nodes.
#[inline(always)]
pub fn arctan_defect<R: Real>(x: R) -> R {
    let number = R::splat;
    let x2 = x * x;
    let sum = number(-0.003_866_738_9);
    let sum = sum * x2 + number(0.020_026_747);
    let sum = sum * x2 + number(-0.048_914_32);
    let sum = sum * x2 + number(0.080_096_82);
    let sum = sum * x2 + number(-0.108_657_59);
    let sum = sum * x2 + number(0.142_570_45);
    let sum = sum * x2 + number(-0.199_986_82);
    let sum = sum * x2 + number(0.333_333_22);
    x * x2 * sum
}

/// x, or `least` where x is below it or not a number.
#[inline(always)]
pub fn at_least<R: Real>(x: R, least: R) -> R {
    R::select(least.lt(x), x, least)
}

#[cfg(test)]
mod tests {
    use super::{arctan_defect, sin_cos_turns};

    #[test]
    fn the_arctangent_s_defect_holds_its_stated_error() {
        let worst = (1..=1 << 16)
            .map(|k| k as f32 / 65_536.0)
            .map(|x| (arctan_defect(x), f64::from(x)))
            .map(|(y, x)| (f64::from(y), if x < 0.01 { x.powi(3) * (1.0 / 3.0 - x * x / 5.0) } else { x - x.atan() }))
            .map(|(y, y0)| (y / y0 - 1.0).abs())
            .fold(0.0, f64::max);
        assert!(worst < 5e-7, "worst error {worst:e}");
    }

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
