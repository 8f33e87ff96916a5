//! Samples counted by cell.

use twoforms_estimator::density::Density;
use twoforms_estimator::measure::{Measure, Pdf, Sample};
use twoforms_geometry::view::View;

use super::Domain;
use crate::samples::Samples;
use crate::statistics::ChiSquare;

/// χ² of samples, counted by cell, against the integrals of their density over the cells. Samples that are none have a
/// cell of their own, the last, where what is left of one by the domain's mass is expected: patches know it no better than they
/// resolve the density.
pub fn chi_square<M: Measure, D: Density<M>>(
    view: &View,
    density: &D,
    domain: &impl Domain<M>,
    draws: &Samples,
) -> ChiSquare {
    let (none, n) = (domain.cells(), f64::from(draws.n));
    let mut observed = vec![0; none + 1];
    for index in 0..draws.n {
        let (Sample { at, .. }, some) = density.sample::<f32>(&view.from_x(), draws.xi(index)).parts();
        observed[if some { domain.cell_of(&at) } else { none }] += 1;
    }
    let mut expected = vec![0.0; none + 1];
    for patch in domain.patches() {
        expected[patch.cell] += n * value(density, view, &patch.at) * patch.measure;
    }
    // What lies below zero is rounding.
    expected[none] = n * (1.0 - domain.mass()).max(0.0);
    ChiSquare::new(&observed, &expected)
}

/// p at a point; zero where no sample falls.
pub fn value<M: Measure, D: Density<M>>(density: &D, view: &View, at: &M::Point<f32>) -> f64 {
    density.pdf::<f32>(&view.from_x(), at).map(Pdf::value).or_zero().into()
}
