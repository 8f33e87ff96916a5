//! The least variance of an unbiased weighting (Kondapaneni et al. 2019, "Optimal multiple importance sampling").
//!
//! With c = Σ n_k p_k, A_ij = ∫ p_i p_j/c, b_i = ∫ F p_i/c and A α = b, V = ∫ F²/c − αᵀb. That difference cancels; it equals
//! V = ∫ (F − Σ α_k p_k)²/c over everything that is sampled, where no term is negative. Where a technique's sample meets
//! nothing, it alone counts: its probability there over n_i is a part of A_ii, and α_i² times that of V.

use std::array::from_fn;

use twoforms_estimator::combination::alpha;

use crate::cubature::integrate;
use crate::error::Error;
use crate::law::Outcome;
use crate::mis::{Members, visible};
use crate::outline::line_integral;
use crate::sight::Sight;
use crate::value::EPSILON;

/// Relative error that integrals are computed to, where coordinates are known that well.
const FINE: f64 = 1e-10;

/// A team at one x: A, and b in red, green, blue and luminance.
pub struct Optimal<'s> {
    sight: &'s Sight,
    members: Members,
    matrix: [[f64; 3]; 3],
    b: [[f64; 3]; 4],
}

impl<'s> Optimal<'s> {
    /// Integrates products of densities over what x sees.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn new(sight: &'s Sight, members: Members) -> Result<Self, Error> {
        let mut matrix = [[0.0; 3]; 3];
        for k in 0..members.count() {
            matrix[k][k] = members.missed(k).0 / members.samples(k);
        }
        let mut b = [[0.0; 3]; 4];
        for (index, seen) in visible(sight) {
            let relative = FINE.max(0.1 * seen.slack());
            let products = |y| {
                let p = members.densities(index, seen, y);
                let per_c = 1.0 / members.expected(p).iter().sum::<f64>();
                let (g, radiance) = (seen.g(y), seen.radiance_at(y));
                let of = |k: usize| if k < 9 { p[k / 3] } else { radiance[k / 3 - 3] * g };
                from_fn::<f64, 21, _>(|k| per_c * p[k % 3] * of(k))
            };
            let sum = integrate(&members.cut(index, seen), products, |total| total.map(|value| relative * value))?;
            for (row, parts) in matrix.iter_mut().chain(&mut b).zip(sum.value.chunks_exact(3)) {
                row.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
            }
        }
        Ok(Self { sight, members, matrix, b })
    }

    /// α of each technique in one channel, and ∫ F = Σ n_k b_k.
    fn solved(&self, channel: usize) -> ([f64; 3], f64) {
        let b = self.b[channel];
        let mean = (0..self.members.count()).map(|k| self.members.samples(k) * b[k]).sum();
        (alpha(self.matrix, b), mean)
    }

    /// α of each technique in red, green, blue and luminance.
    pub fn alpha(&self) -> [[f64; 3]; 4] {
        from_fn(|channel| self.solved(channel).0)
    }

    /// Variance of the team's sum and its mean, in red, green, blue and luminance.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn outcomes(&self) -> Result<[Outcome; 4], Error> {
        let solved: [_; 4] = from_fn(|channel| self.solved(channel));
        let mut outcomes = solved.map(|(alpha, mean)| self.of_missed(alpha, mean));
        for (index, seen) in visible(self.sight) {
            let slack = seen.slack();
            let relative = FINE.max(0.1 * slack);
            let residuals = |y| {
                let p = self.members.densities(index, seen, y);
                let c: f64 = self.members.expected(p).iter().sum();
                let (g, radiance) = (seen.g(y), seen.radiance_at(y));
                from_fn::<f64, 4, _>(|channel| {
                    let (alpha, _) = &solved[channel];
                    let rest = radiance[channel] * g - (0..3).map(|k| alpha[k] * p[k]).sum::<f64>();
                    // On the horizon itself nothing arrives, and nothing may be drawn.
                    if c > 0.0 { rest * rest / c } else { 0.0 }
                })
            };
            let allowed = |total: &[f64; 4]| from_fn(|k| relative * total[k] + 1e-18 * solved[k].1 * solved[k].1);
            let pieces = self.members.cut(index, seen);
            let sum = integrate(&pieces, residuals, allowed)?;
            let edges = line_integral(&pieces, residuals);
            for (k, outcome) in outcomes.iter_mut().enumerate() {
                let size = (sum.value[k] * (sum.value[k] + outcome.mean * outcome.mean)).sqrt();
                outcome.variance += sum.value[k];
                outcome.error += sum.error[k] + edges[k] * seen.moments.shift + 4.0 * slack * size;
                outcome.mean_error += 2.0 * slack * outcome.mean;
            }
        }
        for outcome in &mut outcomes {
            outcome.error += 16.0 * EPSILON * (outcome.variance + outcome.mean * outcome.variance.sqrt());
        }
        Ok(outcomes)
    }

    /// What samples that meet nothing add.
    fn of_missed(&self, alpha: [f64; 3], mean: f64) -> Outcome {
        let mut outcome = Outcome { mean, mean_error: 16.0 * EPSILON * mean, ..Outcome::default() };
        for (k, alpha) in alpha.iter().enumerate().take(self.members.count()) {
            let ((missed, error), n) = (self.members.missed(k), self.members.samples(k));
            outcome.variance += alpha * alpha * missed / n;
            outcome.error += alpha * alpha * error / n;
        }
        outcome
    }
}
