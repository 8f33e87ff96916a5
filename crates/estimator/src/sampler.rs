//! Samplers: how the random numbers of N samples are spread.

use std::fmt;
use std::str::FromStr;

use twoforms_geometry::real::Real;

use crate::xi::{DIMENSIONS, Draws, Key, Words, Xi};

/// How ξ_1 … ξ_N are drawn. Every sampler is a function of its key, and every strategy can use it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sampler {
    /// Each sample by itself, uniform.
    Independent,
}

impl Sampler {
    /// All samplers.
    pub const ALL: [Self; 1] = [Self::Independent];

    /// ξ of `n` samples or more of an estimate from `first` on; `first` and N are multiples of 32.
    #[inline(always)]
    pub fn fill<R: Real, const N: usize>(self, draws: &Draws, first: u32, n: usize, words: &mut Words<N>) {
        match self {
            Self::Independent => draws.independent::<R, N>(first, n, words),
        }
    }

    /// ξ of one sample of each of many estimates, whose streams lie side by side.
    #[inline(always)]
    pub fn across<R: Real>(self, key: Key, streams: [R::Word; 2], index: u32) -> Xi<R> {
        match self {
            Self::Independent => Xi::independent(key, streams, index),
        }
    }
}

/// The random numbers of one estimate, as a sampler spreads them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stream {
    /// How they are spread.
    pub sampler: Sampler,
    /// Which they are.
    pub draws: Draws,
}

impl Stream {
    /// ξ of `n` samples or more from `first` on; `first` and N are multiples of 32.
    #[inline(always)]
    pub fn fill<R: Real, const N: usize>(&self, first: u32, n: usize, words: &mut Words<N>) {
        self.sampler.fill::<R, N>(&self.draws, first, n, words);
    }

    /// ξ of one sample.
    pub fn xi(&self, index: u32) -> Xi<f32> {
        const N: usize = 32;
        let (mut words, offset) = ([[0; N]; DIMENSIONS], index as usize % N);
        self.fill::<f32, N>(index - offset as u32, N, &mut words);
        Xi::load(&words, offset)
    }
}

impl fmt::Display for Sampler {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Independent => f.write_str("independent"),
        }
    }
}

/// A name that no sampler has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no sampler \"{name}\"; there is: {all}")]
pub struct UnknownSampler {
    /// What was asked for.
    pub name: String,
    /// All names.
    pub all: String,
}

impl FromStr for Sampler {
    type Err = UnknownSampler;

    fn from_str(name: &str) -> Result<Self, UnknownSampler> {
        Self::ALL.into_iter().find(|sampler| sampler.to_string() == name).ok_or_else(|| UnknownSampler {
            name: name.to_owned(),
            all: Self::ALL.map(|sampler| sampler.to_string()).join(", "),
        })
    }
}
