//! What is asked of the light at x.

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Real;
use twoforms_geometry::segment::SurfacePoint;

use crate::lights::Lights;
use crate::rgb::Rgb;

/// The lights, and how x answers to what arrives.
#[derive(Clone, Copy, Debug)]
pub struct Query<'l> {
    lights: &'l Lights,
    f_r: [f32; 3],
}

impl<'l> Query<'l> {
    /// Irradiance: f_r = 1, so that the integral is ∫ L_e cosθ_x dω.
    pub fn irradiance(lights: &'l Lights) -> Self {
        Self { lights, f_r: [1.0; 3] }
    }

    /// Radiance from a Lambertian surface of this albedo: f_r = ρ/π, in 1/sr.
    pub fn radiance(lights: &'l Lights, albedo: [f32; 3]) -> Self {
        Self { lights, f_r: albedo.map(|rho| rho * std::f32::consts::FRAC_1_PI) }
    }

    /// The lights.
    pub fn lights(&self) -> &'l Lights {
        self.lights
    }

    /// f_r(x, Ψ↔Θ): the same for all directions on a Lambertian surface.
    #[inline(always)]
    pub fn f_r<R: Real>(&self) -> Rgb<R> {
        Rgb::splat(self.f_r)
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
