//! Sixteen samples side by side: [`Real`] in vectors.

use std::borrow::Borrow;
use std::fmt;

use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdFrom, SimdMask, SimdWiden, f32x16, mask32x16, u32x16};

use super::eight::LaneWide;
use super::long::LaneLong;
use super::proof::proof;
use crate::real::{Mask, Real, Word};

/// Samples side by side.
const LANES: usize = 16;
/// Most different indices among sixteen that are looked up one after the other; where there are more, sample by sample.
const FEW: usize = 4;

/// Sixteen numbers.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S: Simd>(pub(super) f32x16<S>);

/// Sixteen truth values.
#[derive(Clone, Copy)]
pub(super) struct LaneMask<S: Simd>(pub(super) mask32x16<S>);

/// Sixteen words.
#[derive(Clone, Copy)]
pub(super) struct LaneWord<S: Simd>(pub(super) u32x16<S>);

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
    type Long = LaneLong<S>;

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
    #[inline(always)]
    fn long(self) -> LaneLong<S> {
        LaneLong::of(self)
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
