//! The hemisphere formulation: over the directions Ψ around N_x.
//!
//! L(x→Θ) = ∫_Ω L_e(y→−Ψ) f_r(x, Ψ↔Θ) cosθ_x dω_Ψ,   y = vp(x, Ψ)
//!
//! (Dutré, Bala, Bekaert, "Advanced Global Illumination", section 2.6: the hemispherical formulation, first bounce.)

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::{Mask, Real};
use twoforms_geometry::segment::SurfacePoint;
use twoforms_geometry::view::Vantage;

use super::Formulation;
use crate::measure::{Aim, Integrand, SolidAngle};
use crate::query::Query;

/// Integrates over directions; a ray finds y.
#[derive(Clone, Copy, Debug)]
pub struct Hemisphere;

impl Formulation for Hemisphere {
    type Measure = SolidAngle;

    const NAME: &'static str = "hemisphere";

    /// L_e(y→−Ψ) f_r(x, Ψ↔Θ) cosθ_x
    #[inline(always)]
    fn integrand<R: Real>(from: &Vantage<R>, query: &Query, aim: &Aim<R>) -> Integrand<SolidAngle, R> {
        let cos_x = aim.psi.cos_theta();
        Integrand::new(query.l_e(from, Self::seen(from, aim)) * query.f_r(from, aim.psi) * cos_x)
    }

    /// y = vp(x, Ψ)
    #[inline(always)]
    fn seen<R: Real>(from: &Vantage<R>, aim: &Aim<R>) -> Masked<SurfacePoint<R>, R> {
        aim.vp(from)
    }

    /// Every direction needs its y.
    #[inline(always)]
    fn asks<R: Real>(_: &Aim<R>) -> R::Mask {
        R::Mask::splat(true)
    }
}
