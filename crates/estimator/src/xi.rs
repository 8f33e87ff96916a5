//! ξ: the random numbers of one sample, as a function of who asks.

use rand_philox::splitmix64;
use twoforms_geometry::real::{Real, Word};

use crate::philox::philox4x32_10;

/// Who asks for random numbers. Two askers with different keys have independent numbers; the same key always has the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Key([u32; 2]);

impl Key {
    /// The key of a sequence of words, for instance the seed, the bits of a position, and the bytes of a name.
    ///
    /// Each word is mixed in by the finaliser of SplitMix64 (Steele, Lea, Flood 2014) over a Weyl sequence, so that the
    /// key depends on every word and on their order.
    pub fn new(words: impl IntoIterator<Item = u64>) -> Self {
        const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;
        let mix = |key: u64, word: u64| splitmix64(key.wrapping_add(GOLDEN) ^ splitmix64(word.wrapping_add(GOLDEN)));
        let key = words.into_iter().fold(0, mix);
        Self([key as u32, (key >> 32) as u32])
    }

    /// The bytes of a name as words.
    pub fn words_of(name: &str) -> impl Iterator<Item = u64> + '_ {
        name.bytes().map(u64::from)
    }
}

/// The random numbers of one estimate: a key, and which of the key's streams.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draws {
    /// Who asks.
    pub key: Key,
    /// The stream: N and the replicate in a comparison, the pixel and its camera sample in an image.
    pub stream: [u32; 2],
}

/// Random words of some samples: for each dimension, one word a sample.
pub type Words<const N: usize> = [[u32; N]; DIMENSIONS];

/// Random numbers that one sample takes.
pub const DIMENSIONS: usize = 2;

/// A counter serves this many samples, and as many later ones.
const RUN: usize = 16;

impl Draws {
    /// ξ of `n` samples or more from `first` on by independent draws; `first` and N are multiples of 32.
    ///
    /// Philox gives four words a counter, and a sample takes two of them: sample 32b + 16h + j has words 2h and 2h + 1 at
    /// the counter (16b + j, block of dimensions, stream).
    #[inline(always)]
    pub fn independent<R: Real, const N: usize>(&self, first: u32, n: usize, words: &mut Words<N>) {
        let [one, other] = self.stream;
        for block in (0..n).step_by(2 * RUN) {
            for k in (0..RUN).step_by(R::LANES) {
                let index = first / 2 + (block / 2 + k) as u32;
                let counter = [R::Word::counting(index), Word::splat(0), Word::splat(one), Word::splat(other)];
                let [a, b, c, d] = philox4x32_10(counter, self.key.0);
                let (now, later) = (block + k, block + RUN + k);
                a.store(&mut words[0][now..]);
                b.store(&mut words[1][now..]);
                c.store(&mut words[0][later..]);
                d.store(&mut words[1][later..]);
            }
        }
    }
}

/// Two random words of one sample, reached by name.
#[derive(Clone, Copy, Debug)]
pub struct Xi<R: Real> {
    words: [R::Word; DIMENSIONS],
}

impl<R: Real> Xi<R> {
    /// ξ of these words.
    pub fn new(words: [R::Word; DIMENSIONS]) -> Self {
        Self { words }
    }

    /// ξ of one sample of each of many estimates by independent draws: those of [`Draws::independent`].
    #[inline(always)]
    pub fn independent(key: Key, [one, other]: [R::Word; 2], index: u32) -> Self {
        const HALF: u32 = RUN as u32;
        let counter = index / (2 * HALF) * HALF + index % HALF;
        let [a, b, c, d] = philox4x32_10([Word::splat(counter), Word::splat(0), one, other], key.0);
        Self { words: if (index / HALF).is_multiple_of(2) { [a, b] } else { [c, d] } }
    }

    /// ξ of the samples from `offset` on.
    #[inline(always)]
    pub fn load<const N: usize>(words: &Words<N>, offset: usize) -> Self {
        Self { words: [R::Word::load(&words[0][offset..]), R::Word::load(&words[1][offset..])] }
    }

    /// The word that picks the target and, rescaled, serves as u.
    #[inline(always)]
    pub fn pick(&self) -> R::Word {
        self.words[0]
    }

    /// v: the second number of a point on a target.
    #[inline(always)]
    pub fn v(&self) -> R {
        unit(self.words[1])
    }

    /// (u, v): two uniform numbers in (0, 1].
    #[inline(always)]
    pub fn uv(&self) -> [R; 2] {
        [unit(self.words[0]), self.v()]
    }

    /// The raw words.
    pub fn words(&self) -> [R::Word; DIMENSIONS] {
        self.words
    }
}

/// (w + 1/2) / 2³², rounded: uniform in (0, 1].
#[inline(always)]
pub(crate) fn unit<R: Real>(word: R::Word) -> R {
    (R::from_word(word) + R::splat(0.5)) * R::splat(1.0 / 4_294_967_296.0)
}
