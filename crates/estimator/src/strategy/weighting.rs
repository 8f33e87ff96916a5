//! How samples of several techniques are weighted (Veach 1997, chapter 9; optimal: Kondapaneni et al. 2019).

use std::fmt;

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
    /// The same with α from so many samples of the team beforehand.
    Pilot(u32),
}

/// What the name of pilot samples begins with.
const PILOT: &str = "optimal-pilot/";
/// Most pilot samples.
const MOST_PILOTS: u32 = 65_536;

/// Densities below this share of the largest are cut off.
const CUT: f32 = 0.1;

impl Weighting {
    /// All of them; pilot samples by one of their many numbers.
    pub const ALL: [Self; 6] =
        [Self::Balance, Self::Power, Self::Cutoff, Self::Maximum, Self::Optimal, Self::Pilot(64)];

    /// The heuristic of a name: the word after `mis/`.
    ///
    /// # Errors
    /// Why there is none, where the name is of pilot samples; else nothing.
    pub(super) fn of_name(name: &str) -> Result<Self, Option<String>> {
        if let Some(samples) = name.strip_prefix(PILOT) {
            let samples = samples.parse().ok().filter(|samples| (1..=MOST_PILOTS).contains(samples));
            let wanted = || Some(format!("{PILOT}K needs a number K of pilot samples from 1 to {MOST_PILOTS}"));
            return samples.map(Self::Pilot).ok_or_else(wanted);
        }
        Self::ALL.into_iter().find(|known| known.to_string() == name).ok_or(None)
    }

    /// w_i / q_i, where q_i > 0. Optimal weights are the balance heuristic's but for what α adds.
    #[inline(always)]
    pub(crate) fn over<R: Real>(self, q: &[R], i: usize) -> R {
        match self {
            Self::Balance | Self::Optimal | Self::Pilot(_) => R::one() / sum_from(q, R::zero()),
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

/// Its name: the word after `mis/`.
impl fmt::Display for Weighting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Balance => f.write_str("balance"),
            Self::Power => f.write_str("power"),
            Self::Cutoff => f.write_str("cutoff"),
            Self::Maximum => f.write_str("maximum"),
            Self::Optimal => f.write_str("optimal"),
            Self::Pilot(samples) => write!(f, "{PILOT}{samples}"),
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
