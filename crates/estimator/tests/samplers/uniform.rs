//! Every word is uniform over replicates, and pairs know nothing of each other.

use twoforms_estimator::sampler::Sampler;

use super::points::{random, stream, unit, words};

/// Replicates.
const R: u32 = 4000;
/// Pairs that a sample takes.
const PAIRS: usize = 3;
/// Cells of a χ² test.
const CELLS: usize = 16;
/// The quantile of χ² with 15 degrees of freedom that is passed once in 10⁸ (R: qchisq(1e-8, 15, lower.tail = FALSE)). With some
/// 2000 tests in all, level 2·10⁻⁵ together.
const CHI2: f64 = 66.9;

fn chi2(counts: &[u32; CELLS]) -> f64 {
    let expected = f64::from(counts.iter().sum::<u32>()) / CELLS as f64;
    counts.iter().map(|&count| (f64::from(count) - expected).powi(2) / expected).sum()
}

/// Seed 11. The sixteen cells are the leading digits of a word, and those that come next.
#[test]
fn every_word_is_uniform_over_replicates() {
    for sampler in random() {
        for n in [1, 6, 16] {
            let n = sampler.rounded(n);
            let mut counts = vec![[[[0; CELLS]; 2]; 2]; PAIRS * n as usize];
            for replicate in 0..R {
                for (index, pairs) in words(&stream(sampler, n, 11, replicate), PAIRS).into_iter().enumerate() {
                    for (pair, words) in pairs.into_iter().enumerate() {
                        for (axis, word) in words.into_iter().enumerate() {
                            let counts = &mut counts[index * PAIRS + pair][axis];
                            counts[0][(word >> 28) as usize] += 1;
                            counts[1][(word >> 24) as usize % CELLS] += 1;
                        }
                    }
                }
            }
            for (place, counts) in counts.iter().enumerate() {
                for (axis, digits) in counts.iter().enumerate() {
                    for (digit, counts) in digits.iter().enumerate() {
                        let chi2 = chi2(counts);
                        assert!(chi2 < CHI2, "{sampler}, N = {n}, word {place}.{axis}, digit {digit}: χ² {chi2}");
                    }
                }
            }
        }
    }
}

/// The two words of one sample fill the square, and so do words of different pairs. Seed 12.
#[test]
fn words_of_one_sample_are_independent_of_each_other() {
    for sampler in random() {
        let n = sampler.rounded(16);
        let mut counts = [[0; CELLS]; 3];
        for replicate in 0..R {
            let all = words(&stream(sampler, n, 12, replicate), PAIRS);
            let [[a, b], [c, _], [_, d]] = all[replicate as usize % all.len()][..] else { panic!("three pairs") };
            for (counts, [a, b]) in counts.iter_mut().zip([[a, b], [a, c], [b, d]]) {
                counts[((a >> 30) * 4 + (b >> 30)) as usize] += 1;
            }
        }
        for (which, counts) in counts.iter().enumerate() {
            assert!(chi2(counts) < CHI2, "{sampler}, words {which}: χ² {}", chi2(counts));
        }
    }
}

/// How much larger the variance of a mean of products may be than with independent numbers. Where the order of samples is
/// a nested permutation, neighbours in it stay neighbours, and are on opposite sides of every pair's square: half as many
/// products are independent of each other, and the variance of signs is twice as large.
fn allowed(sampler: Sampler) -> f64 {
    if matches!(sampler.name(), "sobol" | "pmj02" | "lattice") { 2.6 } else { 1.3 }
}

/// Mean and variance of values that should have mean zero; fails where it lies six standard errors away, which chance does
/// twice in 10⁹.
fn variance_about_zero(sampler: Sampler, values: &[f64]) -> f64 {
    let r = values.len() as f64;
    let mean = values.iter().sum::<f64>() / r;
    let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (r - 1.0);
    assert!(mean.abs() < 6.0 * (variance / r).sqrt(), "{sampler}: mean {mean}");
    variance
}

/// Mean over the samples of (u − 1/2)·(u' − 1/2), u and u' of different pairs: zero over replicates, with about the
/// variance of independent numbers, 1/(144 N). A pair that followed another would show in either; the variance is known to
/// 3 %. Seed 13.
#[test]
fn pairs_are_not_correlated() {
    for sampler in random() {
        let n = sampler.rounded(64);
        for [one, other] in [[0, 1], [1, 2], [0, 2]] {
            for axis in 0..2 {
                let products: Vec<f64> = (0..R / 4)
                    .map(|replicate| {
                        let all = words(&stream(sampler, n, 13, replicate), PAIRS);
                        let product =
                            |words: &Vec<[u32; 2]>| (unit(words[one][axis]) - 0.5) * (unit(words[other][axis]) - 0.5);
                        all.iter().map(product).sum::<f64>() / f64::from(n)
                    })
                    .collect();
                let ratio = variance_about_zero(sampler, &products) * 144.0 * f64::from(n);
                assert!(ratio < allowed(sampler), "{sampler}, {one} and {other}: variance {ratio} times");
            }
        }
    }
}

/// Streams of different keys know nothing of each other: the camera's and the light's samples of a pixel are spread by
/// the same sampler. Signs of their words; seeds 14 and 15.
#[test]
fn streams_are_not_correlated() {
    for sampler in random() {
        let n = sampler.rounded(64);
        let products: Vec<f64> = (0..R / 4)
            .map(|replicate| {
                let [one, other] = [14, 15].map(|seed| words(&stream(sampler, n, seed, replicate), 1));
                let bit = |word: u32| if word >> 31 == 0 { 1.0 } else { -1.0 };
                one.iter().zip(&other).map(|(a, b)| bit(a[0][0]) * bit(b[0][0])).sum::<f64>() / f64::from(n)
            })
            .collect();
        let ratio = variance_about_zero(sampler, &products) * f64::from(n);
        assert!(ratio < allowed(sampler), "{sampler}: variance {ratio} times");
    }
}
