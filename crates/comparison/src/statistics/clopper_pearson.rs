//! The exact interval of a probability.

/// Interval of the probability p after `hits` k of `samples` n independent trials (Clopper and Pearson 1934), which leaves
/// out the true p with probability `level` at most: 0.05 for a 95 % interval.
///
/// The lower end solves Pr(X ≥ k; n, p) = level/2, the upper one Pr(X ≤ k; n, p) = level/2; 0 at k = 0 and 1 at k = n.
/// Needs k ≤ n.
pub fn clopper_pearson(hits: u64, samples: u64, level: f64) -> [f64; 2] {
    [lower_end(hits, samples, level), 1.0 - lower_end(samples - hits, samples, level)]
}

/// Two-sided probability of a count as far out as k under p: twice the smaller tail, at most 1. It is below a level
/// exactly where [`clopper_pearson`] at that level leaves p out.
pub fn binomial_p_value(hits: u64, samples: u64, p: f64) -> f64 {
    let (k, n) = (hits as f64, samples as f64);
    let at_least = if hits == 0 { 1.0 } else { libm::exp(ln_at_least(k, n, libm::log(p))) };
    let at_most = if hits == samples { 1.0 } else { libm::exp(ln_at_least(n - k, n, libm::log1p(-p))) };
    (2.0 * at_least.min(at_most)).min(1.0)
}

/// The p with Pr(X ≥ k; n, p) = level/2, by Newton's method for ln Pr as a function of ln p.
///
/// That function rises and is concave, because the logarithm of a beta variate with b = n − k + 1 ≥ 1 has a log-concave
/// density; so from the second step on Newton's method climbs to the root and cannot pass it.
fn lower_end(hits: u64, samples: u64, level: f64) -> f64 {
    if hits == 0 {
        return 0.0;
    }
    let (k, n) = (hits as f64, samples as f64);
    let ln_tail = libm::log(0.5 * level);
    let mut ln_p = libm::log(k / (n + 1.0));
    for _ in 0..MAX_STEPS {
        let step = (ln_tail - ln_at_least(k, n, ln_p)) * tail_over_first(k, n, libm::exp(ln_p)) / k;
        ln_p += step;
        if step.abs() < 1e-14 {
            break;
        }
    }
    libm::exp(ln_p)
}

/// ln Pr(X ≥ k; n, p), k > 0.
fn ln_at_least(k: f64, n: f64, ln_p: f64) -> f64 {
    let ln_choose = libm::lgamma(n + 1.0) - libm::lgamma(k + 1.0) - libm::lgamma(n - k + 1.0);
    let p = libm::exp(ln_p);
    ln_choose + k * ln_p + (n - k) * libm::log1p(-p) + libm::log(tail_over_first(k, n, p))
}

/// Newton's steps double the digits; six or seven are usual.
const MAX_STEPS: usize = 60;

/// Pr(X ≥ k) / Pr(X = k): the sum of the terms' ratios (n − j) p / ((j + 1) (1 − p)), j = k, k + 1, …
/// Its logarithmic derivative is simple: d ln Pr(X ≥ k) / d ln p = k / sum.
fn tail_over_first(k: f64, n: f64, p: f64) -> f64 {
    let odds = p / (1.0 - p);
    let (mut sum, mut term, mut j) = (1.0, 1.0, k);
    while j < n && term > 1e-17 * sum {
        term *= (n - j) / (j + 1.0) * odds;
        sum += term;
        j += 1.0;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    const TAIL: f64 = 0.025;

    fn close(found: [f64; 2], expected: [f64; 2], tolerance: f64) {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() <= tolerance * expected, "{found} {expected}");
        }
    }

    #[test]
    fn ends_have_closed_forms() {
        for n in [1_u64, 30, 1000, 1_024_000] {
            let rest = libm::pow(TAIL, 1.0 / n as f64);
            close(clopper_pearson(n, n, 0.05), [rest, 1.0], 1e-12);
            close(clopper_pearson(0, n, 0.05), [0.0, 1.0 - rest], 1e-8);
        }
    }

    /// The two ends against the binomial sums that define them, with the terms summed one by one.
    #[test]
    fn tails_hold_the_level() {
        for (k, n) in [(1_u32, 10_u32), (5, 10), (37, 100), (999, 1000), (500, 1000)] {
            let [lo, hi] = clopper_pearson(k.into(), n.into(), 0.05);
            let at_least: f64 = (k..=n).map(|j| probability(j, n, lo)).sum();
            let at_most: f64 = (0..=k).map(|j| probability(j, n, hi)).sum();
            assert!((at_least / TAIL - 1.0).abs() < 1e-9, "{k} {n}: {at_least}");
            assert!((at_most / TAIL - 1.0).abs() < 1e-9, "{k} {n}: {at_most}");
        }
    }

    fn probability(j: u32, n: u32, p: f64) -> f64 {
        let ratio = (0..j).map(|i| f64::from(n - i) / f64::from(i + 1) * p).map(libm::log).sum::<f64>();
        libm::exp(ratio + f64::from(n - j) * libm::log1p(-p))
    }

    /// Far from the ends the interval tends to k/n ± z √(p(1−p)/n), also for millions of samples.
    #[test]
    fn millions_of_samples() {
        for (k, n) in [(409_600_u64, 1_024_000_u64), (2_000_000, 4_096_000), (1000, 4_000_000)] {
            let p = k as f64 / n as f64;
            let half = crate::statistics::Z_95 * (p * (1.0 - p) / n as f64).sqrt();
            let [lo, hi] = clopper_pearson(k, n, 0.05);
            assert!(((hi - lo) / (2.0 * half) - 1.0).abs() < 0.01, "{k} {n}");
            assert!(lo < p && p < hi);
        }
    }

    /// Coverage of the variance's interval, without chance: at least 95 % for every p on a grid (n = 60).
    #[test]
    fn coverage_is_at_least_95_percent() {
        let n = 60_u32;
        let ends: Vec<[f64; 2]> = (0..=n).map(|k| clopper_pearson(k.into(), n.into(), 0.05)).collect();
        for p in (1..200).map(|i| f64::from(i) / 200.0) {
            let kept = |k: &u32| ends[*k as usize][0] <= p && p <= ends[*k as usize][1];
            let coverage: f64 = (0..=n).filter(kept).map(|k| probability(k, n, p)).sum();
            assert!(coverage >= 0.95, "{p}: {coverage}");
        }
    }
}
