//! The area formulation: over the points y of the lights.
//!
//! L(x→Θ) = ∫_A L_e(y→−Ψ) f_r(x, Ψ↔Θ) G(x, y) V(x, y) dA_y,   G(x, y) = cosθ_x cosθ_y / r²
//!
//! (Dutré, Bala, Bekaert, "Advanced Global Illumination", section 2.6: the area formulation, first bounce.)

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Real;
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::view::Vantage;

use super::Formulation;
use crate::measure::{Integrand, SurfaceArea};
use crate::query::Query;

/// Integrates over points of the lights; a ray tests V.
#[derive(Clone, Copy, Debug)]
pub struct Area;

impl Formulation for Area {
    type Measure = SurfaceArea;

    const NAME: &'static str = "area";

    /// L_e(y→−Ψ) f_r(x, Ψ↔Θ) G(x, y) V(x, y)
    #[inline(always)]
    fn integrand<R: Real>(from: &Vantage<R>, query: &Query, y: &SurfacePoint<R>) -> Integrand<SurfaceArea, R> {
        let xy = Segment::to(y);
        Integrand::new(query.l_e(from, Self::seen(from, y)) * query.f_r(from, xy.psi) * xy.g())
    }

    /// y itself, where V(x, y) = 1.
    #[inline(always)]
    fn seen<R: Real>(from: &Vantage<R>, y: &SurfacePoint<R>) -> Masked<SurfacePoint<R>, R> {
        Masked::new(*y, from.visible(y, Segment::to(y).facing()))
    }

    /// V is asked for only where x and y face each other.
    #[inline(always)]
    fn asks<R: Real>(y: &SurfacePoint<R>) -> R::Mask {
        Segment::to(y).facing()
    }
}
