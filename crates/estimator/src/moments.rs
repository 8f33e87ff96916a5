//! Moments of samples.

use std::ops::Add;

use twoforms_geometry::wide::{EIGHT, Eight, Wide};

/// Number, mean, and sums of powers of deviations from the mean (second to fourth), in binary64.
///
/// Central sums, since raw sums of squares lose a variance that is small against the squared mean. Merging depends on
/// the order in the last bits, so callers merge in a fixed order.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// n.
    pub n: f64,
    /// Σw/n.
    pub mean: f64,
    /// Σ(w − mean)².
    pub m2: f64,
    /// Σ(w − mean)³.
    pub m3: f64,
    /// Σ(w − mean)⁴.
    pub m4: f64,
}

impl Moments {
    /// The moments of these values, in two passes.
    pub fn of(values: &[f64]) -> Self {
        Self::by::<Eight>(values)
    }

    /// The same moments by other instructions.
    #[inline(always)]
    pub fn by<W: Wide>(values: &[f64]) -> Self {
        if values.is_empty() {
            return Self::default();
        }
        if values.len() < EIGHT {
            return Self::few(values);
        }
        let (whole, rest) = values.split_at(values.len() - values.len() % EIGHT);
        let n = values.len() as f64;
        let mut total = W::splat(0.0);
        for k in (0..whole.len()).step_by(EIGHT) {
            total = total + W::load(&whole[k..]);
        }
        if !rest.is_empty() {
            total = total + padded(rest);
        }
        let mean = total.sum() / n;
        let (mut m2, mut m3, mut m4) = (W::splat(0.0), W::splat(0.0), W::splat(0.0));
        for k in (0..whole.len()).step_by(EIGHT) {
            let d = W::load(&whole[k..]) - W::splat(mean);
            let d2 = d * d;
            m2 = m2 + d2;
            m3 = m3 + d2 * d;
            m4 = m4 + d2 * d2;
        }
        let mut moments = Self { n, mean, m2: m2.sum(), m3: m3.sum(), m4: m4.sum() };
        moments.deviate(rest);
        moments
    }

    /// The same moments of fewer than eight values.
    #[inline(always)]
    fn few(values: &[f64]) -> Self {
        let n = values.len() as f64;
        let mean = values.iter().fold(0.0, |sum, value| sum + value) / n;
        let mut moments = Self { n, mean, ..Self::default() };
        moments.deviate(values);
        moments
    }

    /// Adds the deviations of some of the values from the mean.
    #[inline(always)]
    fn deviate(&mut self, values: &[f64]) {
        for d in values.iter().map(|value| value - self.mean) {
            let d2 = d * d;
            self.m2 += d2;
            self.m3 += d2 * d;
            self.m4 += d2 * d2;
        }
    }

    /// Σ(w − mean)²/(n − 1): the sample variance; `None` for fewer than two values.
    pub fn variance(&self) -> Option<f64> {
        (self.n >= 2.0).then(|| self.m2 / (self.n - 1.0))
    }
}

/// Fewer than eight values, and zeros to make up eight.
#[inline(always)]
fn padded<W: Wide>(values: &[f64]) -> W {
    let mut all = [0.0; EIGHT];
    all[..values.len()].copy_from_slice(values);
    W::load(&all)
}

/// The moments of two sets together (Pébay 2008, "Formulas for robust, one-pass parallel computation of covariances and
/// arbitrary-order statistical moments", SAND2008-6212, equations 2.1 and 3.1).
impl Add for Moments {
    type Output = Self;

    fn add(self, b: Self) -> Self {
        let a = self;
        if a.n == 0.0 || b.n == 0.0 {
            return if a.n == 0.0 { b } else { a };
        }
        let n = a.n + b.n;
        let d = b.mean - a.mean;
        let (p, q) = (a.n / n, b.n / n);
        let d2 = d * d;
        Self {
            n,
            mean: a.mean + d * q,
            m2: a.m2 + b.m2 + d2 * a.n * q,
            m3: a.m3 + b.m3 + d2 * d * a.n * q * (p - q) + 3.0 * d * (p * b.m2 - q * a.m2),
            m4: a.m4
                + b.m4
                + d2 * d2 * a.n * q * (p * p - p * q + q * q)
                + 6.0 * d2 * (p * p * b.m2 + q * q * a.m2)
                + 4.0 * d * (p * b.m3 - q * a.m3),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Moments;

    #[test]
    fn merging_parts_gives_the_moments_of_the_whole() {
        let values: Vec<f64> = (0..97).map(|k| f64::from(k * k % 31) + 1e3).collect();
        let whole = Moments::of(&values);
        for size in [1, 2, 16, 64] {
            let merged = values.chunks(size).map(Moments::of).fold(Moments::default(), |sum, part| sum + part);
            for (a, b) in
                [(merged.mean, whole.mean), (merged.m2, whole.m2), (merged.m3, whole.m3), (merged.m4, whole.m4)]
            {
                assert!((a - b).abs() <= 1e-9 * b.abs(), "parts of {size}: {a} against {b}");
            }
        }
    }

    #[test]
    fn a_small_variance_beside_a_large_mean_survives() {
        let values: Vec<f64> = (0..1000).map(|k| 1.0 + 1e-9 * f64::from(k % 2)).collect();
        let variance = Moments::of(&values).variance();
        assert!(variance.is_some_and(|v| (v - 0.25e-18 * 1000.0 / 999.0).abs() < 1e-24), "{variance:?}");
    }
}
