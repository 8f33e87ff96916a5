//! Quadrature against Monte Carlo as the dimension grows.

use twoforms_integration::{Error, Estimator, Exact, Interval, Rule, Source, Uniform, Variable, Versus, crossing};

use crate::support::{Outcome, SIX, close};

/// ∫ Σ g(x_k) dx over [0, 1]^d for d from 1 on, by a rule and by chance with at most so many evaluations.
fn sums(g: fn(f64) -> f64, one: Exact, rule: Rule, dimensions: usize, budget: u32) -> Result<Vec<Versus>, Error> {
    let exact = |d| (1..d).fold(one, |sum, _| sum + one);
    let sum = |d| Estimator::new(move |x: Vec<f64>| x.into_iter().map(g).sum(), Uniform(vec![Interval::UNIT; d]));
    (1..=dimensions).map(|d| Versus::new(&sum(d), exact(d), rule, budget)).collect()
}

/// Midpoints: an error of (5/6) d/m² for Σ 5x_k⁴, against (4/3) √(d/N). With N = m^d the two are alike near d = 4, from where
/// on the rule falls behind.
#[test]
fn midpoints_lose_from_four_dimensions_on() -> Outcome {
    let one = Exact::known(1.0, 16.0 / 9.0);
    let rows = sums(|x| 5.0 * x * x * x * x, one, Rule::Midpoint, 6, 4096)?;
    let axes: Vec<u32> = rows.iter().map(|row| row.per_axis).collect();
    assert_eq!(axes, [4096, 64, 16, 8, 5, 4]);
    for row in &rows {
        let (d, m) = (row.dimension as f64, f64::from(row.per_axis));
        close(row.rule / (5.0 / 6.0 * d / (m * m)), 1.0, 0.03);
        close(row.monte_carlo, 4.0 / 3.0 * (d / f64::from(row.evaluations)).sqrt(), 1e-15);
    }
    assert_eq!(crossing(&rows), Some(4));
    Ok(())
}

/// For a smooth f the Gauss–Legendre rule holds out longer; for an f with a kink it loses its lead.
#[test]
fn gauss_and_legendre_hold_out_while_f_is_smooth() -> Outcome {
    let smooth = Estimator::new(libm::exp, Uniform(Interval::UNIT)).exact(1e-13)?;
    let rows = sums(libm::exp, smooth, Rule::GaussLegendre, 6, 4096)?;
    assert_eq!(crossing(&rows), None, "{rows:?}");
    let kink = |x: f64| if x < 0.3 { 0.0 } else { x - 0.3 };
    let exact = Estimator::new(kink, Uniform(Interval::UNIT)).exact(1e-13)?;
    close(exact.mean, 0.245, 1e-13);
    let rows = sums(kink, exact, Rule::GaussLegendre, 7, 4096)?;
    assert_eq!(crossing(&rows), Some(6), "{rows:?}");
    Ok(())
}

/// A product that varies more with each dimension keeps chance behind: E[w²] is (25/9)^d, while the rule's error stays below 1.
#[test]
fn a_peak_in_many_dimensions_is_hard_for_chance_too() -> Outcome {
    let (one, mut exact) = (Exact::known(1.0, 16.0 / 9.0), Exact::known(1.0, 0.0));
    let mut rows = Vec::new();
    for d in 1..=6 {
        exact = exact * one;
        close(exact.variance / ((25.0_f64 / 9.0).powi(d) - 1.0), 1.0, 1e-14);
        let product = |x: Vec<f64>| x.into_iter().map(|x| 5.0 * x * x * x * x).product();
        let estimator = Estimator::new(product, Uniform(vec![Interval::UNIT; d as usize]));
        rows.push(Versus::new(&estimator, exact, Rule::Midpoint, 4096)?);
    }
    assert_eq!(crossing(&rows), None, "{rows:?}");
    Ok(())
}

/// The Monte Carlo column is what independent samples show, here in four dimensions. Seed 41; the rms of 1000 errors of nearly
/// normal means is known to √(1/2000).
#[test]
fn the_error_by_chance_is_the_measured_one() -> Outcome {
    let f = |x: Vec<f64>| x.into_iter().map(|x| 5.0 * x * x * x * x).sum();
    let estimator = Estimator::new(f, Uniform(vec![Interval::UNIT; 4]));
    let row = Versus::new(&estimator, Exact::known(4.0, 64.0 / 9.0), Rule::Midpoint, 256)?;
    let measured = estimator.replicates(&Source::independent(41), row.evaluations, 1000)?.rms_error(4.0);
    close(measured / row.monte_carlo, 1.0, SIX * (1.0_f64 / 2000.0).sqrt());
    Ok(())
}

#[test]
fn a_budget_must_allow_two_nodes_along_each_axis() {
    let estimator = Estimator::new(|x: Vec<f64>| x[0], Uniform(vec![Interval::UNIT; 8]));
    let exact = Exact::known(0.5, 1.0 / 12.0);
    assert!(Versus::new(&estimator, exact, Rule::Midpoint, 256).is_ok_and(|row| row.per_axis == 2));
    let refused = Versus::new(&estimator, exact, Rule::Midpoint, 255);
    assert_eq!(refused, Err(Error::SmallBudget { budget: 255, dimension: 8 }));
}
