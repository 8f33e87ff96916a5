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

/// A density by reference.
impl<P: Density + ?Sized> Density for &P {
    type Domain = P::Domain;

    fn dimension(&self) -> usize {
        (**self).dimension()
    }

    fn sample(&self, xi: &[f64]) -> Point<P> {
        (**self).sample(xi)
    }

    fn pdf(&self, x: &Point<P>) -> f64 {
        (**self).pdf(x)
    }
}

/// A density that is chosen at run time.
///
/// ```
/// use twoforms_integration::{Estimator, Interval, Line, Linear, Power, Uniform, Variable};
///
/// let interval = Interval::new(0.0, 4.0)?;
/// let densities: [Box<dyn Line<Domain = Interval>>; 3] = [
///     Box::new(Power::new(interval, 1.0)?),
///     Box::new(Uniform(interval)),
///     Box::new(Linear::new(interval, [2.0, 6.0])?),
/// ];
/// let mut variances = Vec::new();
/// for p in densities {
///     variances.push(format!("{:.1}", Estimator::new(|x| x, p).exact(1e-10)?.variance));
/// }
/// assert_eq!(variances, ["0.0", "21.3", "6.3"]);
/// # Ok::<(), twoforms_integration::Error>(())
/// ```
impl<P: Density + ?Sized> Density for Box<P> {
    type Domain = P::Domain;

    fn dimension(&self) -> usize {
        (**self).dimension()
    }

    fn sample(&self, xi: &[f64]) -> Point<P> {
        (**self).sample(xi)
    }

    fn pdf(&self, x: &Point<P>) -> f64 {
        (**self).pdf(x)
    }
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
