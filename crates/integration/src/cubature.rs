//! Adaptive cubature over the unit cube.

use std::ops::Range;

use crate::error::Error;
use crate::rule::{Nodes, Rule, product};

/// An integral over the unit cube.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Integral {
    /// ∫ g.
    pub value: f64,
    /// ∫ |g|.
    pub absolute: f64,
    /// Σ over cells of |higher rule − lower rule|: the error of the lower rule, above that of the higher one, whose value is taken.
    pub error: f64,
}

/// Evaluations after which no more cells are halved.
const EVALUATIONS: usize = 1 << 23;
/// Width below which no cell is halved: a pole that needs it is hardly one that can be integrated.
const NARROWEST: f64 = 1e-90;

/// ∫ g dξ over the unit cube of `dimension` axes, with an error of at most `relative` times ∫ |g|, or at most `absolute`.
///
/// Cells whose error is more than their share are halved, across the axis along which the lower rule fails most, until the
/// errors sum to what is allowed. An edge of g along an axis is closed in on by halving; oblique edges in two and more dimensions cost
/// much. What happens between the nodes of the first cells, two along each of the first axes, is not seen.
///
/// # Errors
/// [`Error::NotConverged`] after some eight million evaluations, where cells would have to be narrower than rounding allows, as at
/// a pole that cannot be integrated, and where g is not finite; [`Error::TooManyDimensions`] from ten on.
pub fn integrate(dimension: usize, g: impl Fn(&[f64]) -> f64, relative: f64, absolute: f64) -> Result<Integral, Error> {
    let rules = Rules::new(dimension);
    if rules.cost() > EVALUATIONS {
        return Err(Error::TooManyDimensions { dimension, evaluations: rules.cost() });
    }
    let mut patches = vec![vec![0.0..1.0; dimension]];
    for axis in (0..dimension).take_while(|axis| rules.cost() << axis < EVALUATIONS / 8) {
        patches = patches.iter().flat_map(|patch| halves(patch, axis)).collect();
    }
    let mut evaluations = patches.len() * rules.cost();
    let mut cells: Vec<Cell> = patches.into_iter().map(|patch| Cell::new(&rules, patch, &g)).collect();
    loop {
        let total = cells.iter().fold(Integral::default(), |sum, cell| sum.plus(cell.integral));
        let allowed = absolute.max(relative * total.absolute);
        if total.error <= allowed {
            return Ok(total);
        }
        let stuck = Error::NotConverged { value: total.value, error: total.error, evaluations };
        if evaluations > EVALUATIONS || !total.error.is_finite() {
            return Err(stuck);
        }
        let share = allowed / cells.len() as f64;
        let mut refined = Vec::with_capacity(2 * cells.len());
        for cell in cells {
            if cell.integral.error <= share {
                refined.push(cell);
            } else {
                let axis = cell.worst_axis(&rules, &g);
                if is_narrow(&cell.patch, axis) {
                    return Err(stuck);
                }
                refined.extend(halves(&cell.patch, axis).map(|half| Cell::new(&rules, half, &g)));
                evaluations += (2 + dimension) * rules.cost();
            }
        }
        cells = refined;
    }
}

impl Integral {
    fn plus(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            absolute: self.absolute + other.absolute,
            error: self.error + other.error,
        }
    }
}

/// A box in the unit cube.
type Patch = Vec<Range<f64>>;

fn halves(patch: &Patch, axis: usize) -> [Patch; 2] {
    let Range { start, end } = patch[axis];
    let middle = 0.5 * (start + end);
    [start..middle, middle..end].map(|half| {
        let mut patch = patch.clone();
        patch[axis] = half;
        patch
    })
}

/// Whether there is nothing between the ends of a side worth halving at.
fn is_narrow(patch: &Patch, axis: usize) -> bool {
    patch.get(axis).is_none_or(|side| side.end - side.start <= NARROWEST.max(2.0 * f64::EPSILON * side.start))
}

/// The Gauss–Legendre rule whose value is taken, and the one that it is judged by.
struct Rules {
    high: Nodes,
    low: Nodes,
    dimension: usize,
}

impl Rules {
    /// Fewer nodes where there are more axes.
    fn new(dimension: usize) -> Self {
        let [high, low] = match dimension {
            0..=2 => [11, 7],
            3 => [7, 5],
            _ => [5, 4],
        }
        .map(|m| Rule::GaussLegendre.nodes(m));
        Self { high, low, dimension }
    }

    /// Evaluations that a cell takes.
    fn cost(&self) -> usize {
        [&self.high, &self.low].map(|rule| rule.len().saturating_pow(self.dimension as u32)).iter().sum()
    }

    /// ∫ g and ∫ |g| over a patch, by the lower rule along such axes and the higher one along the others.
    fn apply(&self, patch: &Patch, low: impl Fn(usize) -> bool, g: &impl Fn(&[f64]) -> f64) -> [f64; 2] {
        let axes = patch.iter().enumerate().map(|(axis, side)| {
            let (rule, length) = (if low(axis) { &self.low } else { &self.high }, side.end - side.start);
            rule.iter().map(|(u, weight)| (side.start + length * u, length * weight)).collect()
        });
        let mut absolute = 0.0;
        let value = product(&axes.collect::<Vec<Nodes>>(), |xi, weight| {
            let term = weight * g(xi);
            absolute += term.abs();
            term
        });
        [value, absolute]
    }
}

struct Cell {
    patch: Patch,
    integral: Integral,
}

impl Cell {
    fn new(rules: &Rules, patch: Patch, g: &impl Fn(&[f64]) -> f64) -> Self {
        let [value, absolute] = rules.apply(&patch, |_| false, g);
        let [judge, _] = rules.apply(&patch, |_| true, g);
        Self { patch, integral: Integral { value, absolute, error: (value - judge).abs() } }
    }

    /// The axis along which the lower rule differs most from the higher one.
    fn worst_axis(&self, rules: &Rules, g: &impl Fn(&[f64]) -> f64) -> usize {
        let failure = |axis| (rules.apply(&self.patch, |other| other == axis, g)[0] - self.integral.value).abs();
        let axes = 0..self.patch.len();
        if axes.len() < 2 {
            return 0;
        }
        axes.map(|axis| (axis, failure(axis))).fold((0, -1.0), |worst, of| if of.1 > worst.1 { of } else { worst }).0
    }
}
