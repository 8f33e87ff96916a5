//! Cubature against known integrals.

use std::f64::consts::{E, FRAC_1_PI, PI};

use twoforms_integration::{Error, Estimator, Interval, Linear, Uniform, Variable, integrate};

use crate::support::{Outcome, close};

#[test]
fn smooth_functions_in_one_to_five_dimensions() -> Outcome {
    for d in 1..=5 {
        let integral = integrate(d, |xi| libm::exp(xi.iter().sum()), 1e-9, 0.0)?;
        let known = (E - 1.0).powi(d as i32);
        close(integral.value / known, 1.0, 1e-11);
        assert!((integral.value - known).abs() <= integral.error + 1e-14 * known, "{integral:?}");
    }
    Ok(())
}

#[test]
fn no_dimensions_at_all() -> Outcome {
    close(integrate(0, |_| 3.0, 1e-12, 0.0)?.value, 3.0, 0.0);
    Ok(())
}

/// An edge, a kink, a pole that can be integrated.
#[test]
fn rough_functions_in_one_dimension() -> Outcome {
    let edge = integrate(1, |xi| if xi[0] < FRAC_1_PI { 1.0 } else { 0.0 }, 1e-12, 0.0)?;
    close(edge.value, FRAC_1_PI, 1e-12);
    let kink = integrate(1, |xi| (xi[0] - 0.3).abs(), 1e-12, 0.0)?;
    close(kink.value, 0.29, 1e-13);
    let pole = integrate(1, |xi| 1.0 / xi[0].sqrt(), 1e-10, 0.0)?;
    close(pole.value, 2.0, 1e-9);
    Ok(())
}

/// A quarter of a disk, whose edge no axis follows.
#[test]
fn an_oblique_edge_in_two_dimensions() -> Outcome {
    let disk = integrate(2, |xi| if xi[0] * xi[0] + xi[1] * xi[1] < 1.0 { 1.0 } else { 0.0 }, 1e-3, 0.0)?;
    close(disk.value, PI / 4.0, 1e-3 * PI / 4.0);
    Ok(())
}

/// With p = x/8 the estimator of ∫₀⁴ 1 dx has mean 4 and no finite variance: ∫ 8/x dx.
#[test]
fn an_infinite_variance_is_not_given_a_number() -> Outcome {
    let estimator = Estimator::new(|_| 1.0, Linear::new(Interval::new(0.0, 4.0)?, [0.0, 1.0])?);
    assert!(matches!(estimator.exact(1e-9), Err(Error::NotConverged { .. })));
    Ok(())
}

#[test]
fn too_many_dimensions_are_refused_at_once() -> Outcome {
    close(integrate(8, |_| 1.0, 1e-9, 0.0)?.value, 1.0, 1e-10);
    assert!(matches!(integrate(10, |_| 1.0, 1e-9, 0.0), Err(Error::TooManyDimensions { dimension: 10, .. })));
    Ok(())
}

#[test]
fn what_is_not_finite_is_not_given_a_number() {
    let estimator = Estimator::new(|x: f64| (x - 2.0).sqrt(), Uniform(Interval::UNIT));
    assert!(matches!(estimator.exact(1e-9), Err(Error::NotConverged { .. })));
}
