//! Nested uniform scrambling of binary digits.

use twoforms_geometry::real::Word;

use super::arithmetic::mix;

/// A random bijection of words in which each bit depends on those below it alone: nested uniform scrambling (Owen 1995) of
/// digits that stand in reverse, the first at bit 0.
///
/// The form is that of Laine and Karras 2011, "Stratified sampling for stochastic transparency", with the constants of Vegdahl
/// 2021, "Building a better LK hash". What is added and what is multiplied with come from words of their own, so that
/// every word goes to any other with the same probability.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scramble<W> {
    add: W,
    multiply: W,
}

impl<W: Word> Scramble<W> {
    /// The scrambling that belongs to a random word `add` and another one.
    #[inline(always)]
    pub(super) fn new(add: W, other: W) -> Self {
        Self { add, multiply: mix(other) | W::splat(1) }
    }

    /// Scrambles digits that stand in reverse.
    #[inline(always)]
    pub(super) fn of_reversed(self, word: W) -> W {
        let word = with_multiple(word, 0x3D20_ADEA).wrapping_add(self.add).wrapping_mul(self.multiply);
        with_multiple(with_multiple(word, 0x0552_6C56), 0x53A2_2864)
    }
}

#[inline(always)]
fn with_multiple<W: Word>(word: W, factor: u32) -> W {
    word ^ word.wrapping_mul(W::splat(factor))
}

/// The second coordinate of the Sobol sequence, from an index to digits that stand in reverse.
///
/// Its matrix is Pascal's triangle modulo two (Sobol 1967): digit j is the sum of the bits i of the index with C(i, j) odd, which
/// by Lucas is where the binary digits of i hold those of j. It is a Kronecker power, and so five steps.
#[inline(always)]
pub(super) fn pascal<W: Word>(word: W) -> W {
    let word = step(step(word, 1, 0xAAAA_AAAA), 2, 0xCCCC_CCCC);
    step(step(step(word, 4, 0xF0F0_F0F0), 8, 0xFF00_FF00), 16, 0xFFFF_0000)
}

#[inline(always)]
fn step<W: Word>(word: W, shift: u32, mask: u32) -> W {
    word ^ ((word & W::splat(mask)) >> shift)
}

#[cfg(test)]
mod tests {
    use super::pascal;

    /// Direction numbers 1, 3, 5, 15, 17, 51, 85, 255 of the second dimension (Bratley and Fox 1988, table 2).
    #[test]
    fn the_second_coordinate_has_the_known_direction_numbers() {
        for (k, m) in [1_u32, 3, 5, 15, 17, 51, 85, 255].into_iter().enumerate() {
            assert_eq!(pascal(1_u32 << k).reverse_bits(), m << (31 - k));
        }
    }
}
