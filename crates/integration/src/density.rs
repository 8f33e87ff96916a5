//! Probability densities of points.

use crate::domain::Domain;

/// A point of the domain of a density.
pub type Point<P> = <<P as Density>::Domain as Domain>::Point;

/// A probability density over a domain, and how points are drawn from it.
///
/// The two must agree: drawn points have the density p. Arrays, vectors and pairs of densities are densities of
/// independent coordinates, the product of their parts.
pub trait Density {
    /// What it is a density on, and per unit of which measure.
    type Domain: Domain;

    /// Random numbers that a point takes.
    fn dimension(&self) -> usize;

    /// A point x with density p, from as many ξ in (0, 1) as [`dimension`](Self::dimension) says.
    fn sample(&self, xi: &[f64]) -> Point<Self>;

    /// p(x), per unit of the domain's measure; zero where no points are drawn.
    fn pdf(&self, x: &Point<Self>) -> f64;
}

/// The same density everywhere in the domain, p = 1/μ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniform<D>(pub D);

impl<D: Domain> Density for Uniform<D> {
    type Domain = D;

    fn dimension(&self) -> usize {
        self.0.dimension()
    }

    fn sample(&self, xi: &[f64]) -> D::Point {
        self.0.at(xi)
    }

    fn pdf(&self, x: &D::Point) -> f64 {
        if self.0.contains(x) { 1.0 / self.0.measure() } else { 0.0 }
    }
}
