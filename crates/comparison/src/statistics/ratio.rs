//! By what factor one variance is below another.

use super::log_variance::LogVariance;
use super::student::{Z_95, student_quantile};

/// The ratio of two measured variances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VarianceRatio {
    /// s²_a / s²_b.
    pub value: f64,
    /// 95 % interval of σ²_a / σ²_b.
    pub interval: [f64; 2],
}

/// σ²_a / σ²_b with its 95 % interval, exp(ln(s²_a / s²_b) ± t √(se_a² + se_b²)).
///
/// The standard errors are those of [`LogVariance`], the t Student's with the degrees of freedom of Welch 1947,
/// ν = (se_a² + se_b²)² / (se_a⁴/ν_a + se_b⁴/ν_b). The two must be measured over independent replicates; rows of
/// one density under two formulations share their samples, and there the interval is too wide.
pub fn variance_ratio(a: &LogVariance, b: &LogVariance) -> VarianceRatio {
    let (of_a, of_b) = (a.standard_error() * a.standard_error(), b.standard_error() * b.standard_error());
    let both = of_a + of_b;
    let freedom = both * both / (of_a * of_a / a.freedom() + of_b * of_b / b.freedom());
    let factor = libm::exp(student_quantile(Z_95, freedom) * both.sqrt());
    let value = a.variance() / b.variance();
    VarianceRatio { value, interval: [value / factor, value * factor] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(scale: f64) -> LogVariance {
        let values: Vec<f64> = (0..200).map(|k| f64::from(k * k % 31) * scale).collect();
        LogVariance::from_replicates(&values).expect("spread is known")
    }

    #[test]
    fn swapping_inverts() {
        let (ab, ba) = (variance_ratio(&measured(4.0), &measured(1.0)), variance_ratio(&measured(1.0), &measured(4.0)));
        assert!((ab.value - 16.0).abs() < 1e-12);
        assert!((ab.interval[0] * ba.interval[1] - 1.0).abs() < 1e-12);
        assert!(ab.interval[0] < 16.0 && 16.0 < ab.interval[1]);
    }

    /// Two equally uncertain variances: √2 times the standard error of one, and twice its degrees of freedom.
    #[test]
    fn uncertainties_add_in_squares() {
        let one = measured(1.0);
        let ratio = variance_ratio(&one, &one);
        let half = student_quantile(Z_95, 2.0 * one.freedom()) * 2.0_f64.sqrt() * one.standard_error();
        assert!((libm::log(ratio.interval[1]) - half).abs() < 1e-12);
    }
}
