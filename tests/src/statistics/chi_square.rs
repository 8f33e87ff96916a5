//! Do counts follow their expectations?

use std::fmt;

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Cells with fewer expected counts are pooled, lest χ² be far from its limit (Cochran 1954).
const LEAST_EXPECTED: f64 = 5.0;

/// Pearson's χ² over cells, some of them pooled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChiSquare {
    /// Σ (observed − expected)² / expected.
    pub statistic: f64,
    /// Number of cells after pooling, less one.
    pub freedom: usize,
    /// Number of counts.
    pub n: u64,
    /// The cell with the largest term, its observed and its expected count.
    pub worst: (usize, f64, f64),
}

struct Cell {
    index: usize,
    observed: f64,
    expected: f64,
}

impl Cell {
    fn term(&self) -> f64 {
        (self.observed - self.expected) * (self.observed - self.expected) / self.expected
    }
}

impl ChiSquare {
    /// χ² of `observed` counts, whose sum is that of `expected` up to rounding. Cells are pooled from the smallest on
    /// until each has at least five expected counts; a pool goes by the index of its last cell.
    pub fn new(observed: &[u64], expected: &[f64]) -> Self {
        let cells = pooled(observed, expected);
        let worst = cells.iter().max_by(|a, b| a.term().total_cmp(&b.term()));
        Self {
            statistic: cells.iter().map(Cell::term).sum(),
            freedom: cells.len().saturating_sub(1),
            n: observed.iter().sum(),
            worst: worst.map_or((0, 0.0, 0.0), |cell| (cell.index, cell.observed, cell.expected)),
        }
    }

    /// Pr(χ² ≥ statistic); 1 where a single cell is left.
    pub fn p(&self) -> f64 {
        if self.freedom == 0 {
            return 1.0;
        }
        ChiSquared::new(self.freedom as f64).map_or(f64::NAN, |law| law.sf(self.statistic))
    }
}

/// Cells in ascending order of expectation, merged until each is large enough.
fn pooled(observed: &[u64], expected: &[f64]) -> Vec<Cell> {
    let cell =
        |(index, (&observed, &expected)): (usize, (&u64, &f64))| Cell { index, observed: observed as f64, expected };
    let mut ascending: Vec<Cell> = observed.iter().zip(expected).enumerate().map(cell).collect();
    ascending.sort_by(|a, b| a.expected.total_cmp(&b.expected));
    let mut pools: Vec<Cell> = Vec::new();
    for next in ascending {
        match pools.last_mut() {
            Some(pool) if pool.expected < LEAST_EXPECTED => {
                pool.index = next.index;
                pool.observed += next.observed;
                pool.expected += next.expected;
            }
            _ => pools.push(next),
        }
    }
    pools
}

impl fmt::Display for ChiSquare {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { statistic, freedom, n, worst: (cell, observed, expected) } = self;
        let p = self.p();
        write!(
            f,
            "χ² = {statistic:.1} with {freedom} degrees of freedom, p = {p:.2e}, N = {n}; worst: {observed} in cell {cell}, expected {expected:.1}"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::ChiSquare;

    #[test]
    fn a_die_by_hand() {
        let found = ChiSquare::new(&[5, 8, 9, 8, 10, 20], &[10.0; 6]);
        assert!((found.statistic - 13.4).abs() < 1e-12);
        assert_eq!((found.freedom, found.n, found.worst), (5, 60, (5, 20.0, 10.0)));
        assert!((found.p() - 0.019_905_2).abs() < 1e-6, "{}", found.p());
    }

    #[test]
    fn small_cells_are_pooled() {
        let found = ChiSquare::new(&[0, 100, 9, 1], &[4.0, 100.0, 0.0, 6.0]);
        assert_eq!(found.freedom, 1);
        assert_eq!(found.statistic, 0.0);
    }

    #[test]
    fn a_single_cell_says_nothing() {
        assert_eq!(ChiSquare::new(&[7], &[7.0]).p(), 1.0);
    }
}
