//! The words of a sampler.

use twoforms_estimator::numbers::{BATCH, Numbers};
use twoforms_estimator::sampler::{Sampler, Stream};
use twoforms_estimator::xi::{Draws, Key};
use twoforms_geometry::lanes::Instructions;

/// 2³².
pub const WORDS: f64 = 4_294_967_296.0;

/// The stream of a replicate.
pub fn stream(sampler: Sampler, n: u32, seed: u64, replicate: u32) -> Stream {
    Stream { sampler, draws: Draws { key: Key::new([seed]), stream: [n, replicate] }, n }
}

/// The words of all samples of a stream, each with so many pairs.
pub fn words(stream: &Stream, pairs: usize) -> Vec<Vec<[u32; 2]>> {
    words_by(Instructions::best(), stream, pairs)
}

/// The same by other instructions.
pub fn words_by(instructions: Instructions, stream: &Stream, pairs: usize) -> Vec<Vec<[u32; 2]>> {
    let (mut numbers, mut all) = (Numbers::new(pairs), Vec::new());
    for first in (0..stream.n).step_by(BATCH) {
        let length = BATCH.min((stream.n - first) as usize);
        stream.fill(instructions, first, length, &mut numbers);
        all.extend((0..length).map(|k| numbers.words(k)));
    }
    all
}

/// The points of one of the pairs.
pub fn points(stream: &Stream, pair: usize) -> Vec<[u32; 2]> {
    words(stream, pair + 1).into_iter().map(|words| words[pair]).collect()
}

/// A word as a number in (0, 1).
pub fn unit(word: u32) -> f64 {
    (f64::from(word) + 0.5) / WORDS
}

/// The samplers whose words are random.
pub fn random() -> impl Iterator<Item = Sampler> {
    Sampler::ALL.iter().copied().filter(|sampler| sampler.is_random())
}

/// Which of so many equal strata a word lies in.
pub fn stratum(word: u32, count: u32) -> u32 {
    ((u64::from(word) * u64::from(count)) >> 32) as u32
}

/// Whether the cells are those from zero to the last, each once.
pub fn each_once(cells: impl Iterator<Item = u32>, count: u32) -> bool {
    let mut cells: Vec<u32> = cells.collect();
    cells.sort_unstable();
    cells.into_iter().eq(0..count)
}
