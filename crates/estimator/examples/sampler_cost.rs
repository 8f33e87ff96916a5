//! What the random numbers of one sample cost, by sampler: nanoseconds of CPU time a sample, in lanes.
//!
//! `cargo run --release -p twoforms-estimator --example sampler_cost` prints a line for each sampler: N = 1024 with one pair of
//! numbers a sample, and with four; the median of rounds in which the samplers take turns.

use std::hint::black_box;

use cpu_time::ThreadTime;
use twoforms_estimator::numbers::{BATCH, Numbers};
use twoforms_estimator::sampler::{Sampler, Stream};
use twoforms_estimator::xi::{Draws, Key};
use twoforms_geometry::lanes::Instructions;

const N: u32 = 1024;
const REPLICATES: u32 = 200;
const ROUNDS: usize = 15;

fn main() {
    let mut costs = vec![[Vec::new(), Vec::new()]; Sampler::ALL.len()];
    for _ in 0..ROUNDS {
        for (costs, &sampler) in costs.iter_mut().zip(Sampler::ALL) {
            for (costs, pairs) in costs.iter_mut().zip([1, 4]) {
                costs.push(cost(sampler, pairs));
            }
        }
    }
    println!("{:>18} {:>12} {:>12}", "ns a sample", "1 pair", "4 pairs");
    for (costs, sampler) in costs.into_iter().zip(Sampler::ALL) {
        let [one, four] = costs.map(median);
        println!("{:>18} {one:12.2} {four:12.2}", sampler.name());
    }
}

/// Nanoseconds a sample.
fn cost(sampler: Sampler, pairs: usize) -> f64 {
    let (instructions, mut numbers, start) = (Instructions::best(), Numbers::new(pairs), ThreadTime::now());
    for replicate in 0..REPLICATES {
        let draws = Draws { key: Key::new([1]), stream: [N, replicate] };
        let stream = Stream { sampler, draws, n: N };
        for first in (0..N).step_by(BATCH) {
            stream.fill(instructions, first, BATCH, &mut numbers);
            black_box(&numbers);
        }
    }
    start.elapsed().as_secs_f64() * 1e9 / f64::from(N * REPLICATES)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values[values.len() / 2]
}
