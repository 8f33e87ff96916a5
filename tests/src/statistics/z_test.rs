//! Is a mean what it should be?

use std::f64::consts::SQRT_2;
use std::fmt;

/// A value found, whose distribution is near to normal with a known standard deviation, against the one expected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZTest {
    /// What was found.
    pub found: f64,
    /// What it should be on average.
    pub expected: f64,
    /// The standard deviation of what was found.
    pub sigma: f64,
    /// A difference of expectations this large counts as none: what rounding may add.
    pub budget: f64,
}

impl ZTest {
    /// The difference beyond the budget, in standard deviations; infinite where there is none to spread it.
    pub fn z(&self) -> f64 {
        let beyond = (self.found - self.expected).abs() - self.budget;
        if beyond <= 0.0 { 0.0 } else { beyond / self.sigma }
    }

    /// Pr(|Z| ≥ z) = erfc(z/√2).
    pub fn p(&self) -> f64 {
        libm::erfc(self.z() / SQRT_2)
    }
}

impl fmt::Display for ZTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { found, expected, sigma, budget } = self;
        let (z, p) = (self.z(), self.p());
        write!(f, "{found:.9e}, expected {expected:.9e} ± {sigma:.2e} (budget {budget:.1e}): z = {z:.2}, p = {p:.2e}")
    }
}

#[cfg(test)]
mod tests {
    use super::ZTest;

    fn test(found: f64, sigma: f64, budget: f64) -> ZTest {
        ZTest { found, expected: 1.0, sigma, budget }
    }

    #[test]
    fn p_is_the_normal_one_on_both_sides() {
        for found in [1.0 + 1.959_963_984_540_054, 1.0 - 1.959_963_984_540_054] {
            assert!((test(found, 1.0, 0.0).p() - 0.05).abs() < 1e-12);
        }
        assert_eq!(test(1.0, 1.0, 0.0).p(), 1.0);
    }

    #[test]
    fn a_difference_within_the_budget_is_none() {
        assert_eq!(test(1.25, 0.1, 0.25).p(), 1.0);
        assert_eq!(test(1.5, 0.125, 0.25).z(), 2.0);
    }

    #[test]
    fn without_spread_only_the_budget_counts() {
        assert_eq!(test(1.0, 0.0, 0.0).p(), 1.0);
        assert_eq!(test(1.5, 0.0, 0.25).p(), 0.0);
        assert!(test(f64::NAN, 1.0, 0.0).p().is_nan());
    }
}
