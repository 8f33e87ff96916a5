//! What is asked of the light at x.

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Real;
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::vector::Direction;
use twoforms_geometry::view::{Vantage, View};

use crate::glossy::Glossy;
use crate::lights::Lights;
use crate::rgb::Rgb;

/// The lights, and how x answers to what arrives.
#[derive(Clone, Copy, Debug)]
pub struct Query<'l> {
    lights: &'l Lights,
    surface: Surface,
}

/// f_r at x.
#[derive(Clone, Copy, Debug)]
enum Surface {
    /// The same for all directions: 1, or ρ/π.
    Constant([f32; 3]),
    /// A highlight, which depends on Ψ and on where the eye is.
    Glossy(Glossy),
}

impl<'l> Query<'l> {
    /// Irradiance: f_r = 1, so that the integral is ∫ L_e cosθ_x dω.
    pub fn irradiance(lights: &'l Lights) -> Self {
        Self { lights, surface: Surface::Constant([1.0; 3]) }
    }

    /// Radiance from a Lambertian surface of this albedo: f_r = ρ/π, in 1/sr.
    pub fn radiance(lights: &'l Lights, albedo: [f32; 3]) -> Self {
        Self { lights, surface: Surface::Constant(albedo.map(|rho| rho * std::f32::consts::FRAC_1_PI)) }
    }

    /// Radiance toward the eye from a surface with a highlight.
    pub fn glossy_radiance(lights: &'l Lights, glossy: Glossy) -> Self {
        Self { lights, surface: Surface::Glossy(glossy) }
    }

    /// The surface at x, if it has a highlight.
    pub fn glossy(&self) -> Option<&Glossy> {
        match &self.surface {
            Surface::Constant(_) => None,
            Surface::Glossy(glossy) => Some(glossy),
        }
    }

    /// The lights.
    pub fn lights(&self) -> &'l Lights {
        self.lights
    }

    /// f_r(x, Ψ↔Θ).
    #[inline(always)]
    pub fn f_r<R: Real>(&self, from: &Vantage<R>, psi: Direction<R>) -> Rgb<R> {
        match &self.surface {
            Surface::Constant(f_r) => Rgb::splat(*f_r),
            Surface::Glossy(glossy) => glossy.f_r(from.start(), psi),
        }
    }

    /// L_e(y→−Ψ) f_r(x, Ψ↔Θ) cosθ_x: what arrives from a point y that x sees, per solid angle.
    #[inline(always)]
    pub fn received<R: Real>(&self, from: &Vantage<R>, y: &SurfacePoint<R>, xy: &Segment<R>) -> Rgb<R> {
        self.l_e(Masked::all(*y)) * self.f_r(from, xy.psi) * xy.cos_x
    }

    /// Luminance of L_e(y→−Ψ) f_r(x, Ψ↔Θ) G(x, y): what y would contribute per area were nothing in between.
    #[inline(always)]
    pub fn unhidden<R: Real>(&self, from: &Vantage<R>, y: &SurfacePoint<R>) -> R {
        let xy = Segment::to(y);
        let light = self.l_e(Masked::new(*y, xy.facing())) * self.f_r(from, xy.psi) * xy.g();
        light.or_black(xy.facing()).luminance()
    }

    /// What x would receive were nothing in between: Σ_k L_k f_r ∫ cosθ_x dω over each target, RGB. None where f_r is not the
    /// same for all directions: no closed form is known then.
    pub fn unoccluded(&self, view: &View) -> Option<[f64; 3]> {
        let Surface::Constant(f_r) = self.surface else { return None };
        let mut sum = [0.0; 3];
        for (k, open) in self.lights.unoccluded(view).into_iter().enumerate() {
            let l_e = self.lights.radiance(k as u32);
            sum = std::array::from_fn(|c| sum[c] + open * f64::from(l_e[c]) * f64::from(f_r[c]));
        }
        Some(sum)
    }

    /// L_e(y→−Ψ), constant over a light; black where there is no y.
    #[inline(always)]
    pub fn l_e<R: Real>(&self, y: Masked<SurfacePoint<R>, R>) -> Rgb<R> {
        let (y, some) = y.parts();
        let l_e = R::gather(
            y.target,
            #[inline(always)]
            |k| self.lights.radiance(k),
        );
        Rgb(l_e).or_black(some)
    }
}
