//! The random numbers of samples that are evaluated together.

use twoforms_geometry::real::Real;

use crate::sampler::ROW;
use crate::xi::Xi;

/// Samples evaluated together.
pub const BATCH: usize = 512;

/// Places for their numbers: some more, since as many are written at once as lie side by side.
pub(crate) const ROOM: usize = BATCH + ROW;

/// ξ of a batch of samples: two words a sample for each pair of numbers that it takes.
#[derive(Clone, Debug)]
pub struct Numbers {
    pub(crate) pairs: Vec<Words>,
    /// What samples count, where they do not count alike.
    pub(crate) weights: Option<Box<[f32; ROOM]>>,
}

/// The two words of each sample, on lines of the cache.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(crate) struct Words(pub(crate) [[u32; ROOM]; 2]);

/// ξ of samples that lie side by side in a batch.
#[derive(Clone, Copy, Debug)]
pub struct Drawn<'n> {
    numbers: &'n Numbers,
    offset: usize,
}

impl Numbers {
    /// Room for samples that take so many pairs.
    pub fn new(pairs: usize) -> Self {
        let mut numbers = Self { pairs: Vec::new(), weights: None };
        numbers.fit(pairs);
        numbers
    }

    /// Makes room for samples that take so many pairs.
    pub(crate) fn fit(&mut self, pairs: usize) {
        self.pairs.resize(pairs, Words([[0; ROOM]; 2]));
    }

    /// ξ of the samples from `offset` on.
    #[inline(always)]
    pub fn from(&self, offset: usize) -> Drawn<'_> {
        Drawn { numbers: self, offset }
    }

    /// The words of one sample.
    pub fn words(&self, offset: usize) -> Vec<[u32; 2]> {
        self.pairs.iter().map(|Words([u, v])| [u[offset], v[offset]]).collect()
    }
}

impl Drawn<'_> {
    /// One of the pairs.
    #[inline(always)]
    pub fn xi<R: Real>(&self, pair: usize) -> Xi<R> {
        Xi::load(&self.numbers.pairs[pair].0, self.offset)
    }

    /// How much each sample counts, 1 in the mean; nothing where all count alike.
    #[inline(always)]
    pub fn weight<R: Real>(&self) -> Option<R> {
        self.numbers.weights.as_ref().map(
            #[inline(always)]
            |weights| R::load(&weights[self.offset..]),
        )
    }
}
