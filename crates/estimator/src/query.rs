//! What is asked of the light at x.

use glam::DVec3;
use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::{Mask, Real};
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::vector::Direction;
use twoforms_geometry::view::{Vantage, View};

use crate::alone;
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
            Surface::Glossy(glossy) => glossy.f_r(from.footprint(), psi),
        }
    }

    /// L_e(y→−Ψ) f_r(x, Ψ↔Θ) cosθ_x: what arrives from a point y that x sees, per solid angle.
    #[inline(always)]
    pub fn received<R: Real>(&self, from: &Vantage<R>, y: Masked<SurfacePoint<R>, R>, xy: &Segment<R>) -> Rgb<R> {
        self.l_e(from, y) * self.f_r(from, xy.psi) * xy.cos_x
    }

    /// Luminance of L_e(y→−Ψ) f_r(x, Ψ↔Θ) G(x, y): what y would contribute per area were nothing in between.
    #[inline(always)]
    pub fn unhidden<R: Real>(&self, from: &Vantage<R>, y: &SurfacePoint<R>) -> R {
        let xy = Segment::to(y);
        let light = self.l_e(from, Masked::new(*y, xy.facing())) * self.f_r(from, xy.psi) * xy.g();
        light.or_black(xy.facing()).luminance()
    }

    /// What x would receive were nothing in between: Σ_k L_k f_r ∫ cosθ_x dω over each target, RGB, with L_k the mean of L_e
    /// over the target. None where f_r is not the same for all directions: no closed form is known then.
    pub fn unoccluded(&self, view: &View) -> Option<[f64; 3]> {
        let Surface::Constant(f_r) = self.surface else { return None };
        let mut sum = [0.0; 3];
        for (k, open) in self.lights.unoccluded(view).into_iter().enumerate() {
            let l_e = self.lights.radiance(k as u32);
            sum = std::array::from_fn(|c| sum[c] + open * f64::from(l_e[c]) * f64::from(f_r[c]));
        }
        Some(sum)
    }

    /// L_e(y→−Ψ), looked up at y where lights emit by textures, times what passes surfaces in between that are not opaque; black
    /// where there is no y.
    #[inline(always)]
    pub fn l_e<R: Real>(&self, from: &Vantage<R>, y: Masked<SurfacePoint<R>, R>) -> Rgb<R> {
        if self.varies::<R>() { looked_up(self.lights, *from, y) } else { self.mean_l_e(y) }
    }

    /// Whether L_e must be looked up at every point. What is looked up one by one is computed one by one: where lights vary,
    /// estimators run in scalar numbers, so that lanes need not ask.
    #[inline(always)]
    pub(crate) fn varies<R: Real>(&self) -> bool {
        R::LANES == 1 && self.lights.vary()
    }

    /// The mean of L_e over the target that y lies on; black where there is no y.
    #[inline(always)]
    pub fn mean_l_e<R: Real>(&self, y: Masked<SurfacePoint<R>, R>) -> Rgb<R> {
        let (y, some) = y.parts();
        let l_e = R::gather(
            y.target,
            #[inline(always)]
            |k| self.lights.radiance(k),
        );
        Rgb(l_e).or_black(some)
    }
}

/// L_e at y and what passes of it, in binary64 up to the look-up; black where there is no y. For samples one by one.
#[cold]
#[inline(never)]
fn looked_up<R: Real>(lights: &Lights, from: Vantage<R>, y: Masked<SurfacePoint<R>, R>) -> Rgb<R> {
    R::apart(
        #[inline(always)]
        || {
            let (y, some) = y.parts();
            if !some.any() {
                return Rgb::splat([0.0; 3]);
            }
            let [start, toward] = [from.start(), y.position].map(alone::coordinates);
            Rgb::splat(arriving(lights, from.view(), alone::word::<R>(y.target), start, toward))
        },
    )
}

/// What arrives at `start` from the point of a target that lies `toward` from there, in the frame of x.
fn arriving(lights: &Lights, view: &View, target: u32, start: [f32; 3], toward: [f32; 3]) -> [f32; 3] {
    let [from, way] = [start, toward].map(|v| DVec3::from_array(v.map(f64::from)));
    let frame = view.frame();
    let l_e = lights.radiance_at(target, frame.x() + frame.to_world(from + way));
    if !view.geometry().is_veiled() {
        return l_e;
    }
    let passing = view.passing(start, toward, target) as f32;
    l_e.map(|channel| channel * passing)
}
