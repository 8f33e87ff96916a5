//! ξ: a pair of random numbers of one sample, and who asks for them.

use rand_philox::splitmix64;
use twoforms_geometry::real::{Real, Word};

use crate::numbers::ROOM;

/// Who asks for random numbers. Two askers with different keys have independent numbers; the same key always has the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Key(pub(crate) [u32; 2]);

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

/// Two random words of one sample, reached by name.
#[derive(Clone, Copy, Debug)]
pub struct Xi<R: Real> {
    words: [R::Word; 2],
}

impl<R: Real> Xi<R> {
    /// ξ of these words.
    pub fn new(words: [R::Word; 2]) -> Self {
        Self { words }
    }

    /// ξ of the samples from `offset` on.
    #[inline(always)]
    pub(crate) fn load(words: &[[u32; ROOM]; 2], offset: usize) -> Self {
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
    pub fn words(&self) -> [R::Word; 2] {
        self.words
    }
}

/// (w + 1/2) / 2³², rounded: uniform in (0, 1].
#[inline(always)]
pub(crate) fn unit<R: Real>(word: R::Word) -> R {
    (R::from_word(word) + R::splat(0.5)) * R::splat(1.0 / 4_294_967_296.0)
}
