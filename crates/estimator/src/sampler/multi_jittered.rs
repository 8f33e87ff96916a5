//! Correlated multi-jittered samples: stratified in cells, in columns and in rows.

use twoforms_geometry::real::{Real, Word};

use super::arithmetic::{Divisor, Strata, permute, shuffle_cells};
use super::{Place, Spread};

/// N = m·n samples: one in each cell of a grid, one in each of N columns, one in each of N rows (Chiu, Shirley and Wang 1994,
/// "Multi-jittered sampling"), the places of cells within their columns being the same for all rows and the other way
/// around (Kensler 2013, "Correlated multi-jittered sampling"). The cells come in random order, another one for each pair.
#[derive(Clone, Copy, Debug)]
pub struct MultiJittered;

/// A grid, and the strata of all samples along one axis.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    columns: u32,
    rows: u32,
    division: Divisor,
    strata: Strata,
}

/// As many columns as rows, or up to two fewer.
fn shape(n: u32) -> [u32; 2] {
    let columns = n.isqrt().max(1);
    [columns, n.div_ceil(columns).max(1)]
}

impl Spread for MultiJittered {
    type Plan = Grid;

    fn plan(n: u32, _: u32) -> Grid {
        let [columns, rows] = shape(n);
        Grid { columns, rows, division: Divisor::new(columns), strata: Strata::new(columns * rows) }
    }

    #[inline(always)]
    fn pair<R: Real>(&Grid { columns, rows, division, strata }: &Grid, place: &Place<R>) -> [R::Word; 2] {
        let [order, of_rows, of_columns, _] = place.seed;
        let [row, column] = division.split::<R>(place.index);
        let [column, row] = shuffle_cells::<R>([column, row], [columns, rows], order);
        let across = column.wrapping_mul(R::Word::splat(rows)).wrapping_add(permute::<R>(row, rows, of_rows));
        let up = row.wrapping_mul(R::Word::splat(columns)).wrapping_add(permute::<R>(column, columns, of_columns));
        let [u, v] = place.noise();
        [strata.word(across, u), strata.word(up, v)]
    }

    fn rounded(n: u32) -> u32 {
        let [columns, rows] = shape(n);
        columns.saturating_mul(rows)
    }
}
