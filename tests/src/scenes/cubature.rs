//! Integrals over flat polygons by product rules: no cancellation, whatever the distance.

use glam::DVec3;

/// Points of the rule along each axis of a triangle.
const ORDER: usize = 48;

/// ∫ f(y) dA over a convex polygon.
///
/// Each triangle (a, b, c) of a fan is covered by y = a + u (b - a) + u v (c - b), whose Jacobian
/// is 2 A u (Duffy 1982), with Gauss-Legendre points in u and v.
pub fn over_polygon(polygon: &[DVec3], f: impl Fn(DVec3) -> f64) -> f64 {
    let rule = gauss_legendre(ORDER);
    let Some(&a) = polygon.first() else {
        return 0.0;
    };
    let fan = polygon[1..].windows(2).map(|w| over_triangle([a, w[0], w[1]], &rule, &f));
    fan.sum()
}

fn over_triangle([a, b, c]: [DVec3; 3], rule: &[(f64, f64)], f: impl Fn(DVec3) -> f64) -> f64 {
    let mut sum = 0.0;
    for &(u, weight_u) in rule {
        for &(v, weight_v) in rule {
            sum += weight_u * weight_v * u * f(a + (b - a) * u + (c - b) * (u * v));
        }
    }
    sum * (b - a).cross(c - a).length()
}

/// Nodes and weights of the n-point Gauss-Legendre rule on [0, 1], by Newton's method on P_n.
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let node = |k: usize| {
        let mut x = libm::cos(std::f64::consts::PI * (k as f64 + 0.75) / (n as f64 + 0.5));
        for _ in 0..8 {
            let (p, slope) = legendre(n, x);
            x -= p / slope;
        }
        let (_, slope) = legendre(n, x);
        (0.5 - 0.5 * x, 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(node).collect()
}

/// P_n(x) and P_n'(x) by the three-term recurrence, |x| < 1.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut p) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (previous, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * previous) / k);
    }
    (p, n as f64 * (x * p - previous) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rule_is_exact_to_degree_2n_minus_1() {
        let rule = gauss_legendre(8);
        for degree in 0..16 {
            let integral: f64 = rule.iter().map(|(x, weight)| weight * x.powi(degree)).sum();
            assert!((integral * f64::from(degree + 1) - 1.0).abs() < 1e-14, "degree {degree}");
        }
    }

    #[test]
    fn polynomial_over_a_square() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let square = square.map(|[x, y]| DVec3::new(x, y, 5.0));
        let integral = over_polygon(&square, |p| p.x * p.x * p.y * p.z);
        assert!((integral - 80.0 / 3.0).abs() < 1e-12);
    }
}
