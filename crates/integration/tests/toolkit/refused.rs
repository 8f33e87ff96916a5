//! What is refused, and how.

use twoforms_integration::{
    Discrete, Error, Estimator, Exponential, Given, Interval, Linear, Piecewise, Power, Rule, Source, Uniform,
    Variable, chebyshev,
};

const UNIT: Interval = Interval::UNIT;

#[test]
fn intervals() {
    for (a, b) in [(1.0, 1.0), (2.0, 1.0), (0.0, f64::INFINITY), (f64::NAN, 1.0), (-f64::MAX, f64::MAX)] {
        assert!(matches!(Interval::new(a, b), Err(Error::BadInterval { .. })), "[{a}, {b}]");
    }
}

#[test]
fn weights() {
    for (weights, index) in
        [(vec![], 0), (vec![0.0, 0.0], 2), (vec![1.0, -0.5], 1), (vec![f64::NAN], 0), (vec![1.0, f64::INFINITY], 1)]
    {
        let refused = Discrete::new(weights.iter().map(|&weight| (1.0, weight)));
        assert!(matches!(refused, Err(Error::BadWeight { index: i, .. }) if i == index), "{weights:?}: {refused:?}");
    }
    for ends in [[0.0, 0.0], [-1.0, 2.0], [1.0, f64::NAN]] {
        assert!(matches!(Linear::new(UNIT, ends), Err(Error::BadWeight { .. })), "{ends:?}");
    }
}

#[test]
fn parameters() -> Result<(), Error> {
    let below = Interval::new(-1.0, 1.0)?;
    let powers = [Power::new(UNIT, -1.0), Power::new(UNIT, f64::NAN), Power::new(below, 2.0), Power::new(UNIT, 1e300)];
    for refused in &powers[..3] {
        assert!(matches!(refused, Err(Error::BadParameter { .. })), "{refused:?}");
    }
    let underflow = Power::new(Interval::new(0.0, 0.5)?, 1e300);
    assert!(matches!(underflow, Err(Error::BadParameter { .. })), "{underflow:?}");
    for (rate, a) in [(0.0, 0.0), (-1.0, 0.0), (f64::INFINITY, 0.0), (1.0, f64::NAN)] {
        assert!(matches!(Exponential::new(rate, a), Err(Error::BadParameter { .. })), "{rate}, {a}");
    }
    Ok(())
}

#[test]
fn tables() {
    assert!(matches!(Piecewise::steps(&[0.0, 1.0], &[1.0, 2.0]), Err(Error::BadTable { places: 2, values: 2, .. })));
    assert!(matches!(Piecewise::lines(&[0.0], &[1.0]), Err(Error::BadTable { .. })));
    assert!(matches!(Piecewise::steps(&[0.0, 1.0, 1.0], &[1.0, 2.0]), Err(Error::BadInterval { .. })));
    assert!(matches!(Piecewise::steps(&[0.0, 1.0], &[0.0]), Err(Error::BadWeight { .. })));
    assert!(matches!(Piecewise::of(UNIT, 0, |x| x), Err(Error::BadTable { .. })));
}

/// A cdf that does not reach 1, one that the inverse does not undo, and a pdf that is negative.
#[test]
fn functions_that_make_no_density() {
    let refused = [
        Given::numeric(UNIT, |_| 1.0, |x| 0.5 * x).err(),
        Given::closed(UNIT, |_| 1.0, |x| x, |xi: f64| xi * xi).err(),
        Given::closed(UNIT, |_| -1.0, |x| x, |xi| xi).err(),
    ];
    for error in refused {
        assert!(matches!(error, Some(Error::NotADensity { .. })), "{error:?}");
    }
}

/// A sample that is not finite stops the mean and says which it was.
#[test]
fn samples_that_are_not_finite() {
    let estimator = Estimator::new(|x: f64| (x - 0.5).sqrt(), Uniform(UNIT));
    let Err(Error::NotFinite { value, xi, .. }) = estimator.secondary(&Source::independent(0).stream(100, 0)) else {
        panic!("the root of a negative number was taken for a worth");
    };
    assert!(value.is_nan() && xi.len() == 1 && xi[0] < 0.5, "{value} at {xi:?}");
}

#[test]
fn no_samples() {
    let estimator = Estimator::new(|x: f64| x, Uniform(UNIT));
    assert_eq!(estimator.secondary(&Source::independent(0).stream(0, 0)), Err(Error::NoSamples));
    assert_eq!(estimator.by_rule(Rule::Midpoint, 0), 0.0);
}

#[test]
fn chebyshev_needs_a_width_and_a_share() {
    for (sigma_n, delta) in [(0.0, 0.1), (f64::NAN, 0.1), (1.0, 0.0), (1.0, 1.5)] {
        assert_eq!(chebyshev(&[1.0], 1.0, sigma_n, delta), None);
    }
    assert_eq!(chebyshev(&[], 1.0, 1.0, 0.1), None);
    assert_eq!(chebyshev(&[-2.0, -1.0, 0.0, 1.0, 2.0], 0.0, 1.0, 0.25).map(|band| band.outside), Some(0.4));
}
