//! Densities: what points are drawn from, and how. A density knows its measure and nothing of the integrand.

mod hemisphere;
mod lights;

pub use hemisphere::{CosineHemisphere, UniformHemisphere};
pub use lights::{OnLights, TowardLights};

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Real;
use twoforms_geometry::view::Vantage;

use crate::measure::{Measure, Pdf, Sample};
use crate::xi::Xi;

/// A probability density over a measured domain, and a way to draw from it: a pure function of ξ.
pub trait Density<M: Measure> {
    /// Draws a point. No sample is a sample worth zero, and the zero counts.
    fn sample<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<M, R>, R>;

    /// The density at a point; none where no point is ever drawn.
    fn pdf<R: Real>(&self, from: &Vantage<R>, at: &M::Point<R>) -> Masked<Pdf<M, R>, R>;
}
