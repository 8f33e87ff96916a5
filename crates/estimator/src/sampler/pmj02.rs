//! Progressive multi-jittered (0, 2) samples.

use twoforms_geometry::real::{Real, Word};

use super::arithmetic::{mix, power_of_two};
use super::scramble::pascal;
use super::{Place, Spread};

/// Samples of which every first 2^j, and every 2^j that follow at a multiple of 2^j, lie one in each elementary interval of
/// that volume, and in it at random (Christensen, Kensler and Kilpatrick 2018, "Progressive multi-jittered sample
/// sequences").
///
/// Each choice between two halves is made by a hash of its own, and what the intervals leave open is independent for each
/// sample: the stochastic generation of Helmer, Christensen and Kensler 2021, "Stochastic generation of (t, s) sample
/// sequences", written as a function of the index. Choices in a place for the first time are free, those for the second time
/// fall to the other half; along both axes these are the Sobol sequence's. In distribution the samples are therefore
/// those of [`Sobol`](super::sobol::Sobol) under nested uniform scrambling without a shortcut: `sobol` takes all choices of a
/// coordinate from one hash, faster, and they are not quite independent of each other. The order is scrambled for each
/// pair, as there.
#[derive(Clone, Copy, Debug)]
pub struct Pmj02;

impl Spread for Pmj02 {
    /// k, N = 2^k.
    type Plan = u32;

    fn plan(n: u32, _: u32) -> u32 {
        power_of_two(n).ilog2()
    }

    #[inline(always)]
    fn pair<R: Real>(&digits: &u32, place: &Place<R>) -> [R::Word; 2] {
        let [order, across, up, _] = place.seed;
        let index = scrambled_order(place.index, digits, order);
        let [u, v] = place.noise();
        [scrambled(index, digits, across, u), scrambled(pascal(index), digits, up, v)]
    }

    fn rounded(n: u32) -> u32 {
        power_of_two(n)
    }
}

/// The word whose first digits are those of a word from bit 0 on, each flipped or not by a hash of the digits before it, and
/// whose rest is `rest`.
#[inline(always)]
fn scrambled<W: Word>(reversed: W, digits: u32, seed: W, rest: W) -> W {
    let mut word = if digits < 32 { rest >> digits } else { W::splat(0) };
    for digit in 0..digits {
        let before = (reversed & W::splat((1 << digit) - 1)) | W::splat(1 << digit);
        let flipped = (mix(before ^ seed) >> 31) ^ ((reversed >> digit) & W::splat(1));
        word = word | (flipped << (31 - digit));
    }
    word
}

/// An index below 2^digits with each bit flipped or not by a hash of those above it.
#[inline(always)]
fn scrambled_order<W: Word>(index: W, digits: u32, seed: W) -> W {
    let mut word = index;
    for digit in 0..digits {
        let above = (index >> digit) >> 1;
        let place = W::splat(digit.wrapping_mul(0x9E37_79B9));
        word = word ^ ((mix(above ^ seed.wrapping_add(place)) >> 31) << digit);
    }
    word
}
