//! Gauss–Legendre rules.

use std::f64::consts::PI;

/// Nodes and weights on [0, 1].
pub type Rule = Vec<(f64, f64)>;

/// Nodes and weights of the n-point Gauss–Legendre rule on [0, 1], by Newton's method on P_n.
pub fn legendre(n: usize) -> Rule {
    (0..n).map(|k| node(n, k)).collect()
}

fn node(n: usize, k: usize) -> (f64, f64) {
    let mut x = libm::cos(PI * (k as f64 + 0.75) / (n as f64 + 0.5));
    for _ in 0..20 {
        let (p, slope) = polynomial(n, x);
        x -= p / slope;
    }
    let (_, slope) = polynomial(n, x);
    (0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope))
}

/// P_n(x) and its derivative, by Bonnet's recursion.
fn polynomial(n: usize, x: f64) -> (f64, f64) {
    let (mut p, mut previous) = (1.0, 0.0);
    for j in 1..=n {
        let j = j as f64;
        (p, previous) = (((2.0 * j - 1.0) * x * p - (j - 1.0) * previous) / j, p);
    }
    (p, n as f64 * (x * p - previous) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rule_of_n_nodes_is_exact_to_degree_two_n_minus_one() {
        for n in [1, 2, 7, 11, 16] {
            for degree in 0..2 * n {
                let sum: f64 = legendre(n).iter().map(|(x, w)| w * x.powi(degree as i32)).sum();
                let known = 1.0 / (degree as f64 + 1.0);
                assert!((sum - known).abs() < 1e-15 * (1.0 + n as f64), "{n} nodes, degree {degree}: {sum}");
            }
        }
    }
}
