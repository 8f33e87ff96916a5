//! Samplers: how the random numbers of N samples are spread.
//!
//! A sampler is a function: a sample's index, N, and a seed that is random for each stream and pair of numbers, to the
//! sample's two words. So any sample can be asked for by itself, on any thread.

mod fill;
mod independent;

use std::fmt;
use std::str::FromStr;

pub use fill::{ROW, Row, Stream};
use twoforms_geometry::real::Real;

/// Where a pair of random numbers is wanted.
#[derive(Clone, Copy, Debug)]
pub struct Place<R: Real> {
    /// The sample's index, below N.
    pub index: R::Word,
    /// N: samples of the estimate.
    pub n: u32,
    /// Which of the pairs that a sample takes.
    pub pair: u32,
    /// Random words, independent for each stream and pair.
    pub seed: [R::Word; 4],
}

/// One way to spread the samples of an estimate over the unit square.
pub trait Spread {
    /// The two words at a place, each uniform over replicates.
    fn pair<R: Real>(place: &Place<R>) -> [R::Word; 2];

    /// The words at two places of one stream and pair.
    #[inline(always)]
    fn two<R: Real>([one, other]: [Place<R>; 2]) -> [[R::Word; 2]; 2] {
        [Self::pair(&one), Self::pair(&other)]
    }

    /// The least number of samples that it can spread, at least `n`.
    fn rounded(n: u32) -> u32 {
        n
    }
}

/// The list of samplers: a line for each, with the file it stands in and its name.
macro_rules! samplers {
    ($($(#[$doc:meta])* $file:ident::$sampler:ident = $name:literal,)*) => {
        /// How ξ_1 … ξ_N are drawn. Every sampler is a function of its key, and every strategy can use it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Sampler {
            $($(#[$doc])* $sampler,)*
        }

        impl Sampler {
            /// All samplers.
            pub const ALL: &'static [Self] = &[$(Self::$sampler),*];

            /// Its name.
            pub fn name(self) -> &'static str {
                match self { $(Self::$sampler => $name),* }
            }

            /// The least number of samples that it can spread, at least `n`.
            pub fn rounded(self, n: u32) -> u32 {
                match self { $(Self::$sampler => <$file::$sampler as Spread>::rounded(n)),* }
            }

            fn run<F: fill::Fill>(self, fill: F) {
                match self { $(Self::$sampler => fill.run::<$file::$sampler>()),* }
            }
        }
    };
}

samplers! {
    /// Each sample by itself, uniform.
    independent::Independent = "independent",
}

impl fmt::Display for Sampler {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
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
        Self::ALL.iter().copied().find(|sampler| sampler.name() == name).ok_or_else(|| UnknownSampler {
            name: name.to_owned(),
            all: Self::ALL.iter().map(|sampler| sampler.name()).collect::<Vec<_>>().join(", "),
        })
    }
}
