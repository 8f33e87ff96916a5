//! Quadrature against Monte Carlo as the dimension grows: ∫ Σ 5x_k⁴ over [0, 1]^d at equal numbers of evaluations, and the
//! dimension from which on chance has the smaller error.

use twoforms_integration::{Error, Estimator, Exact, Interval, Rule, Source, Uniform, Variable, Versus, crossing};

/// Evaluations allowed.
const BUDGET: u32 = 4096;
/// Replicates of the mean.
const REPLICATES: u32 = 200;

fn main() -> Result<(), Error> {
    let term = |x: f64| 5.0 * x * x * x * x;
    let one = Estimator::new(term, Uniform(Interval::UNIT)).exact(1e-12)?;
    println!(" d   m     N  midpoint    σ/√N        RMS error measured");
    let (mut exact, mut rows) = (Exact::known(0.0, 0.0), Vec::new());
    for d in 1..=8 {
        exact = exact + one;
        let sum = Estimator::new(|x: Vec<f64>| x.into_iter().map(term).sum(), Uniform(vec![Interval::UNIT; d]));
        let row = Versus::new(&sum, exact, Rule::Midpoint, BUDGET)?;
        let measured = sum.replicates(&Source::independent(0), row.evaluations, REPLICATES)?.rms_error(exact.mean);
        let Versus { per_axis, evaluations, rule, monte_carlo, .. } = row;
        println!("{d:2}{per_axis:5}{evaluations:6}  {rule:.3e}   {monte_carlo:.3e}   {measured:.3e}");
        rows.push(row);
    }
    match crossing(&rows) {
        Some(d) => println!("from {d} dimensions on chance is the better"),
        None => println!("the rule is the better up to {} dimensions", rows.len()),
    }
    Ok(())
}
