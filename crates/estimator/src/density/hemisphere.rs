//! Directions over the hemisphere around N_x.

use std::f32::consts::{FRAC_1_PI, TAU};

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Real;
use twoforms_geometry::vector::Direction;
use twoforms_geometry::view::{Vantage, View};

use super::{Density, Ready};
use crate::lights::Lights;
use crate::measure::{Aim, Pdf, Sample, SolidAngle};
use crate::query::Query;
use crate::selection::Selection;
use crate::xi::Xi;

/// p(Ψ) = 1/2π.
#[derive(Clone, Copy, Debug)]
pub struct UniformHemisphere;

/// p(Ψ) = cosθ/π.
#[derive(Clone, Copy, Debug)]
pub struct CosineHemisphere;

impl Density<SolidAngle> for UniformHemisphere {
    /// cosθ = u, φ = 2πv.
    #[inline(always)]
    fn sample<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SolidAngle, R>, R> {
        let [u, v] = xi.uv();
        let sin_theta = ((R::one() - u) * (R::one() + u)).sqrt();
        drawn(self, from, Direction::polar(u, sin_theta, v))
    }

    #[inline(always)]
    fn pdf<R: Real>(&self, _: &Vantage<R>, aim: &Aim<R>) -> Masked<Pdf<SolidAngle, R>, R> {
        Masked::new(Pdf::new(R::splat(1.0 / TAU)), R::zero().lt(aim.psi.cos_theta()))
    }
}

impl Density<SolidAngle> for CosineHemisphere {
    /// cosθ = √u, φ = 2πv.
    #[inline(always)]
    fn sample<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SolidAngle, R>, R> {
        let [u, v] = xi.uv();
        drawn(self, from, Direction::polar(u.sqrt(), (R::one() - u).sqrt(), v))
    }

    #[inline(always)]
    fn pdf<R: Real>(&self, _: &Vantage<R>, aim: &Aim<R>) -> Masked<Pdf<SolidAngle, R>, R> {
        let cos_theta = aim.psi.cos_theta();
        Masked::new(Pdf::new(cos_theta * R::splat(FRAC_1_PI)), R::zero().lt(cos_theta))
    }
}

#[inline(always)]
fn drawn<R: Real>(
    density: &impl Density<SolidAngle>,
    from: &Vantage<R>,
    psi: Direction<R>,
) -> Masked<Sample<SolidAngle, R>, R> {
    let at = Aim::anywhere(psi);
    density.pdf(from, &at).map(|pdf| Sample { at, pdf })
}

/// Densities of directions that are the same for every scene and x.
macro_rules! ready_everywhere {
    ($($density:ident),*) => {$(
        impl Ready for $density {
            type Measure = SolidAngle;
            type At<'a> = Self;

            fn prepare(_: &Lights, _: Selection) -> Self {
                Self
            }

            fn depends_on_x(&self) -> bool {
                false
            }

            fn at(&self, _: &View, _: &Query) -> Self {
                *self
            }
        }
    )*};
}
ready_everywhere!(UniformHemisphere, CosineHemisphere);
