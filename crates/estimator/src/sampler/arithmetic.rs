//! Whole-number arithmetic of samplers: strata, division, hashes and permutations, in lanes.

use twoforms_geometry::real::{Mask, Real, Word};

/// Division of words by a number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Divisor {
    by: u32,
    /// ⌊(2³² − 1) / by⌋.
    reciprocal: u32,
}

impl Divisor {
    /// Division by a positive number.
    pub(super) fn new(by: u32) -> Self {
        Self { by, reciprocal: u32::MAX / by }
    }

    /// Quotient and remainder. What the reciprocal gives is the quotient or one less, as 2³²/by − reciprocal <= 1.
    #[inline(always)]
    pub(super) fn split<R: Real>(self, word: R::Word) -> [R::Word; 2] {
        let by = R::Word::splat(self.by);
        let quotient = word.multiply_high(self.reciprocal);
        let rest = word.wrapping_sub(quotient.wrapping_mul(by));
        let whole = R::below(rest, by);
        let more = [quotient.wrapping_add(R::Word::splat(1)), rest.wrapping_sub(by)];
        [R::select_word(whole, quotient, more[0]), R::select_word(whole, rest, more[1])]
    }
}

/// The unit interval in equal strata.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strata {
    /// 2⁶⁴ / (number of strata), rounded up, in two words.
    high: u32,
    low: u32,
}

impl Strata {
    /// So many strata, at least one.
    pub(super) fn new(count: u32) -> Self {
        let width = u64::MAX / u64::from(count);
        let width = if count == 1 { u64::MAX } else { width + 1 };
        Self { high: (width >> 32) as u32, low: width as u32 }
    }

    /// The word of a place in a stratum: (stratum + place/2³²) / count · 2³², to two units in the last place.
    #[inline(always)]
    pub(super) fn word<W: Word>(self, stratum: W, place: W) -> W {
        let carry = stratum.multiply_high(self.low);
        let inside = place.multiply_high(self.high);
        stratum.wrapping_mul(W::splat(self.high)).wrapping_add(carry).wrapping_add(inside)
    }
}

/// A hash of 32 bits to 32 bits, and a bijection of them (Wellons 2018, "Prospecting for hash functions"; the constants
/// are those that TheIronBorn found in 2023, with a bias of 0.11 in 1000).
#[inline(always)]
pub(super) fn mix<W: Word>(word: W) -> W {
    let word = (word ^ (word >> 16)).wrapping_mul(W::splat(0x21F0_AAAD));
    let word = (word ^ (word >> 15)).wrapping_mul(W::splat(0xD35A_2D97));
    word ^ (word >> 15)
}

/// A random word below a bound: the high part of bound times a uniform word.
#[inline(always)]
pub(super) fn below<W: Word>(word: W, bound: u32) -> W {
    word.multiply_high(bound)
}

/// a + b modulo m, both below m < 2³¹.
#[inline(always)]
pub(super) fn add_modulo<R: Real>(a: R::Word, b: R::Word, m: u32) -> R::Word {
    let (sum, m) = (a.wrapping_add(b), R::Word::splat(m));
    R::select_word(R::below(sum, m), sum, sum.wrapping_sub(m))
}

/// Seeds of the steps of a permutation.
#[inline(always)]
fn step_seed<W: Word>(seed: W, step: u32) -> W {
    seed.wrapping_add(W::splat(step.wrapping_mul(0x9E37_79B9)))
}

/// A random bijection of the cells of a grid, a below m and b below n.
///
/// In turn each coordinate moves around by as much as a hash of the other says: a network after Feistel whose halves are
/// of any size (Black and Rogaway 2002, "Ciphers with arbitrary finite domains"), so that no cell is met twice and none has
/// to be walked past. Where any one cell goes is uniform by its last two steps.
#[inline(always)]
pub(super) fn shuffle_cells<R: Real>([mut a, mut b]: [R::Word; 2], [m, n]: [u32; 2], seed: R::Word) -> [R::Word; 2] {
    for step in 0..3 {
        a = add_modulo::<R>(a, below(mix(b ^ step_seed(seed, 2 * step)), m), m);
        b = add_modulo::<R>(b, below(mix(a ^ step_seed(seed, 2 * step + 1)), n), n);
    }
    [a, b]
}

/// A random bijection of the numbers below a bound (Kensler 2013, "Correlated multi-jittered sampling", listing of
/// `permute`): a hash of just enough bits, walked along until it comes back below the bound, then moved around. An index that is not
/// below the bound is taken for zero: its walk might never come back.
#[inline(always)]
pub(super) fn permute<R: Real>(index: R::Word, bound: u32, seed: R::Word) -> R::Word {
    let (limit, bits) = (R::Word::splat(bound), u32::MAX.checked_shr((bound - 1).leading_zeros()).unwrap_or(0));
    let index = R::select_word(R::below(index, limit), index, R::Word::splat(0));
    let mut word = hash_of_bits(index, bits, seed);
    loop {
        let inside = R::below(word, limit);
        if !(!inside).any() {
            break;
        }
        word = R::select_word(inside, word, hash_of_bits(word, bits, seed));
    }
    add_modulo::<R>(word, below(mix(seed), bound), bound)
}

/// A hash of words below a power of two to such words, `bits` being the power less one.
#[inline(always)]
fn hash_of_bits<W: Word>(word: W, bits: u32, seed: W) -> W {
    let mask = W::splat(bits);
    let word = times(word ^ seed, 0xE170_893D) ^ (seed >> 16);
    let word = times(folded(word, mask, 4) ^ (seed >> 8), 0x0929_EB3F) ^ (seed >> 23);
    let word = folded(word, mask, 1).wrapping_mul((seed >> 27) | W::splat(1));
    let word = times(word, 0x6935_FA69);
    let word = times(folded(word, mask, 11), 0x74DC_B303);
    let word = times(folded(word, mask, 2), 0x9E50_1CC3);
    let word = times(folded(word, mask, 2), 0xC860_A3DF) & mask;
    word ^ (word >> 5)
}

#[inline(always)]
fn times<W: Word>(word: W, factor: u32) -> W {
    word.wrapping_mul(W::splat(factor))
}

#[inline(always)]
fn folded<W: Word>(word: W, mask: W, shift: u32) -> W {
    word ^ ((word & mask) >> shift)
}

/// ⌈√n⌉, at most 65 535.
pub(super) fn side(n: u32) -> u32 {
    let root = n.isqrt();
    (if root * root < n { root + 1 } else { root }).clamp(1, 0xFFFF)
}

/// The least power of two that is at least n, at most 2³¹.
pub(super) fn power_of_two(n: u32) -> u32 {
    n.min(1 << 31).next_power_of_two()
}

#[cfg(test)]
mod tests {
    use super::{Divisor, Strata, permute, shuffle_cells};

    #[test]
    fn division_is_exact() {
        for by in [1, 2, 3, 7, 16, 641, 65_535, 65_536, 1 << 31, u32::MAX] {
            for word in
                (0..2000).chain((0..2000).map(|k| u32::MAX - k)).chain((0..2000).map(|k: u32| k.wrapping_mul(by)))
            {
                assert_eq!(Divisor::new(by).split::<f32>(word), [word / by, word % by], "{word} / {by}");
            }
        }
    }

    #[test]
    fn strata_lie_side_by_side() {
        for count in [1_u32, 2, 3, 10, 1 << 10, 1_000_003] {
            let strata = Strata::new(count);
            for stratum in (0..count).step_by(1 + count as usize / 50).chain([count - 1]) {
                let at = |edge: u64| edge as f64 / f64::from(count) * 4_294_967_296.0;
                let [first, last] = [strata.word(stratum, 0), strata.word(stratum, u32::MAX)].map(f64::from);
                assert!((first - at(stratum.into())).abs() <= 2.0, "{stratum} of {count}: {first}");
                assert!((last - at(u64::from(stratum) + 1)).abs() <= 3.0, "{stratum} of {count}: {last}");
            }
        }
    }

    #[test]
    fn permutations_meet_every_number_once() {
        for bound in [1, 2, 3, 5, 16, 17, 100, 1000] {
            for seed in [0, 1, 0xDEAD_BEEF] {
                let mut met: Vec<u32> = (0..bound).map(|k| permute::<f32>(k, bound, seed)).collect();
                met.sort_unstable();
                assert!(met.into_iter().eq(0..bound), "{bound} with {seed}");
            }
        }
    }

    #[test]
    fn shuffles_meet_every_cell_once() {
        for [m, n] in [[1, 1], [1, 5], [2, 2], [3, 7], [32, 33]] {
            for seed in [0, 1, 0xDEAD_BEEF] {
                let cells = (0..m * n).map(|k| shuffle_cells::<f32>([k % m, k / m], [m, n], seed));
                let mut met: Vec<u32> = cells.map(|[a, b]| b * m + a).collect();
                met.sort_unstable();
                assert!(met.into_iter().eq(0..m * n), "{m} by {n} with {seed}");
            }
        }
    }
}
