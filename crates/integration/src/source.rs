//! Where random numbers come from.

use twoforms_estimator::numbers::{BATCH, Numbers};
use twoforms_estimator::sampler::{Sampler, Stream};
use twoforms_estimator::xi::{Draws, Key};
use twoforms_geometry::lanes::Instructions;

use crate::error::Error;

/// A sampler and a seed: random numbers for every N and replicate.
///
/// The numbers are a function of sampler, seed, N and replicate. Variables that ask the same source for the same stream see the
/// same ξ, which is what one wants to compare them sample by sample; to have them independent, give each a seed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Source {
    /// How samples are spread.
    pub sampler: Sampler,
    /// Which they are.
    pub seed: u64,
}

impl Source {
    /// Independent samples.
    pub fn independent(seed: u64) -> Self {
        Self { sampler: Sampler::Independent, seed }
    }

    /// The random numbers of one estimate of N samples, N rounded up to what the sampler can spread.
    pub fn stream(&self, n: u32, replicate: u32) -> Stream {
        let key = Key::new([self.seed].into_iter().chain(Key::words_of(self.sampler.name())));
        let n = self.sampler.rounded(n);
        Stream { sampler: self.sampler, draws: Draws { key, stream: [n, replicate] }, n }
    }
}

/// Hands over each sample of a stream in turn: its index, its ξ, each (w + 1/2)/2³² of a word w and so in (0, 1), and how much it
/// counts, 1 in the mean.
///
/// # Errors
/// [`Error::NoSamples`], [`Error::Sampler`], and those of `each`.
pub(crate) fn for_each(
    stream: &Stream,
    dimension: usize,
    mut each: impl FnMut(u32, &[f64], f64) -> Result<(), Error>,
) -> Result<(), Error> {
    let pairs = dimension.div_ceil(2);
    stream.sampler.admit(pairs)?;
    if stream.n == 0 {
        return Err(Error::NoSamples);
    }
    let (mut numbers, mut xi) = (Numbers::new(pairs), vec![0.0; 2 * pairs]);
    for first in (0..stream.n).step_by(BATCH) {
        let length = BATCH.min((stream.n - first) as usize);
        stream.fill(Instructions::best(), first, length, &mut numbers);
        for offset in 0..length {
            let drawn = numbers.from(offset);
            for (pair, xi) in xi.chunks_exact_mut(2).enumerate() {
                xi.copy_from_slice(&drawn.xi::<f32>(pair).words().map(unit));
            }
            each(first + offset as u32, &xi[..dimension], drawn.weight::<f32>().map_or(1.0, f64::from))?;
        }
    }
    Ok(())
}

/// (w + 1/2)/2³², exact in binary64.
fn unit(word: u32) -> f64 {
    (f64::from(word) + 0.5) / 4_294_967_296.0
}
