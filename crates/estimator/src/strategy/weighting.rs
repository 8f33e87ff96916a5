//! How samples of several techniques are weighted (Veach 1997, chapter 9; optimal: Kondapaneni et al. 2019).

use twoforms_geometry::real::{Mask, Real};

/// A heuristic: the weights w_i of a sample from q_k = n_k p_k, which add up to one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Weighting {
    /// w_i = q_i / Σ q_k.
    Balance,
    /// w_i = q_i² / Σ q_k².
    Power,
    /// w_i = q_i / Σ q_k over the techniques with q_k >= max q / 10; zero for the others.
    Cutoff,
    /// w_i = 1 where q_i is the largest; of equals the first.
    Maximum,
    /// The weights of least variance, with the known α.
    Optimal,
}

/// Densities below this share of the largest are cut off.
const CUT: f32 = 0.1;

impl Weighting {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Balance, Self::Power, Self::Cutoff, Self::Maximum, Self::Optimal];

    /// Its name: the word after `mis/`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Balance => "balance",
            Self::Power => "power",
            Self::Cutoff => "cutoff",
            Self::Maximum => "maximum",
            Self::Optimal => "optimal",
        }
    }

    /// w_i / q_i, where q_i > 0. Optimal weights are the balance heuristic's but for what α adds.
    #[inline(always)]
    pub(crate) fn over<R: Real>(self, q: &[R], i: usize) -> R {
        match self {
            Self::Balance | Self::Optimal => R::one() / sum_from(q, R::zero()),
            Self::Power => {
                let mut squares = R::zero();
                for &q_k in q {
                    let ratio = q_k / q[i];
                    squares = squares + ratio * ratio;
                }
                R::one() / (q[i] * squares)
            }
            Self::Cutoff => {
                let bound = largest(q) * R::splat(CUT);
                R::select(bound.le(q[i]), R::one() / sum_from(q, bound), R::zero())
            }
            Self::Maximum => {
                let mut first = R::Mask::splat(true);
                for k in 0..q.len() {
                    first = first & if k < i { q[k].lt(q[i]) } else { q[k].le(q[i]) };
                }
                R::select(first, R::one() / q[i], R::zero())
            }
        }
    }
}

/// Σ q_k over those that reach a bound.
#[inline(always)]
fn sum_from<R: Real>(q: &[R], bound: R) -> R {
    let mut sum = R::zero();
    for &q in q {
        sum = sum + R::select(bound.le(q), q, R::zero());
    }
    sum
}

#[inline(always)]
fn largest<R: Real>(q: &[R]) -> R {
    let mut largest = R::zero();
    for &q in q {
        largest = R::select(largest.lt(q), q, largest);
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::Weighting;

    #[test]
    fn weights_of_a_sample_add_up_to_one() {
        for q in [[1.0, 2.0, 0.0], [1e-20, 3.0, 3.0], [5.0, 0.4, 0.6], [1e25, 1e25, 1e-25]] {
            for weighting in Weighting::ALL {
                let present = (0..3).filter(|&i| q[i] > 0.0);
                let sum: f32 = present.map(|i| weighting.over(&q, i) * q[i]).sum();
                assert!((sum - 1.0).abs() < 1e-6, "{weighting:?} {q:?}: {sum}");
            }
        }
    }
}
