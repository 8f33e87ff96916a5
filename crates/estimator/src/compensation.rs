//! What directions by the cosine leave of each light to those who pick one (Karlík, Šik, Vévoda, Skřivan and Křivánek 2019, "MIS
//! compensation: optimizing sampling techniques in multiple importance sampling").
//!
//! With the balance heuristic a team is as good as the sum of its densities: n P_k + n_c C_k is what it spends on light k, P_k
//! being the probability of picking it and C_k that of meeting it by the cosine, and best in proportion to what the light gives.
//! The cosine's part is given, so what is left is picked, where something is left.

use std::f64::consts::PI;

/// How many samples of the cosine stand beside those that pick a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Compensation {
    /// n: samples of the technique that picks lights.
    pub own: u8,
    /// n_c: samples of `hemisphere/cosine`.
    pub cosine: u8,
}

/// One of each.
impl Default for Compensation {
    fn default() -> Self {
        Self { own: 1, cosine: 1 }
    }
}

impl Compensation {
    /// P_k ∝ max(0, (n + n_c) E_k/E − n_c C_k) of each light, up to a common factor, were nothing in between: E_k the
    /// irradiance that it gives, E = Σ E_k, and C_k = 1/π ∫ cosθ_x dω over it, of which `projected` is the integral.
    pub fn weights(self, given: &[f64], projected: &[f64]) -> Vec<f64> {
        let [n, n_c] = [self.own, self.cosine].map(f64::from);
        let e: f64 = given.iter().sum();
        let weight = |(e_k, m_k): (&f64, &f64)| ((n + n_c) * e_k - n_c * (m_k / PI) * e).max(0.0);
        given.iter().zip(projected).map(weight).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::Compensation;

    fn shares(compensation: Compensation, given: [f64; 2], of_cosine: [f64; 2]) -> [f64; 2] {
        let weights = compensation.weights(&given, &of_cosine.map(|c| c * PI));
        let total: f64 = weights.iter().sum();
        [weights[0] / total, weights[1] / total]
    }

    #[test]
    fn what_the_cosine_gives_is_not_given_again() {
        let near = |found: [f64; 2], known: [f64; 2]| (0..2).all(|k| (found[k] - known[k]).abs() < 1e-12);
        let even = Compensation::default();
        assert!(near(shares(even, [3.0, 1.0], [0.0, 0.0]), [0.75, 0.25]));
        assert!(near(shares(even, [2.0, 2.0], [0.5, 0.0]), [1.0 / 3.0, 2.0 / 3.0]));
        assert!(near(shares(even, [1.0, 3.0], [0.75, 0.0]), [0.0, 1.0]));
        // Where all of the sky is lit, n P_k + n_c C_k ∝ E_k.
        let [n, n_c] = [3.0, 2.0];
        let (given, of_cosine) = ([4.0, 6.0], [0.6, 0.4]);
        let picked = shares(Compensation { own: 3, cosine: 2 }, given, of_cosine);
        let spent = [0, 1].map(|k| (n * picked[k] + n_c * of_cosine[k]) / (n + n_c));
        assert!(near(spent, given.map(|e| e / 10.0)), "{spent:?}");
    }
}
