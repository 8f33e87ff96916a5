//! The slope of log variance against log N, and the ratio of two variances.

use twoforms_comparison::statistics::{LogVariance, fit_rate, variance_ratio};

use crate::Coverage;
use crate::random::{Distribution, Stream, Worth, exponential, hits, normal};

const SEED: u64 = 3;
const TRIALS: u32 = 300;
const SAMPLES: [u32; 6] = [1, 4, 16, 64, 256, 1024];

/// The slope's interval over `TRIALS` repetitions of a run with `replicates` R at each N, and how often the regime
/// was named.
fn slopes(replicates: usize, slope: f64, name: &str, of: impl Fn(u32) -> Distribution) {
    let mut stream = Stream::new(SEED, replicates as u64);
    let (mut coverage, mut named) = (Coverage::default(), 0);
    let rows: Vec<(u32, Distribution)> = SAMPLES.map(|n| (n, of(n))).into();
    for _ in 0..TRIALS {
        let measured = |(n, of): &(u32, Distribution)| {
            let estimates = of.replicates(replicates, &mut stream);
            LogVariance::from_replicates(&estimates).ok().map(|measured| (u64::from(*n), measured))
        };
        let points: Vec<_> = rows.iter().filter_map(measured).collect();
        let fit = fit_rate(&points).ok();
        coverage.count(fit.map(|fit| fit.interval), slope);
        named += u32::from(fit.is_some_and(|fit| fit.regime.is_ok()));
    }
    let named = 100 * named / TRIALS;
    println!("{name:30} slope {slope:4.1}  R {replicates:4}  {}  named {named} %", coverage.report());
    assert!(coverage.share() >= 0.93 - coverage.slack(0.93), "{name}, R = {replicates}: {}", coverage.share());
    assert!(coverage.given == coverage.trials && named > 85, "{name}, R = {replicates}: {named} % named");
}

/// Normal estimates whose variance falls as N to the power of `slope`.
fn power_law(n: u32, slope: f64) -> Distribution {
    normal().scaled(libm::pow(f64::from(n), slope / 2.0))
}

/// At least 93 % (95 % nominal), seed 3, 300 trials, one-sided level 0.001 for each line printed.
#[test]
fn the_slopes_interval_holds_the_slope() {
    for replicates in [100, 1000] {
        for slope in [-1.0, -1.5, -2.0, -3.0] {
            slopes(replicates, slope, "normal", |n| power_law(n, slope));
        }
        slopes(replicates, -1.0, "exponential", exponential);
    }
    slopes(1000, -1.0, "hits worth Uniform, p = 0.003", |n| hits(Worth::Uniform, 0.003, n.into()));
    slopes(1000, -1.0, "hits worth Exponential, p = 0.02", |n| hits(Worth::Exponential, 0.02, n.into()));
}

/// At least 93 % (95 % nominal) where tails are unlike, seed 3, 2000 trials, one-sided level 0.001 for each line
/// printed.
#[test]
fn the_ratios_interval_holds_the_ratio() {
    for (a, b) in [(normal(), exponential(1)), (hits(Worth::Uniform, 0.3, 1), exponential(16))] {
        for replicates in [300, 1000] {
            let mut stream = Stream::new(SEED, 11);
            let mut coverage = Coverage::default();
            for _ in 0..2000 {
                let mut of = |which: &Distribution| {
                    LogVariance::from_replicates(&which.replicates(replicates, &mut stream)).ok()
                };
                let interval = of(&a).zip(of(&b)).map(|(a, b)| variance_ratio(&a, &b).interval);
                coverage.count(interval, a.variance / b.variance);
            }
            println!("{} / {}, R = {replicates}  {}", a.name, b.name, coverage.report());
            assert!(coverage.share() >= 0.93 - coverage.slack(0.93), "{} / {}: {}", a.name, b.name, coverage.share());
        }
    }
}
