//! The normal law.

use statrs::function::erf::{erfc, erfc_inv};

/// Pr(Z > z) of a standard normal variable: erfc(z/√2)/2.
pub fn normal_tail(z: f64) -> f64 {
    0.5 * erfc(z / std::f64::consts::SQRT_2)
}

/// The z with Pr(Z > z) = `tail`, 0 < tail < 1.
pub fn normal_quantile(tail: f64) -> f64 {
    std::f64::consts::SQRT_2 * erfc_inv(2.0 * tail)
}

#[cfg(test)]
mod tests {
    use super::{normal_quantile, normal_tail};

    #[test]
    fn quantiles_are_the_tabulated_ones_and_invert_the_tail() {
        assert!((normal_quantile(0.025) - 1.959_963_984_540_054).abs() < 1e-9);
        for tail in [0.5, 0.1, 1e-3, 1e-6, 1e-9] {
            assert!((normal_tail(normal_quantile(tail)) / tail - 1.0).abs() < 1e-7, "{tail}");
        }
    }
}
