//! The two ways to write the light that x receives. Same files, same shape: read them side by side.

mod area;
mod hemisphere;

pub use area::Area;
pub use hemisphere::Hemisphere;

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Real;
use twoforms_geometry::segment::SurfacePoint;
use twoforms_geometry::view::Vantage;

use crate::measure::{Integrand, Measure};
use crate::query::Query;

/// Which integral is written.
pub trait Formulation {
    /// What it is taken over.
    type Measure: Measure;

    /// Its name in strategies: the word before the slash.
    const NAME: &'static str;

    /// The integrand at a point of the domain.
    fn integrand<R: Real>(
        from: &Vantage<R>,
        query: &Query,
        at: &<Self::Measure as Measure>::Point<R>,
    ) -> Integrand<Self::Measure, R>;

    /// The point of a light that x sees at a point of the domain, if it does: what the integrand values.
    fn seen<R: Real>(from: &Vantage<R>, at: &<Self::Measure as Measure>::Point<R>) -> Masked<SurfacePoint<R>, R>;

    /// Where the integrand asks for a ray: vp or V.
    fn asks<R: Real>(at: &<Self::Measure as Measure>::Point<R>) -> R::Mask;
}
