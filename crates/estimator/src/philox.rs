//! The counter-based generator behind ξ, for many counters at once.

use twoforms_geometry::real::{Long, Word};

/// The multiplier of a round for two words.
const M2: u32 = 0xD256_D193;
/// The multipliers of a round for four.
const M: [u32; 2] = [0xD251_1F53, 0xCD9E_8D57];
/// What a round adds to the key: the golden ratio and √3 − 1, times 2³².
const WEYL: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];
const ROUNDS: usize = 10;

/// Four random words for each counter, by Philox 4×32-10 (Salmon, Moraes, Dror, Shaw 2011, "Parallel random numbers: as
/// easy as 1, 2, 3"): the high words of two products are mixed, their low words go on as they are.
#[inline(always)]
pub fn philox4x32_10<W: Word>([a, b, c, d]: [W; 4], [mut k, mut l]: [u32; 2]) -> [W; 4] {
    let [mut a, mut b, mut c, mut d] = [a.long(), b.long(), c.long(), d.long()];
    for _ in 0..ROUNDS {
        let (p, q) = (a.times(M[0]), c.times(M[1]));
        [a, b, c, d] = [q.high() ^ b ^ W::splat(k).long(), q, p.high() ^ d ^ W::splat(l).long(), p];
        (k, l) = (k.wrapping_add(WEYL[0]), l.wrapping_add(WEYL[1]));
    }
    [a.word(), b.word(), c.word(), d.word()]
}

/// Two random words for each counter and key, by Philox 2×32-10 (of the same family and paper).
#[inline(always)]
pub fn philox2x32_10<W: Word>([a, b]: [W; 2], mut key: W) -> [W; 2] {
    let [mut a, mut b] = [a.long(), b.long()];
    for _ in 0..ROUNDS {
        let p = a.times(M2);
        [a, b] = [p.high() ^ key.long() ^ b, p];
        key = key.wrapping_add(W::splat(WEYL[0]));
    }
    [a.word(), b.word()]
}

#[cfg(test)]
mod tests {
    use super::{philox2x32_10, philox4x32_10};

    /// The known answers that the authors publish with their implementation (Random123, kat_vectors).
    #[test]
    fn two_words_are_those_of_the_known_answers() {
        assert_eq!(philox2x32_10([0, 0], 0), [0xFF1D_AE59, 0x6CD1_0DF2]);
        assert_eq!(philox2x32_10([u32::MAX, u32::MAX], u32::MAX), [0x2C3F_628B, 0xAB4F_D7AD]);
        assert_eq!(philox2x32_10([0x243F_6A88, 0x85A3_08D3], 0x1319_8A2E), [0xDD7C_E038, 0xF62A_4C12]);
    }

    #[test]
    fn words_are_those_of_the_reference_implementation() {
        let key = [0xA409_3822, 0x299F_31D0];
        for index in 0..1000_u32 {
            let counter = [index, index.wrapping_mul(0x85A3_08D3), 0x1319_8A2E, !index];
            assert_eq!(philox4x32_10(counter, key), rand_philox::philox4x32_10(counter, key));
        }
    }
}
