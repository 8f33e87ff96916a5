//! Mean and variance of replicates.

/// Mean of `values`; `None` of an empty slice.
///
/// Summed as differences from the first value, so that equal values have exactly that mean.
pub fn sample_mean(values: &[f64]) -> Option<f64> {
    let first = *values.first()?;
    let sum: f64 = values.iter().map(|value| value - first).sum();
    Some(first + sum / values.len() as f64)
}

/// Sample variance s² = Σ (x − x̄)² / (n − 1), in two passes; `None` of fewer than two values.
///
/// Exactly zero for equal values, and no cancellation where the variance is far below the squared mean
/// (Chan, Golub and LeVeque 1983, "Algorithms for computing the sample variance"). A value that is not finite makes the
/// result not finite.
pub fn sample_variance(values: &[f64]) -> Option<f64> {
    let mean = sample_mean(values)?;
    let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    (values.len() > 1).then(|| squares / (values.len() - 1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        assert_eq!(sample_mean(&[1.0, 2.0, 6.0]), Some(3.0));
        assert_eq!(sample_variance(&[1.0, 2.0, 6.0]), Some(7.0));
    }

    #[test]
    fn one_value_has_no_variance() {
        assert_eq!(sample_variance(&[]), None);
        assert_eq!(sample_variance(&[0.1]), None);
        assert_eq!(sample_mean(&[]), None);
    }

    #[test]
    fn equal_values_have_exactly_none() {
        assert_eq!(sample_variance(&[0.1; 1000]), Some(0.0));
        assert_eq!(sample_mean(&[0.1; 1000]), Some(0.1));
    }

    #[test]
    fn a_large_mean_costs_nothing() {
        let small: Vec<f64> = (0..1000).map(|k| f64::from(k % 8) / 1024.0).collect();
        let far: Vec<f64> = small.iter().map(|value| value + 1_048_576.0).collect();
        let (near, far) = (sample_variance(&small), sample_variance(&far));
        assert!((near.unwrap_or(0.0) - far.unwrap_or(1.0)).abs() < 1e-15);
    }

    #[test]
    fn what_is_not_finite_shows() {
        assert!(sample_variance(&[1.0, f64::NAN]).is_some_and(f64::is_nan));
    }
}
