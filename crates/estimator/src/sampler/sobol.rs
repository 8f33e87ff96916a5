//! Owen-scrambled Sobol samples.

use twoforms_geometry::real::{Real, Word};

use super::arithmetic::power_of_two;
use super::scramble::{Scramble, pascal};
use super::{Place, Spread};

/// The first two coordinates of the Sobol sequence, a (0, 2)-sequence in base two, for each pair by itself, as Kollig and
/// Keller 2002, "Efficient multidimensional sampling", pad them; both coordinates and the order scrambled by nested
/// uniform permutations, which are hashed (Burley 2020, "Practical hash-based Owen scrambling").
///
/// N = 2^k samples have one in every elementary interval of that volume. So have those whose index begins at a multiple
/// of a smaller power of two and that are as many, in theirs.
#[derive(Clone, Copy, Debug)]
pub struct Sobol;

impl Spread for Sobol {
    type Plan = ();

    fn plan(_: u32, _: u32) {}

    #[inline(always)]
    fn pair<R: Real>((): &(), place: &Place<R>) -> [R::Word; 2] {
        let [a, b, c, d] = place.seed;
        let [e, f] = [d.wrapping_add(R::Word::splat(1)), d.wrapping_add(R::Word::splat(2))];
        let index = Scramble::new(a, d).of_reversed(place.index.reverse_bits()).reverse_bits();
        let u = Scramble::new(b, e).of_reversed(index).reverse_bits();
        let v = Scramble::new(c, f).of_reversed(pascal(index)).reverse_bits();
        [u, v]
    }

    fn rounded(n: u32) -> u32 {
        power_of_two(n)
    }
}
