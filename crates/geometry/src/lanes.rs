//! Sixteen samples side by side, in the widest vectors that the machine has.
//!
//! [`run`] asks the machine once what it can do and runs a [`Kernel`] in vectors of 512, 256 or 128 bits. Sixteen samples
//! go together whatever the width, no operation is contracted, and every operation rounds as IEEE 754 says, so the
//! bits are those of the scalar reference [`f32`] everywhere.
//!
//! A kernel and all that it calls on samples must be `#[inline(always)]`: a function that is not inlined is compiled for
//! the plainest machine.

use std::borrow::Borrow;
use std::fmt;
use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Shl, Shr, Sub};

use fearless_simd::{
    Bytes, Level, Select, Simd, SimdBase, SimdCombine, SimdFloat, SimdFrom, SimdMask, SimdWiden, f32x8, f32x16, f64x8,
    mask32x16, mask64x8, u32x16, u64x8,
};

use crate::real::{Mask, Real, Word};
use crate::wide::{EIGHT, Wide};

/// Samples side by side.
const LANES: usize = 16;
/// Most different indices among sixteen that are looked up one after the other; where there are more, sample by sample.
const FEW: usize = 4;

/// Something to compute in numbers of any kind.
pub trait Kernel {
    /// What comes of it.
    type Output;
    /// Computes it. Implementations are `#[inline(always)]`.
    fn run<R: Real>(self) -> Self::Output;
}

/// The instructions that a kernel is run with.
#[derive(Clone, Copy, Debug)]
pub struct Instructions(Choice);

#[derive(Clone, Copy, Debug)]
enum Choice {
    Scalar,
    Lanes(Level),
}

impl Instructions {
    /// One sample after the other: the reference.
    pub const SCALAR: Self = Self(Choice::Scalar);

    /// The best that this machine has.
    pub fn best() -> Self {
        Self(Choice::Lanes(Level::new()))
    }

    /// All that this machine has, the scalar reference first.
    pub fn all() -> Vec<Self> {
        let level = Level::new();
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let lanes =
            [level.as_sse2().map(Level::Sse2), level.as_avx2().map(Level::Avx2), level.as_avx512().map(Level::Avx512)];
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let lanes = [Some(level)];
        let lanes = lanes.into_iter().flatten().map(|level| Self(Choice::Lanes(level)));
        std::iter::once(Self::SCALAR).chain(lanes).collect()
    }

    /// Runs a kernel with these instructions.
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self.0 {
            Choice::Scalar => kernel.run::<f32>(),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Choice::Lanes(Level::Avx512(simd)) => vectorize(simd, kernel),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Choice::Lanes(Level::Avx2(simd)) => vectorize(simd, kernel),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Choice::Lanes(level) => match level.as_sse2() {
                Some(simd) => vectorize(simd, kernel),
                None => kernel.run::<f32>(),
            },
            #[cfg(target_arch = "aarch64")]
            Choice::Lanes(Level::Neon(simd)) => vectorize(simd, kernel),
            #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
            #[allow(unreachable_patterns)]
            Choice::Lanes(_) => kernel.run::<f32>(),
        }
    }
}

/// Runs a kernel with the best instructions of this machine.
pub fn run<K: Kernel>(kernel: K) -> K::Output {
    Instructions::best().run(kernel)
}

fn vectorize<S: Simd, K: Kernel>(simd: S, kernel: K) -> K::Output {
    simd.vectorize(
        #[inline(always)]
        || kernel.run::<Lanes<S>>(),
    )
}

/// The proof that the machine has the instructions S, for operations that start from nothing (constants).
///
/// It costs 512-bit vectors nothing, where asking the machine again would cost more than the operation.
#[inline(always)]
#[allow(unsafe_code)]
fn proof<S: Simd>() -> S {
    const { assert!(size_of::<S>() == 0) };
    // SAFETY: S is a token without size, so every (zero-sized) value of it is the same value, and one exists: `Lanes<S>`
    // is private to this file and reaches other code only as the `R` of `Kernel::run` in `vectorize`, which was handed a
    // token of S. Whoever calls a function of `Lanes<S>` therefore runs on a machine for which a token of S was made.
    unsafe { std::mem::transmute_copy(&()) }
}

/// Sixteen numbers.
#[derive(Clone, Copy)]
struct Lanes<S: Simd>(f32x16<S>);

/// Sixteen truth values.
#[derive(Clone, Copy)]
struct LaneMask<S: Simd>(mask32x16<S>);

/// Sixteen words.
#[derive(Clone, Copy)]
struct LaneWord<S: Simd>(u32x16<S>);

/// Eight wide numbers.
#[derive(Clone, Copy)]
struct LaneWide<S: Simd>(f64x8<S>);

/// Eight truth values.
#[derive(Clone, Copy)]
struct WideMask<S: Simd>(mask64x8<S>);

impl<S: Simd> LaneWord<S> {
    #[inline(always)]
    fn of(words: [u32; LANES]) -> Self {
        Self(u32x16::simd_from(proof(), words))
    }

    #[inline(always)]
    fn to_array(self) -> [u32; LANES] {
        *self.0
    }
}

/// The different words among sixteen, and where each stands.
enum Few<S: Simd> {
    One(u32),
    Some([Option<(u32, LaneMask<S>)>; FEW]),
    Many,
}

impl<S: Simd> LaneWord<S> {
    #[inline(always)]
    fn few(self) -> Few<S> {
        let first = self.0[0];
        let mut left = !Lanes::same(self, Word::splat(first));
        if !left.any() {
            return Few::One(first);
        }
        let mut found = [Some((first, !left)), None, None, None];
        let words = self.to_array();
        for place in &mut found[1..] {
            let word = words[left.first()];
            let here = Lanes::same(self, Word::splat(word));
            *place = Some((word, here));
            left = left & !here;
            if !left.any() {
                return Few::Some(found);
            }
        }
        Few::Many
    }
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    fn of(numbers: [f32; LANES]) -> Self {
        Self(f32x16::simd_from(proof(), numbers))
    }

    #[inline(always)]
    fn to_array(self) -> [f32; LANES] {
        *self.0
    }
}

impl<S: Simd> Real for Lanes<S> {
    const LANES: usize = LANES;
    type Mask = LaneMask<S>;
    type Word = LaneWord<S>;
    type Wide = LaneWide<S>;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self(f32x16::splat(proof(), value))
    }
    #[inline(always)]
    fn from_word(word: LaneWord<S>) -> Self {
        Self(proof::<S>().cvt_f32_u32x16(word.0))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn lt(self, other: Self) -> LaneMask<S> {
        LaneMask(self.0.simd_lt(other.0))
    }
    #[inline(always)]
    fn le(self, other: Self) -> LaneMask<S> {
        LaneMask(self.0.simd_le(other.0))
    }
    #[inline(always)]
    fn same(one: LaneWord<S>, other: LaneWord<S>) -> LaneMask<S> {
        LaneMask(one.0.simd_eq(other.0))
    }
    #[inline(always)]
    fn below(one: LaneWord<S>, other: LaneWord<S>) -> LaneMask<S> {
        LaneMask(one.0.simd_lt(other.0))
    }
    #[inline(always)]
    fn select(mask: LaneMask<S>, yes: Self, no: Self) -> Self {
        Self(mask.0.select(yes.0, no.0))
    }
    #[inline(always)]
    fn select_word(mask: LaneMask<S>, yes: LaneWord<S>, no: LaneWord<S>) -> LaneWord<S> {
        LaneWord(mask.0.select(yes.0, no.0))
    }
    #[inline(always)]
    fn gather<const K: usize, T: Borrow<[f32; K]>>(index: LaneWord<S>, row: impl Fn(u32) -> T) -> [Self; K] {
        let mut numbers = [Self::zero(); K];
        match index.few() {
            Few::One(index) => {
                let row = row(index);
                let row = row.borrow();
                for k in 0..K {
                    numbers[k] = Self::splat(row[k]);
                }
            }
            Few::Some(found) => {
                for (word, here) in found.into_iter().flatten() {
                    let row = row(word);
                    let row = row.borrow();
                    for k in 0..K {
                        numbers[k] = Self::select(here, Self::splat(row[k]), numbers[k]);
                    }
                }
            }
            Few::Many => {
                let index = index.to_array();
                let mut columns = [[0.0; LANES]; K];
                for lane in 0..LANES {
                    let row = row(index[lane]);
                    let row = row.borrow();
                    for k in 0..K {
                        columns[k][lane] = row[k];
                    }
                }
                for k in 0..K {
                    numbers[k] = Self::of(columns[k]);
                }
            }
        }
        numbers
    }
    #[inline(always)]
    fn gather_word(index: LaneWord<S>, word: impl Fn(u32) -> u32) -> LaneWord<S> {
        match index.few() {
            Few::One(index) => LaneWord::splat(word(index)),
            Few::Some(found) => {
                let mut words = LaneWord::splat(0);
                for (index, here) in found.into_iter().flatten() {
                    words = Self::select_word(here, LaneWord::splat(word(index)), words);
                }
                words
            }
            Few::Many => Self::map_word(index, word),
        }
    }
    #[inline(always)]
    fn map_word(word: LaneWord<S>, f: impl Fn(u32) -> u32) -> LaneWord<S> {
        let mut words = word.to_array();
        for word in &mut words {
            *word = f(*word);
        }
        LaneWord::of(words)
    }
    #[inline(always)]
    fn each<const K: usize>(
        mask: LaneMask<S>,
        word: LaneWord<S>,
        values: [Self; K],
        mut f: impl FnMut(u32, [f32; K]) -> Option<u32>,
    ) -> (LaneMask<S>, LaneWord<S>) {
        let word = word.to_array();
        let mut columns = [[0.0; LANES]; K];
        for k in 0..K {
            columns[k] = values[k].to_array();
        }
        let (mut some, mut answers, mut asked) = (0, [0; LANES], mask.bits());
        while asked != 0 {
            let lane = asked.trailing_zeros() as usize;
            asked &= asked - 1;
            let mut row = [0.0; K];
            for k in 0..K {
                row[k] = columns[k][lane];
            }
            if let Some(answer) = f(word[lane], row) {
                some |= 1 << lane;
                answers[lane] = answer;
            }
        }
        (LaneMask(mask32x16::from_bitmask(proof(), some)), LaneWord::of(answers))
    }
    #[inline(always)]
    fn load(numbers: &[f32]) -> Self {
        Self(f32x16::from_slice(proof(), &numbers[..LANES]))
    }
    #[inline(always)]
    fn store(self, numbers: &mut [f32]) {
        self.0.store_slice(&mut numbers[..LANES]);
    }
    #[inline(always)]
    fn apart<T>(f: impl FnOnce() -> T) -> T {
        proof::<S>().vectorize(f)
    }
    #[inline(always)]
    fn widen(self) -> [LaneWide<S>; 2] {
        let (low, high) = self.0.widen();
        [LaneWide(low), LaneWide(high)]
    }
}

impl<S: Simd> LaneMask<S> {
    #[inline(always)]
    fn bits(self) -> u64 {
        self.0.to_bitmask()
    }

    /// The first sample that it holds for; there must be one.
    #[inline(always)]
    fn first(self) -> usize {
        self.bits().trailing_zeros() as usize % LANES
    }
}

impl<S: Simd> Mask for LaneMask<S> {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        Self(mask32x16::splat(proof(), value))
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.0.any_true()
    }
    #[inline(always)]
    fn count(self) -> u32 {
        self.bits().count_ones()
    }
}

impl<S: Simd> Word for LaneWord<S> {
    #[inline(always)]
    fn splat(value: u32) -> Self {
        Self(u32x16::splat(proof(), value))
    }
    #[inline(always)]
    fn counting(first: u32) -> Self {
        Self(
            u32x16::splat(proof(), first)
                + u32x16::simd_from(proof(), [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15]),
        )
    }
    #[inline(always)]
    fn load(words: &[u32]) -> Self {
        Self(u32x16::from_slice(proof(), &words[..LANES]))
    }
    #[inline(always)]
    fn store(self, words: &mut [u32]) {
        self.0.store_slice(&mut words[..LANES]);
    }
    #[inline(always)]
    fn wrapping_add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
    #[inline(always)]
    fn wrapping_sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
    #[inline(always)]
    fn wrapping_mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
    #[inline(always)]
    fn sum(self) -> u32 {
        self.0.reduce_sum()
    }
    /// Even and odd words are multiplied apart, in 64 bits.
    #[inline(always)]
    fn multiply_wide(self, factor: u32) -> (Self, Self) {
        let pairs: u64x8<S> = self.0.bitcast();
        let low = u64x8::splat(proof(), 0xFFFF_FFFF);
        let factor = u64x8::splat(proof(), u64::from(factor));
        let (even, odd) = ((pairs & low) * factor, (pairs >> 32) * factor);
        let high_words = (even >> 32) | (odd & !low);
        let low_words = (even & low) | (odd << 32);
        (Self(high_words.bitcast()), Self(low_words.bitcast()))
    }
}

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

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

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

impl<S: Simd> fmt::Debug for Lanes<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.to_array().fmt(f)
    }
}

impl<S: Simd> fmt::Debug for LaneWord<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.to_array().fmt(f)
    }
}

impl<S: Simd> fmt::Debug for LaneMask<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016b}", self.bits())
    }
}
