//! Surfaces with a highlight: glTF 2.0's metals and dielectrics (appendix B of its specification).
//!
//! f_r = (1 − m) mix(diffuse, specular, F_d) + m F_m specular, m the share of metal, with
//!
//! - diffuse = base/π and specular = D V, D the distribution of Trowbridge and Reitz (GGX), α = roughness²:
//!   D = α² / (π ((N·H)² (α² − 1) + 1)²),
//! - V = G / (4 cosθ_i cosθ_o) with Smith's masking and shadowing of correlated heights (Heitz 2014, "Understanding the
//!   masking-shadowing function in microfacet-based BRDFs", equation 99):
//!   V = 1 / (2 (cosθ_o s(Ψ) + cosθ_i s(Θ))), s(v) = √(α² + (1 − α²) (N·v)²),
//! - F by Schlick (1994): F = F_0 + (1 − F_0)(1 − Θ·H)⁵; F_0 of a dielectric is some 0.04, that of a metal its base colour.
//!
//! By `KHR_materials_specular` the dielectric's specular part has a weight w and F_0 a colour: mix(diffuse, specular, F_d) is
//! (1 − w max F_d) diffuse + w F_d specular.
//!
//! Its own density mixes directions mirrored at visible normals (Heitz 2018, "Sampling the GGX distribution of visible
//! normals"), p = D / (2 (cosθ_o + s(Θ))), with cosθ/π.

use std::f64::consts::PI;

use twoforms_geometry::number::Number;
use twoforms_geometry::real::{Real, at_least};
use twoforms_geometry::vector::{Direction, Vector};

use crate::rgb::{Rgb, luminance};

/// A surface as glTF's metallic-roughness material makes it, RGB where three numbers stand.
///
/// Schlick's F goes from F_0 head-on to 1 at grazing angles, and all that is diffuse or specular goes along in a straight line:
/// so each is held at the two ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicRoughness {
    /// What D V is multiplied with, head-on and at grazing angles.
    specular: [[f32; 3]; 2],
    /// What is added, head-on and at grazing angles, per steradian.
    diffuse: [[f32; 3]; 2],
    /// α = roughness².
    alpha: f32,
    /// Luminance of what is specular head-on, how much more it is at grazing angles, and that of what is diffuse times π.
    bright: [f32; 3],
}

/// What a surface is made of: glTF's parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Makeup {
    /// Base colour, linear RGB.
    pub base: [f32; 3],
    /// m: how far it is a metal, in [0, 1].
    pub metallic: f32,
    /// Perceptual roughness, above 0 and at most 1.
    pub roughness: f32,
    /// w: how much of a dielectric's highlight there is, in [0, 1].
    pub specular: f32,
    /// F_0 of the dielectric, RGB, in [0, 1].
    pub f_0: [f32; 3],
}

/// The mean of (1 − cosθ)⁵ by cosθ/π: how far Fresnel's reflection rises over a hemisphere.
const MEAN_RISE: f64 = 1.0 / 21.0;

impl MetallicRoughness {
    /// The surface that is made so.
    pub fn new(makeup: &Makeup) -> Self {
        let [metallic, roughness, w] = [makeup.metallic, makeup.roughness, makeup.specular].map(f64::from);
        let (base, f_0) = (makeup.base.map(f64::from), makeup.f_0.map(f64::from));
        let mix = |dielectric: f64, metal: f64| ((1.0 - metallic) * dielectric + metallic * metal) as f32;
        let covered = w * f_0.into_iter().fold(0.0, f64::max);
        let under = |covered: f64| base.map(|base| mix((1.0 - covered) * base / PI, 0.0));
        let specular = [[0, 1, 2].map(|c| mix(w * f_0[c], base[c])), [mix(w, 1.0); 3]];
        let diffuse = [under(covered), under(w)];
        let bright = |rgb: [f32; 3]| luminance(rgb.map(f64::from));
        let [head_on, grazing] = specular.map(bright);
        let bright = [head_on, grazing - head_on, bright(diffuse[0]) * PI].map(|luminance| luminance as f32);
        Self { specular, diffuse, alpha: (roughness * roughness) as f32, bright }
    }

    /// α = roughness²: how wide the highlight is, in radian of the normal of the mirror that would show it.
    pub fn alpha(&self) -> f64 {
        f64::from(self.alpha)
    }

    /// f_r(x, Ψ↔Θ), RGB, in 1/sr, of unit vectors above the horizon in the frame of x.
    #[inline(always)]
    pub fn f_r<N: Number>(&self, theta: [N; 3], psi: [N; 3]) -> [N; 3] {
        let number = N::number;
        let half = Half::new(theta, psi);
        let shadowing = theta[2] * self.spread(psi) + psi[2] * self.spread(theta);
        let d_v = half.distribution(self) / (number(2.0) * shadowing);
        let w = number(1.0) - half.cos_theta_d();
        let rise = (w * w) * (w * w) * w;
        let mut f_r = [number(0.0); 3];
        for c in 0..3 {
            f_r[c] = between(&self.diffuse, c, rise) + between(&self.specular, c, rise) * d_v;
        }
        f_r
    }

    /// p(Ψ) = A D / (2 (cosθ_o + s(Θ))) + (1 − A) cosθ_i/π, in 1/sr, with A = [`MetallicRoughness::share`].
    #[inline(always)]
    pub fn pdf<N: Number>(&self, theta: [N; 3], psi: [N; 3]) -> N {
        let number = N::number;
        let share = self.share(theta);
        let mirrored = Half::new(theta, psi).distribution(self) / (number(2.0) * (theta[2] + self.spread(theta)));
        share * mirrored + (number(1.0) - share) * (psi[2] * number(1.0 / PI))
    }

    /// A: the share of directions that are mirrored at visible normals: that of what is specular in all that is reflected, by
    /// luminance, where the specular part rises from head-on with Fresnel at θ_o, and by at least the mean of that rise, so that
    /// no highlight is left out.
    #[inline(always)]
    pub fn share<N: Number>(&self, theta: [N; 3]) -> N {
        let number = N::number;
        let [head_on, more, diffuse] = self.bright;
        let w = number(1.0) - theta[2];
        let rise = number(MEAN_RISE) + (w * w) * (w * w) * w * number(1.0 - MEAN_RISE);
        let specular = number(f64::from(head_on)) + number(f64::from(more)) * rise;
        specular / (specular + number(f64::from(diffuse)))
    }

    /// s(v) = √(α² + (1 − α²) (N·v)²), of a unit vector.
    #[inline(always)]
    fn spread<N: Number>(&self, [x, y, z]: [N; 3]) -> N {
        let alpha = N::number(f64::from(self.alpha));
        ((x * x + y * y) * (alpha * alpha) + z * z).root()
    }
}

/// From the value head-on to that at grazing angles.
#[inline(always)]
fn between<N: Number>(ends: &[[f32; 3]; 2], c: usize, rise: N) -> N {
    let [head_on, grazing] = [f64::from(ends[0][c]), f64::from(ends[1][c])];
    N::number(head_on) + N::number(grazing - head_on) * rise
}

/// H |Θ + Ψ|: the vector half way between two directions, not of unit length.
struct Half<N> {
    h: [N; 3],
    /// |Θ + Ψ|².
    square: N,
}

impl<N: Number> Half<N> {
    #[inline(always)]
    fn new(theta: [N; 3], psi: [N; 3]) -> Self {
        let h = [theta[0] + psi[0], theta[1] + psi[1], theta[2] + psi[2]];
        Self { h, square: h[0] * h[0] + h[1] * h[1] + h[2] * h[2] }
    }

    /// Θ·H = |Θ + Ψ|/2.
    #[inline(always)]
    fn cos_theta_d(&self) -> N {
        N::number(0.5) * self.square.root()
    }

    /// D = α² / (π (sin²θ_h + α² cos²θ_h)²): where α is small, the sum holds the digits that 1 − cos²θ_h loses.
    #[inline(always)]
    fn distribution(&self, surface: &MetallicRoughness) -> N {
        let alpha2 = N::number(surface.alpha()) * N::number(surface.alpha());
        let [x, y, z] = self.h;
        let sum = (x * x + y * y + z * z * alpha2) / self.square;
        alpha2 * N::number(1.0 / PI) / (sum * sum)
    }
}

/// A surface with a highlight, and the eye that looks at it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glossy {
    surface: MetallicRoughness,
    /// The eye, in metres in the frame of x.
    eye: [f32; 3],
}

impl Glossy {
    /// The surface as an eye sees it that stands above it: metres, in the frame of x.
    pub fn new(surface: MetallicRoughness, eye: [f32; 3]) -> Self {
        Self { surface, eye }
    }

    /// The surface.
    pub fn surface(&self) -> &MetallicRoughness {
        &self.surface
    }

    /// Θ at points of a footprint, or at x.
    #[inline(always)]
    pub fn theta<R: Real>(&self, start: Option<Vector<R>>) -> Vector<R> {
        let eye = Vector::splat(self.eye);
        let toward = match start {
            Some(start) => eye - start,
            None => eye,
        };
        toward * (R::one() / toward.length())
    }

    /// f_r(x, Ψ↔Θ). Cold, so that the loop over samples keeps its state in registers where there is no highlight.
    #[cold]
    #[inline(never)]
    pub(crate) fn f_r<R: Real>(&self, start: Option<Vector<R>>, psi: Direction<R>) -> Rgb<R> {
        R::apart(
            #[inline(always)]
            || Rgb(self.surface.f_r(self.theta(start).to_array(), psi.vector().to_array())),
        )
    }

    /// p(Ψ), for directions above the horizon.
    #[inline(never)]
    pub(crate) fn pdf<R: Real>(&self, start: Option<Vector<R>>, psi: Direction<R>) -> R {
        R::apart(
            #[inline(always)]
            || self.surface.pdf(self.theta(start).to_array(), psi.vector().to_array()),
        )
    }

    /// The direction that two uniform numbers draw; those mirrored at visible normals may lie below the horizon.
    #[inline(never)]
    pub(crate) fn direction<R: Real>(&self, start: Option<Vector<R>>, [u, v]: [R; 2]) -> Direction<R> {
        R::apart(
            #[inline(always)]
            || {
                let theta = self.theta(start);
                let share = self.surface.share(theta.to_array());
                let mirrored = u.le(share);
                let rest = R::one() - share;
                let u = R::select(mirrored, u / share, (u - share) / rest);
                self.surface.direction(theta, mirrored, [u, v])
            },
        )
    }
}

/// Keeps the length of a vector that is zero by rounding from dividing by zero: then Ψ = −Θ, below the horizon.
const TINY: f32 = 1e-30;

impl MetallicRoughness {
    /// Θ mirrored at a visible normal, or a direction by the cosine.
    ///
    /// Visible normals are those of a hemisphere stretched by α, and there the half vectors of Θ and a direction uniform over
    /// a spherical cap (Dupuy and Benyoub 2023, "Sampling visible GGX normals with spherical caps").
    #[inline(always)]
    fn direction<R: Real>(&self, theta: Vector<R>, mirrored: R::Mask, [u, v]: [R; 2]) -> Direction<R> {
        let alpha = R::splat(self.alpha);
        let two = R::splat(2.0);
        let stretched = Vector::new(theta.x * alpha, theta.y * alpha, theta.z);
        let stretched = stretched * (R::one() / stretched.length());
        // 1 − cosθ over the cap cosθ >= −Θ_z
        let lift = u * (R::one() + stretched.z);
        let cos = R::select(mirrored, R::one() - lift, u.sqrt());
        let sin = R::select(mirrored, at_least(lift * (two - lift), R::zero()), R::one() - u).sqrt();
        let drawn = Direction::polar(cos, sin, v).vector();
        let h = drawn + stretched;
        let normal = Vector::new(h.x * alpha, h.y * alpha, h.z);
        let mirror = normal * (two * theta.dot(normal) / at_least(normal.dot(normal), R::splat(TINY))) - theta;
        let psi = Vector::new(
            R::select(mirrored, mirror.x, drawn.x),
            R::select(mirrored, mirror.y, drawn.y),
            R::select(mirrored, mirror.z, drawn.z),
        );
        Direction::of(psi, R::one())
    }
}
