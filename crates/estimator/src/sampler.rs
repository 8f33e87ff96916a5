//! Samplers: how the random numbers of N samples are spread.

use std::fmt;
use std::str::FromStr;

use crate::xi::{Draws, Xi};

/// How ξ_1 … ξ_N are drawn. Every sampler is a function of its key, and every strategy can use it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sampler {
    /// Each sample by itself, uniform.
    Independent,
}

impl Sampler {
    /// All samplers.
    pub const ALL: [Self; 1] = [Self::Independent];

    /// ξ of one sample of an estimate.
    #[inline(always)]
    pub fn xi(self, draws: &Draws, index: u32) -> Xi<f32> {
        match self {
            Self::Independent => draws.independent(index),
        }
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
