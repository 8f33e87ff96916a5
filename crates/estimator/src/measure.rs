//! Measures, in types: a density per solid angle and a density per area are different things.
//!
//! `Integrand<M> / Pdf<M>` is a radiance (or an irradiance, where f_r = 1) only when both carry the same measure; any
//! other quotient does not compile:
//!
//! ```compile_fail
//! use twoforms_estimator::measure::{Integrand, Pdf, SolidAngle, SurfaceArea};
//! use twoforms_estimator::rgb::Rgb;
//! let per_area = Integrand::<SurfaceArea, f32>::new(Rgb::splat([1.0; 3]));
//! let per_solid_angle = Pdf::<SolidAngle, f32>::new(0.5);
//! let mixed = per_area / per_solid_angle;
//! ```
//!
//! ```
//! use twoforms_estimator::measure::{Integrand, Pdf, SurfaceArea};
//! use twoforms_estimator::rgb::Rgb;
//! let per_area = Integrand::<SurfaceArea, f32>::new(Rgb::splat([1.0; 3]));
//! let quotient = per_area / Pdf::<SurfaceArea, f32>::new(0.5);
//! assert_eq!(quotient, Rgb::splat([2.0; 3]));
//! ```

use std::fmt::Debug;
use std::marker::PhantomData;
use std::ops::Div;

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::{Mask, Real, Word};
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::vector::Direction;
use twoforms_geometry::view::Vantage;

use crate::rgb::Rgb;

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::SolidAngle {}
    impl Sealed for super::SurfaceArea {}
}

/// What an integral is taken over.
pub trait Measure: sealed::Sealed + Copy + Debug {
    /// A point of the domain.
    type Point<R: Real>: Copy;
    /// The differential, as formulas write it.
    const SYMBOL: &'static str;

    /// The point of the domain at which x comes upon a point y of a light.
    fn point<R: Real>(y: &SurfacePoint<R>, xy: &Segment<R>) -> Self::Point<R>;

    /// The same density per solid angle, at a point of the domain where x comes upon y.
    fn per_solid_angle<R: Real>(pdf: Pdf<Self, R>, xy: &Segment<R>) -> Pdf<SolidAngle, R>;
}

/// Solid angle at x: dω_Ψ, in steradian, over the hemisphere around N_x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SolidAngle;

/// Surface area: dA_y, in square metres, over the targets of all lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SurfaceArea;

impl Measure for SolidAngle {
    type Point<R: Real> = Aim<R>;
    const SYMBOL: &'static str = "dω_Ψ";

    /// Ψ from x to y.
    #[inline(always)]
    fn point<R: Real>(y: &SurfacePoint<R>, xy: &Segment<R>) -> Aim<R> {
        Aim { psi: xy.psi, target: y.target, alone: true }
    }

    #[inline(always)]
    fn per_solid_angle<R: Real>(pdf: Pdf<Self, R>, _: &Segment<R>) -> Pdf<SolidAngle, R> {
        pdf
    }
}

impl Measure for SurfaceArea {
    type Point<R: Real> = SurfacePoint<R>;
    const SYMBOL: &'static str = "dA_y";

    /// y itself.
    #[inline(always)]
    fn point<R: Real>(y: &SurfacePoint<R>, _: &Segment<R>) -> SurfacePoint<R> {
        *y
    }

    #[inline(always)]
    fn per_solid_angle<R: Real>(pdf: Pdf<Self, R>, xy: &Segment<R>) -> Pdf<SolidAngle, R> {
        pdf.per_solid_angle(xy)
    }
}

/// A direction Ψ, and what it is aimed at.
///
/// A direction can meet several lights, and a density of points on lights gives one direction several densities. Aimed
/// at the target that y was drawn on, each point stands for itself: the integral is the sum over targets k of the
/// integrals over the directions in which vp(x, Ψ) lies on k.
#[derive(Clone, Copy, Debug)]
pub struct Aim<R: Real> {
    /// Ψ.
    pub psi: Direction<R>,
    /// The target that it is aimed at, or [`ANYWHERE`].
    pub target: R::Word,
    /// Whether that target is the only one that counts. Where it is not, any light does; but of a direction that meets none,
    /// being rounded beside a small light, the target still counts where nothing stands before it.
    pub alone: bool,
}

/// Aimed at no target in particular: whatever light Ψ meets counts.
pub const ANYWHERE: u32 = u32::MAX;

impl<R: Real> Aim<R> {
    /// A direction for which any light counts.
    #[inline(always)]
    pub fn anywhere(psi: Direction<R>) -> Self {
        Self { psi, target: R::Word::splat(ANYWHERE), alone: false }
    }

    /// y = vp(x, Ψ); of a direction aimed at a target, only where y lies on it. A density aims all its samples or none.
    #[inline(always)]
    pub fn vp(&self, from: &Vantage<R>) -> Masked<SurfacePoint<R>, R> {
        let aimed = !R::same(self.target, R::Word::splat(ANYWHERE));
        if self.alone && aimed.any() {
            return from.vp_on(self.target, self.psi);
        }
        let (y, found) = from.vp(self.psi).parts();
        let missed = from.wanted() & aimed & !found;
        if !missed.any() {
            return Masked::new(y, found);
        }
        let target = R::select_word(aimed, self.target, R::Word::splat(0));
        let (beside, seen) = from.only(missed).vp_on(target, self.psi).parts();
        Masked::new(SurfacePoint::select(found, &y, &beside), found | (missed & seen))
    }
}

/// A probability density per unit of the measure M: 1/sr or 1/m².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pdf<M, R>(R, PhantomData<M>);

impl<M: Measure, R: Real> Pdf<M, R> {
    /// A density of this value.
    #[inline(always)]
    pub fn new(value: R) -> Self {
        Self(value, PhantomData)
    }

    /// Its value.
    #[inline(always)]
    pub fn value(self) -> R {
        self.0
    }
}

impl<R: Real> Pdf<SurfaceArea, R> {
    /// p(Ψ) = p(y) dA/dω = p(y) r² / cosθ_y: the same points, counted per solid angle.
    #[inline(always)]
    pub fn per_solid_angle(self, xy: &Segment<R>) -> Pdf<SolidAngle, R> {
        Pdf::new(self.0 / xy.d_omega_d_area())
    }
}

impl<R: Real> Pdf<SolidAngle, R> {
    /// p(y) = p(Ψ) dω/dA = p(Ψ) cosθ_y / r²: the same points, counted per area.
    #[inline(always)]
    pub fn per_area(self, xy: &Segment<R>) -> Pdf<SurfaceArea, R> {
        Pdf::new(self.0 * xy.d_omega_d_area())
    }
}

/// The value of an integrand per unit of the measure M, RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integrand<M, R>(Rgb<R>, PhantomData<M>);

impl<M: Measure, R: Real> Integrand<M, R> {
    /// An integrand of this value.
    #[inline(always)]
    pub fn new(value: Rgb<R>) -> Self {
        Self(value, PhantomData)
    }

    /// Its value.
    #[inline(always)]
    pub fn value(self) -> Rgb<R> {
        self.0
    }
}

/// f/p: what one sample is worth.
impl<M: Measure, R: Real> Div<Pdf<M, R>> for Integrand<M, R> {
    type Output = Rgb<R>;
    #[inline(always)]
    fn div(self, p: Pdf<M, R>) -> Rgb<R> {
        self.0 * (R::one() / p.0)
    }
}

/// A point drawn from a density, with the density there.
#[derive(Clone, Copy, Debug)]
pub struct Sample<M: Measure, R: Real> {
    /// Where.
    pub at: M::Point<R>,
    /// p there.
    pub pdf: Pdf<M, R>,
}
