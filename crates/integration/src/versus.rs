//! Quadrature against Monte Carlo as the dimension grows.

use crate::error::Error;
use crate::exact::Exact;
use crate::rule::Rule;
use crate::variable::Variable;

/// A product rule and the mean of as many independent samples, at one integral.
///
/// ```
/// use twoforms_integration::{Estimator, Interval, Rule, Uniform, Variable, Versus, crossing};
///
/// // ∫ 5x₁⁴ + ⋯ + 5x_d⁴ = d over [0, 1]^d, with at most 4096 evaluations.
/// let term = |x: f64| 5.0 * x.powi(4);
/// let one = Estimator::new(term, Uniform(Interval::UNIT)).exact(1e-12)?;
/// let (mut exact, mut rows) = (one, Vec::new());
/// for d in 1..=6 {
///     let cube = Uniform(vec![Interval::UNIT; d]);
///     let estimator = Estimator::new(|x: Vec<f64>| x.into_iter().map(term).sum(), cube);
///     rows.push(Versus::new(&estimator, exact, Rule::Midpoint, 4096)?);
///     exact = exact + one;
/// }
/// assert_eq!(crossing(&rows), Some(4));
/// # Ok::<(), twoforms_integration::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Versus {
    /// d.
    pub dimension: usize,
    /// m: nodes along each axis.
    pub per_axis: u32,
    /// N = m^d: evaluations of either.
    pub evaluations: u32,
    /// |rule − I|.
    pub rule: f64,
    /// σ/√N: the root mean square error of the mean of N independent samples.
    pub monte_carlo: f64,
}

impl Versus {
    /// Both with the same number of evaluations, the largest m^d that the budget allows. `exact` is the variable's, from
    /// [`Variable::exact`] or as a product or sum of known ones.
    ///
    /// # Errors
    /// [`Error::SmallBudget`] where m would be less than two.
    pub fn new(variable: &impl Variable, exact: Exact, rule: Rule, budget: u32) -> Result<Self, Error> {
        let dimension = variable.dimension();
        let fits = |m: u32| m.checked_pow(dimension as u32).is_some_and(|evaluations| evaluations <= budget);
        let per_axis = largest(fits, budget);
        if per_axis < 2 {
            return Err(Error::SmallBudget { budget, dimension });
        }
        let evaluations = per_axis.pow(dimension as u32);
        let error = (variable.by_rule(rule, per_axis) - exact.mean).abs();
        let monte_carlo = exact.of_mean(evaluations).sigma();
        Ok(Self { dimension, per_axis, evaluations, rule: error, monte_carlo })
    }
}

/// The largest number up to a limit that fits, where all below one that fits do too; 0 where none does.
fn largest(fits: impl Fn(u32) -> bool, limit: u32) -> u32 {
    let (mut low, mut high) = (0, limit);
    while low < high {
        let middle = high - (high - low) / 2;
        if fits(middle) { low = middle } else { high = middle - 1 }
    }
    low
}

/// The dimension from which on, among those listed, Monte Carlo's error is the smaller one; `None` where the rule's is, at the last.
pub fn crossing(rows: &[Versus]) -> Option<usize> {
    let won = rows.iter().rev().take_while(|row| row.monte_carlo < row.rule);
    won.last().map(|row| row.dimension)
}
