//! What a variance costs.

/// Efficiency 1 / (variance × seconds) of an estimator (Hammersley and Handscomb 1964, section 2.5): `variance` of an
/// N-sample estimate, in the estimate's unit squared, and the CPU `seconds` it takes. Free of N where variance falls
/// as 1/N.
///
/// `None` where either is not positive and finite: a variance of zero has no efficiency to compare.
pub fn efficiency(variance: f64, seconds: f64) -> Option<f64> {
    let work = variance * seconds;
    (variance > 0.0 && seconds > 0.0 && work.is_normal()).then(|| 1.0 / work)
}

#[cfg(test)]
mod tests {
    use super::efficiency;

    #[test]
    fn is_one_over_the_product() {
        assert_eq!(efficiency(0.5, 0.25), Some(8.0));
    }

    #[test]
    fn needs_both() {
        for (variance, seconds) in [(0.0, 1.0), (1.0, 0.0), (-1.0, -1.0), (f64::NAN, 1.0), (f64::INFINITY, 1.0)] {
            assert_eq!(efficiency(variance, seconds), None);
        }
    }
}
