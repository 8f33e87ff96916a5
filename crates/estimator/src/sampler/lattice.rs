//! Rank-1 lattices with a random shift.

use twoforms_geometry::real::{Real, Word};

use super::arithmetic::power_of_two;
use super::scramble::Scramble;
use super::{Place, Spread};

/// The points φ(i)·z + Δ modulo 1, φ the radical inverse in base two, z a generating vector and Δ a shift that is random for
/// each pair (Cranley and Patterson 1976). N = 2^k points are a rank-1 lattice, the same as i·z/N. The pairs of a sample
/// take successive components of z, so that they are spread together; their order is scrambled.
///
/// z is an embedded lattice sequence, one vector that is good for every power of two from 2¹⁰ to 2²⁰ (Cools, Kuo and Nuyens
/// 2006, "Constructing embedded lattice rules for multivariate integration"; the first components of Kuo's vector
/// `lattice-33002-1024-1048576`). Fewer or more points are as unbiased. From the seventeenth pair on components are taken
/// again, with an order of their own for each pair.
#[derive(Clone, Copy, Debug)]
pub struct Lattice;

/// Components of z.
const Z: [u32; 32] = [
    1, 182_667, 213_731, 255_351, 96_013, 116_671, 479_315, 424_089, 271_103, 464_421, 124_483, 230_887, 392_877,
    162_965, 109_125, 168_491, 216_103, 5_613, 207_895, 506_745, 189_519, 114_879, 133_967, 374_257, 254_597, 502_087,
    298_245, 191_333, 242_099, 285_991, 397_887, 507_051,
];

/// Two components of z, and whether they are taken for the first time.
#[derive(Clone, Copy, Debug)]
pub struct Generator {
    z: [u32; 2],
    first: bool,
}

impl Spread for Lattice {
    type Plan = Generator;

    fn plan(_: u32, pair: u32) -> Generator {
        let dimension = 2 * pair as usize;
        let z = [Z[dimension % Z.len()], Z[(dimension + 1) % Z.len()]];
        Generator { z, first: dimension < Z.len() }
    }

    #[inline(always)]
    fn pair<R: Real>(&Generator { z: [z, w], first }: &Generator, place: &Place<R>) -> [R::Word; 2] {
        let [a, b, ..] = place.seed;
        let [order, other] = place.order(first);
        let inverse = Scramble::new(order, other).of_reversed(place.index.reverse_bits());
        [coordinate(inverse, z, a), coordinate(inverse, w, b)]
    }

    fn rounded(n: u32) -> u32 {
        power_of_two(n)
    }
}

/// φ·z + Δ modulo 1.
#[inline(always)]
fn coordinate<W: Word>(inverse: W, z: u32, shift: W) -> W {
    inverse.wrapping_mul(W::splat(z)).wrapping_add(shift)
}
