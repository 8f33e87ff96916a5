//! The exact interval where samples take two values.

use twoforms_comparison::statistics::{TwoValued, variance_interval};

use crate::Coverage;
use crate::random::Stream;

const SEED: u64 = 2;
const TRIALS: u32 = 2000;
const REPLICATES: usize = 100;

/// At least 95 % for every p and N, seed 2, 2000 trials, one-sided level 0.001 for each line printed. Refused only
/// without hits.
#[test]
fn clopper_pearson_covers_the_variance() {
    for (p, n) in [(0.5, 1), (0.47, 1), (0.3, 16), (0.99, 1), (0.03, 1), (0.003, 16), (0.000_1, 1024), (0.003, 1024)] {
        let mut stream = Stream::new(SEED, n);
        let samples = n * REPLICATES as u64;
        let mut coverage = Coverage::default();
        for _ in 0..TRIALS {
            let counts = TwoValued { value: 2.0, hits: stream.hits(samples, p), samples };
            coverage.count(variance_interval(&[0.0; REPLICATES], Some(counts)).ok(), 4.0 * p * (1.0 - p) / n as f64);
        }
        println!("two values, p = {p:6}, N = {n:4}, R = {REPLICATES}  {}", coverage.report());
        assert!(coverage.share() >= 0.95 - coverage.slack(0.95), "p = {p}, N = {n}: {}", coverage.share());
    }
}
