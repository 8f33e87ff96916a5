//! Jittered samples: one in each cell of a square grid.

use twoforms_geometry::real::Real;

use super::arithmetic::{Divisor, Strata, shuffle_cells, side};
use super::{Place, Spread};

/// One sample in each of n × n cells, uniform in its cell (Cook, Porter and Carpenter 1984, "Distributed ray tracing"; Mitchell
/// 1996, "Consequences of stratified sampling in graphics"). The cells come in random order, another one for each pair.
#[derive(Clone, Copy, Debug)]
pub struct Jittered;

/// A square grid.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    side: u32,
    division: Divisor,
    strata: Strata,
}

impl Spread for Jittered {
    type Plan = Grid;

    fn plan(n: u32, _: u32) -> Grid {
        let side = side(n);
        Grid { side, division: Divisor::new(side), strata: Strata::new(side) }
    }

    #[inline(always)]
    fn pair<R: Real>(grid: &Grid, place: &Place<R>) -> [R::Word; 2] {
        let [seed, ..] = place.seed;
        let [row, column] = grid.division.split::<R>(place.index);
        let [column, row] = shuffle_cells::<R>([column, row], [grid.side; 2], seed);
        let [u, v] = place.noise();
        [grid.strata.word(column, u), grid.strata.word(row, v)]
    }

    fn rounded(n: u32) -> u32 {
        side(n) * side(n)
    }
}
