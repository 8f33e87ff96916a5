//! α: how much of each technique's density an optimal weighting takes off the integrand (Kondapaneni et al. 2019, "Optimal
//! multiple importance sampling", equation 12).

use std::array::from_fn;

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Mask;
use twoforms_geometry::view::View;

use super::mis::Mis;
use crate::rgb::Rgb;
use crate::sampler::{Sampler, Stream};
use crate::strategy::MOST;
use crate::xi::{Draws, Key};

/// A technique whose density is so near to a sum of the others', as a share of its own norm squared, has α = 0.
const ALIKE: f64 = 1e-9;

/// α with A α = b, A_ij = ∫ p_i p_j/Σ n_k p_k symmetric and with no negative eigenvalue, b_i = ∫ f p_i/Σ n_k p_k, by elimination about
/// the largest pivot left. A technique that adds nothing to the others has α = 0.
pub fn alpha(mut a: [[f64; MOST]; MOST], mut b: [f64; MOST]) -> [f64; MOST] {
    let norms: [f64; MOST] = from_fn(|k| a[k][k]);
    let left = |a: &[[f64; MOST]; MOST], k: usize| if norms[k] > 0.0 { a[k][k] / norms[k] } else { 0.0 };
    let mut order = Vec::new();
    loop {
        let rest = (0..MOST).filter(|k| !order.contains(k));
        let pivot = rest.max_by(|&i, &j| left(&a, i).total_cmp(&left(&a, j))).filter(|&k| left(&a, k) > ALIKE);
        let Some(pivot) = pivot else { break };
        order.push(pivot);
        for i in (0..MOST).filter(|i| !order.contains(i)) {
            let factor = a[i][pivot] / a[pivot][pivot];
            a[i] = from_fn(|j| a[i][j] - factor * a[pivot][j]);
            b[i] -= factor * b[pivot];
        }
    }
    let mut alpha = [0.0; MOST];
    for &k in order.iter().rev() {
        let known: f64 = (0..MOST).filter(|&j| j != k).map(|j| a[k][j] * alpha[j]).sum();
        alpha[k] = (b[k] - known) / a[k][k];
    }
    alpha
}

/// Sums over pilot samples that come to A and b, RGB, but for a common factor.
#[derive(Default)]
struct Sums {
    a: [[f64; MOST]; MOST],
    b: [[f64; MOST]; 3],
}

impl Sums {
    /// Adds a sample that met light: Σ_i n_i E\[p_k p_l/c²\] = ∫ p_k p_l/c, with c = Σ n_k p_k.
    fn meet(&mut self, p: [f64; MOST], c: f64, f: [f64; 3]) {
        let share = p.map(|p| p / c);
        self.a = from_fn(|k| from_fn(|l| self.a[k][l] + share[k] * share[l]));
        self.b = from_fn(|channel| from_fn(|k| self.b[channel][k] + f[channel] / c * share[k]));
    }

    /// Adds a sample of technique i that met none, where only its density is not zero.
    fn miss(&mut self, i: usize, n: f64) {
        self.a[i][i] += 1.0 / (n * n);
    }
}

impl Mis<'_> {
    /// The same with α of each technique, RGB, from so many samples of the team, drawn by this key.
    pub(crate) fn pilot(self, view: &View, samples: u32, key: Key) -> Self {
        let (from, mut sums, mut rays) = (view.from_x::<f32>(), Sums::default(), 0);
        let stream =
            Stream { sampler: Sampler::Independent, draws: Draws { key, stream: [samples, PILOT] }, n: samples };
        for index in 0..samples {
            let numbers = stream.xi(index, self.pairs);
            let mut pair = 0;
            for (i, (technique, n)) in self.team.iter().enumerate() {
                for _ in 0..*n {
                    let found = technique.find(&from, numbers.from(0).xi(pair));
                    pair += 1;
                    rays += u64::from(found.asked.count());
                    if !found.seen.any() {
                        sums.miss(i, f64::from(*n));
                        continue;
                    }
                    let (q, Rgb(f)) = (
                        self.expected(&from, i, &found),
                        self.query.received(&from, Masked::new(found.y, found.seen), &found.xy),
                    );
                    let p = from_fn(|k| self.team.get(k).map_or(0.0, |(_, n)| f64::from(q[k]) / f64::from(*n)));
                    sums.meet(p, q.iter().map(|&q| f64::from(q)).sum(), f.map(f64::from));
                }
            }
        }
        let channels = sums.b.map(|b| alpha(sums.a, b));
        let alpha = (0..self.team.len()).map(|k| channels.map(|alpha| alpha[k] as f32)).collect();
        Self { alpha, setup_rays: rays, ..self }
    }
}

/// The stream of pilot samples: no replicate has this number.
const PILOT: u32 = u32::MAX;

#[cfg(test)]
mod tests {
    use super::alpha;

    #[test]
    fn equations_are_solved_and_techniques_that_are_alike_counted_once() {
        let near = |found: [f64; 3], known: [f64; 3]| (0..3).all(|k| (found[k] - known[k]).abs() < 1e-12);
        assert!(near(alpha([[4.0, 1.0, 0.5], [1.0, 3.0, 0.25], [0.5, 0.25, 2.0]], [7.5, 7.75, 7.0]), [1.0, 2.0, 3.0]));
        assert!(near(alpha([[2.0, 1.0, 0.0], [1.0, 3.0, 0.0], [0.0; 3]], [4.0, 7.0, 0.0]), [1.0, 2.0, 0.0]));
        let alike = alpha([[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0; 3]], [2.0, 2.0, 0.0]);
        assert!((alike[0] + alike[1] - 2.0).abs() < 1e-12 && alike[0] * alike[1] == 0.0, "{alike:?}");
        assert_eq!(alpha([[0.0; 3]; 3], [0.0; 3]), [0.0; 3]);
    }
}
