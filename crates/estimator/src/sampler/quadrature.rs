//! Quadrature: deterministic product rules.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, PoisonError, RwLock};

use twoforms_geometry::real::{Real, Word};

use super::arithmetic::{Divisor, Strata, side};
use super::{Place, Spread};
use crate::gauss::legendre;

/// The midpoint rule on n × n cells: the lecture's rule.
#[derive(Clone, Copy, Debug)]
pub struct Midpoint;

/// A square grid.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    division: Divisor,
    strata: Strata,
}

impl Spread for Midpoint {
    type Plan = Grid;

    const RANDOM: bool = false;

    fn plan(n: u32, _: u32) -> Grid {
        Grid { division: Divisor::new(side(n)), strata: Strata::new(side(n)) }
    }

    #[inline(always)]
    fn pair<R: Real>(grid: &Grid, place: &Place<R>) -> [R::Word; 2] {
        let ([row, column], middle) = (grid.division.split::<R>(place.index), R::Word::splat(1 << 31));
        [grid.strata.word(column, middle), grid.strata.word(row, middle)]
    }

    fn rounded(n: u32) -> u32 {
        side(n) * side(n)
    }
}

/// The product of two Gauss–Legendre rules of n nodes, which is exact for polynomials up to degree 2n − 1 in each number.
#[derive(Clone, Copy, Debug)]
pub struct Gauss;

/// A square of nodes.
#[derive(Clone, Debug)]
pub struct Nodes {
    division: Divisor,
    rule: Arc<Rule>,
}

/// The nodes of one axis as words, and what each counts, 1 in the mean.
#[derive(Debug)]
struct Rule(Vec<(u32, f32)>);

/// The rules that were asked for so far, by their number of nodes.
static RULES: LazyLock<RwLock<BTreeMap<u32, Arc<Rule>>>> = LazyLock::new(RwLock::default);

impl Spread for Gauss {
    type Plan = Nodes;

    const RANDOM: bool = false;
    const WEIGHTED: bool = true;

    fn plan(n: u32, _: u32) -> Nodes {
        Nodes { division: Divisor::new(side(n)), rule: Rule::of(side(n)) }
    }

    #[inline(always)]
    fn pair<R: Real>(nodes: &Nodes, place: &Place<R>) -> [R::Word; 2] {
        let [row, column] = nodes.division.split::<R>(place.index);
        [R::map_word(column, |k| nodes.rule.at(k).0), R::map_word(row, |k| nodes.rule.at(k).0)]
    }

    #[inline(always)]
    fn weight<R: Real>(nodes: &Nodes, place: &Place<R>) -> R {
        let [row, column] = nodes.division.split::<R>(place.index);
        let ([of_column], [of_row]) = (nodes.rule.weights::<R>(column), nodes.rule.weights::<R>(row));
        of_column * of_row
    }

    fn rounded(n: u32) -> u32 {
        side(n) * side(n)
    }
}

impl Rule {
    fn of(n: u32) -> Arc<Self> {
        let known = RULES.read().unwrap_or_else(PoisonError::into_inner).get(&n).cloned();
        known.unwrap_or_else(|| {
            let mut rules = RULES.write().unwrap_or_else(PoisonError::into_inner);
            rules.entry(n).or_insert_with(|| Arc::new(Self::new(n))).clone()
        })
    }

    fn new(n: u32) -> Self {
        let node = |(u, weight): (f64, f64)| (word(u), (weight * f64::from(n)) as f32);
        Self(legendre(n as usize).into_iter().map(node).collect())
    }

    #[inline(always)]
    fn weights<R: Real>(&self, k: R::Word) -> [R; 1] {
        R::gather(
            k,
            #[inline(always)]
            |k| [self.at(k).1],
        )
    }

    /// A node and its weight; the first one for a sample beyond the last, which nobody asks for.
    fn at(&self, k: u32) -> (u32, f32) {
        self.0.get(k as usize).copied().unwrap_or(self.0[0])
    }
}

/// The word of a number in (0, 1).
fn word(u: f64) -> u32 {
    (u * 4_294_967_296.0 - 0.5).round() as u32
}
