//! How fast the variance of a mean falls with N. The full measurement stands in the example `rates`.

use twoforms_estimator::sampler::Sampler;

use super::points::{stream, unit, words};

/// Replicates.
const R: u32 = 600;

/// The variance of the mean of f over the square with N samples.
fn variance(sampler: Sampler, n: u32, f: impl Fn(f64, f64) -> f64) -> f64 {
    let estimate = |replicate: u32| {
        let all = words(&stream(sampler, n, 31, replicate), 1);
        all.iter().map(|words| f(unit(words[0][0]), unit(words[0][1]))).sum::<f64>() / f64::from(n)
    };
    let estimates: Vec<f64> = (0..R).map(estimate).collect();
    let mean = estimates.iter().sum::<f64>() / f64::from(R);
    estimates.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / f64::from(R - 1)
}

/// Slope of ln variance against ln N by least squares over N = 16, 64, 256, 1024.
fn slope(sampler: Sampler, f: impl Fn(f64, f64) -> f64 + Copy) -> f64 {
    let points = [2, 3, 4, 5].map(|k| (f64::from(k) * 4.0_f64.ln(), variance(sampler, 1 << (2 * k), f).ln()));
    let [x, y] = [points.iter().map(|p| p.0).sum::<f64>() / 4.0, points.iter().map(|p| p.1).sum::<f64>() / 4.0];
    let [xy, xx] = points.iter().fold([0.0; 2], |[xy, xx], p| [xy + (p.0 - x) * (p.1 - y), xx + (p.0 - x).powi(2)]);
    xy / xx
}

/// e^(u + v/2): smooth.
fn smooth(u: f64, v: f64) -> f64 {
    libm::exp(u + 0.5 * v)
}

/// Inside a disk: a jump along a curve.
fn disk(u: f64, v: f64) -> f64 {
    f64::from(u8::from(u * u + v * v < 0.7))
}

/// ln s² of R normal estimates has the standard error √(2/R) = 0.058, and a slope over four points a factor four apart
/// √5 of 0.058 / (5 ln 4) = 0.019. The ranges leave six of those and what is not yet asymptotic; seed 31.
#[test]
fn slopes_are_those_of_theory() {
    let expected = |name: &str| match name {
        "independent" => ([-1.12, -0.88], [-1.12, -0.88]),
        "jittered" => ([-2.15, -1.85], [-1.65, -1.35]),
        "sobol" | "pmj02" => ([-3.3, -2.5], [-1.75, -1.3]),
        "multi-jittered" => ([-1.75, -1.4], [-1.75, -1.3]),
        "halton" | "lattice" => ([-3.3, -1.7], [-1.9, -1.2]),
        name => panic!("no slope is known for {name}"),
    };
    for sampler in super::points::random() {
        let (of_smooth, of_jump) = expected(sampler.name());
        for (what, slope, [low, high]) in
            [("smooth", slope(sampler, smooth), of_smooth), ("disk", slope(sampler, disk), of_jump)]
        {
            println!("{sampler}, {what}: {slope:.3}");
            assert!((low..=high).contains(&slope), "{sampler}, {what}: {slope}");
        }
    }
}
