//! Scrambled Halton samples.

use twoforms_geometry::real::{Real, Word};

use super::arithmetic::{Divisor, Strata, add_modulo, below, mix, permute};
use super::{Place, Spread};

/// The Halton sequence (Halton 1960): each coordinate the radical inverse of the index in another prime base, those of the first
/// pair 2 and 3. Digits are scrambled by nested random linear permutations d → a·d + c modulo the base, a and c a hash of the
/// digits before (Owen 1995; Matoušek 1998, "On the L2-discrepancy for anchored boxes"); what N samples leave open of
/// a coordinate is independent for each sample. Any N will do.
///
/// The pairs of a sample take successive primes, so that they are spread together, in one random order. There are
/// primes for sixteen numbers; from the ninth pair on they are taken again, with an order of their own for each pair.
#[derive(Clone, Copy, Debug)]
pub struct Halton;

const PRIMES: [u32; 16] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53];

/// How a pair of numbers comes from an index.
#[derive(Clone, Copy, Debug)]
pub struct Bases {
    n: u32,
    numbers: [Base; 2],
    /// Whether the primes are taken for the first time.
    first: bool,
}

/// Digits in a base.
#[derive(Clone, Copy, Debug)]
struct Base {
    prime: u32,
    division: Divisor,
    /// How many digits tell N samples apart.
    digits: u32,
    strata: Strata,
}

impl Base {
    fn new(prime: u32, n: u32) -> Self {
        let (mut digits, mut strata) = (0, 1_u32);
        while let Some(more) = strata.checked_mul(prime).filter(|_| strata < n) {
            (digits, strata) = (digits + 1, more);
        }
        Self { prime, division: Divisor::new(prime), digits, strata: Strata::new(strata) }
    }

    /// The scrambled radical inverse.
    #[inline(always)]
    fn inverse<R: Real>(&self, mut index: R::Word, seed: R::Word, rest: R::Word) -> R::Word {
        let mut stratum = R::Word::splat(0);
        for digit in 0..self.digits {
            let [quotient, value] = self.division.split::<R>(index);
            index = quotient;
            let node = mix(stratum ^ seed.wrapping_add(R::Word::splat(digit.wrapping_mul(0x9E37_79B9))));
            let value = self.permuted::<R>(value, node);
            stratum = stratum.wrapping_mul(R::Word::splat(self.prime)).wrapping_add(value);
        }
        self.strata.word(stratum, rest)
    }

    /// a·d + c modulo the base, 1 <= a < base and 0 <= c < base from a random word.
    #[inline(always)]
    fn permuted<R: Real>(&self, digit: R::Word, random: R::Word) -> R::Word {
        let c = below(random, self.prime);
        if self.prime == 2 {
            return digit ^ c;
        }
        let a = below(random.wrapping_mul(R::Word::splat(0x9E37_79B1)), self.prime - 1).wrapping_add(R::Word::splat(1));
        let [_, product] = self.division.split::<R>(a.wrapping_mul(digit));
        add_modulo::<R>(product, c, self.prime)
    }
}

impl Spread for Halton {
    type Plan = Bases;

    fn plan(n: u32, pair: u32) -> Bases {
        let dimension = 2 * pair as usize;
        let base = |dimension: usize| Base::new(PRIMES[dimension % PRIMES.len()], n);
        Bases { n, numbers: [base(dimension), base(dimension + 1)], first: dimension < PRIMES.len() }
    }

    #[inline(always)]
    fn pair<R: Real>(Bases { n, numbers: [one, other], first }: &Bases, place: &Place<R>) -> [R::Word; 2] {
        let [a, b, ..] = place.seed;
        let [order, _] = place.order(*first);
        let index = permute::<R>(place.index, *n, order);
        let [u, v] = place.noise();
        [one.inverse::<R>(index, a, u), other.inverse::<R>(index, b, v)]
    }
}
