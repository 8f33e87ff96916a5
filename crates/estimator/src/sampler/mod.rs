//! Samplers: how the random numbers of N samples are spread.
//!
//! A sampler is a function: a sample's index, N, and a seed that is random for each stream and pair of numbers, to the
//! sample's two words. So any sample can be asked for by itself, on any thread.

mod arithmetic;
mod fill;
mod halton;
mod independent;
mod jittered;
mod lattice;
mod multi_jittered;
mod pmj02;
mod quadrature;
mod scramble;
mod sobol;

use std::fmt;
use std::str::FromStr;

pub use fill::{Parts, ROW, ROWS, Row, Stream};
use twoforms_geometry::real::Real;

use crate::philox::philox2x32_10;

/// Where a pair of random numbers is wanted.
#[derive(Clone, Copy, Debug)]
pub struct Place<R: Real> {
    /// The sample's index. What samples beyond N come to counts for nothing.
    pub index: R::Word,
    /// Random words, independent for each stream and pair.
    pub seed: [R::Word; 4],
    /// Random words, independent for each stream, the same for all of its pairs.
    pub common: [R::Word; 2],
}

impl<R: Real> Place<R> {
    /// Two words that are independent for each sample: Philox 2×32-10 of the index, with what is left of counter and key
    /// from the stream.
    #[inline(always)]
    fn noise(&self) -> [R::Word; 2] {
        let [key, high, ..] = self.seed;
        philox2x32_10([self.index, high], key)
    }

    /// Random words for the order of samples: the same for all pairs that are spread together.
    #[inline(always)]
    fn order(&self, together: bool) -> [R::Word; 2] {
        let [_, _, a, b] = self.seed;
        if together { self.common } else { [a, b] }
    }
}

/// One way to spread the samples of an estimate over the unit square.
pub trait Spread {
    /// What is worked out once for N and which of the pairs that a sample takes it is.
    type Plan;

    /// Whether the words differ from replicate to replicate.
    const RANDOM: bool = true;
    /// Whether samples do not count alike.
    const WEIGHTED: bool = false;

    /// Works it out.
    fn plan(n: u32, pair: u32) -> Self::Plan;

    /// The two words at a place, each uniform over replicates where they are random.
    fn pair<R: Real>(plan: &Self::Plan, place: &Place<R>) -> [R::Word; 2];

    /// How much the sample counts, 1 in the mean over N.
    #[inline(always)]
    fn weight<R: Real>(_: &Self::Plan, _: &Place<R>) -> R {
        R::one()
    }

    /// The least number of samples that it can spread, at least `n` where there is one.
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

            /// The least number of samples that it can spread, at least `n` where there is one.
            pub fn rounded(self, n: u32) -> u32 {
                match self { $(Self::$sampler => <$file::$sampler as Spread>::rounded(n)),* }
            }

            /// Whether its words differ from replicate to replicate. Those of a deterministic rule do not: its estimates have
            /// an error and no variance.
            pub fn is_random(self) -> bool {
                match self { $(Self::$sampler => <$file::$sampler as Spread>::RANDOM),* }
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
    /// One in each cell of a square grid.
    jittered::Jittered = "jittered",
    /// One in each cell of a grid, each column and each row.
    multi_jittered::MultiJittered = "multi-jittered",
    /// Radical inverses in prime bases, scrambled.
    halton::Halton = "halton",
    /// A (0, 2)-sequence, Owen-scrambled by a hash.
    sobol::Sobol = "sobol",
    /// A (0, 2)-sequence, each of whose choices is made by itself.
    pmj02::Pmj02 = "pmj02",
    /// A rank-1 lattice with a random shift.
    lattice::Lattice = "lattice",
    /// The midpoint rule.
    quadrature::Midpoint = "quadrature",
    /// The Gauss–Legendre rule.
    quadrature::Gauss = "quadrature/gauss",
}

/// Why a sampler cannot spread the numbers of a strategy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{sampler} is a rule for one pair of numbers, and a sample takes {pairs}: take a sampler that is random")]
pub struct TooManyPairs {
    /// The sampler.
    pub sampler: Sampler,
    /// Pairs of numbers that a sample takes.
    pub pairs: usize,
}

impl Sampler {
    /// Makes sure that it can spread samples that take so many pairs of numbers.
    ///
    /// # Errors
    /// A deterministic rule is a rule for one pair: with more it would meet the diagonal of their product alone.
    pub fn admit(self, pairs: usize) -> Result<(), TooManyPairs> {
        if self.is_random() || pairs <= 1 { Ok(()) } else { Err(TooManyPairs { sampler: self, pairs }) }
    }
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
