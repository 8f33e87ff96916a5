//! One facet as x sees it, with its moments.

use std::array::from_fn;
use std::sync::OnceLock;

use glam::DVec3;

use crate::cubature::{Integral, guess, integrate};
use crate::error::Error;
use crate::facet::Facet;
use crate::facing::Facing;
use crate::glow::Glow;
use crate::law::Part;
use crate::moments::{Moments, solid_angle_of};
use crate::outline::line_integral;
use crate::value::EPSILON;
use crate::visible::{LIMIT, Pieces, Visible, above_horizon, subtract};
use twoforms_estimator::rgb::luminance;

/// Relative error bound above which an edge sum gives way to cubature.
const TOO_ROUGH: f64 = 1e-11;

/// A facet that emits toward x.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The target it belongs to, by its number in the scene.
    pub target: u32,
    /// The light it belongs to.
    pub light: usize,
    /// L_e f_r toward x, linear RGB; its mean over the target where that emits by a texture.
    pub radiance: [f64; 3],
    /// Luminance of that.
    pub luminance: f64,
    /// Luminance of L_e itself.
    pub emitted: f64,
    /// L_e toward x point by point, where it emits by a texture; `pieces` are then cut along its texels.
    pub glow: Option<Glow>,
    /// What x receives from it, and what it would were nothing in between.
    pub received: [Received; 2],
    /// Area in m², as the scene counts it.
    pub area: f64,
    /// Area of the visible part in m², on the same scale; equal to `area` when all is seen.
    pub visible_area: f64,
    /// Solid angle of the whole facet in sr, whether hidden or below the horizon.
    pub whole_solid_angle: f64,
    /// Moments of the part above the horizon, as if nothing stood before it.
    pub open: Moments,
    /// Moments of the part that x sees.
    pub moments: Moments,
    /// The part that x sees.
    pub pieces: Pieces,
    /// Whether some of the part above the horizon is hidden.
    pub blocked: bool,
    /// Whether some of the facet lies below the horizon.
    pub clipped: bool,
    /// The plane and outline.
    pub facet: Facet,
    /// The corners of the target, in its own order.
    pub corners: Vec<DVec3>,
    /// Spreads by cubature, kept because every selection of lights asks for the same ones.
    pub(crate) cubatures: Cubatures,
}

/// ∫ L_e cosθ_x dω: linear RGB, and a bound of the error of its luminance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Received {
    /// Linear RGB.
    pub rgb: [f64; 3],
    /// Bound of the error of the luminance.
    pub error: f64,
}

/// Results that are computed when first asked for: what a facet adds to the law of an estimator.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cubatures {
    /// Of g under dA.
    pub area: OnceLock<Result<Vec<Part>, Error>>,
    /// Of cosθ_x under dω.
    pub solid_angle: OnceLock<Result<Vec<Part>, Error>>,
    /// Of 1 under cosθ_x dω.
    pub projected_solid_angle: OnceLock<Result<Vec<Part>, Error>>,
    /// Of cosθ_x over the bilinear cosine, under that times dω.
    pub bilinear: OnceLock<Result<Vec<Part>, Error>>,
}

impl Seen {
    /// The facets of one target and what x sees of them.
    ///
    /// # Errors
    /// [`Error::OnLight`], [`Error::TooManyPieces`].
    pub fn facets(facing: &Facing) -> Result<Vec<Self>, Error> {
        let facets = if facing.area > 0.0 { Facet::of(facing)? } else { Vec::new() };
        let whole: f64 = facets.iter().map(|facet| facet.area).sum();
        facets.into_iter().map(|facet| Self::new(facing, facing.area * (facet.area / whole), facet)).collect()
    }

    fn new(facing: &Facing, area: f64, facet: Facet) -> Result<Self, Error> {
        let (outline, clipped) = above_horizon(&facet);
        let Visible { pieces, blocked, amplification } = subtract(&facet, &outline, &facing.blockers)
            .ok_or(Error::TooManyPieces { target: facing.target, blockers: facing.blockers.len(), limit: LIMIT })?;
        let moments = moments_of(&pieces, &facet, amplification);
        let whole = || Pieces::one(&outline);
        let open = if blocked { moments_of(&whole(), &facet, 1.0) } else { moments };
        let (pieces, received) = match &facing.glow {
            None => (pieces, [moments, open].map(|moments| Received::at(facing.radiance, &moments))),
            Some(glow) => {
                let pieces = glow.cut(&pieces, facing.target)?;
                let seen = Received::by_texture(glow, &pieces, &facet, &moments)?;
                let unhidden = || Received::by_texture(glow, &glow.cut(&whole(), facing.target)?, &facet, &open);
                (pieces, [seen, if blocked { unhidden()? } else { seen }])
            }
        };
        let whole_solid_angle = if clipped { solid_angle_of(&facet.corners) } else { open.solid_angle };
        let visible_area = if blocked || clipped { area * (moments.area / facet.area) } else { area };
        Ok(Self {
            target: facing.target,
            light: facing.light as usize,
            radiance: facing.radiance,
            luminance: luminance(facing.radiance),
            emitted: facing.emitted,
            glow: facing.glow.clone(),
            received,
            area,
            visible_area,
            whole_solid_angle,
            open,
            moments,
            pieces,
            blocked,
            clipped,
            facet,
            corners: facing.corners.clone(),
            cubatures: Cubatures::default(),
        })
    }

    /// Whether x sees any of it: more than what rounding leaves of outlines that coincide.
    pub fn is_visible(&self) -> bool {
        self.moments.area > 0.0 && self.moments.solid_angle > 0.0 && self.moments.m10 > 0.0
    }

    /// ∫ L_e² cosᵏθ_x dω over what x sees for k = 1 or 2, with a bound of its error: red, green, blue, luminance.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn squared(&self, k: usize) -> Result<[[f64; 2]; 4], Error> {
        let Some(glow) = &self.glow else {
            let moment = [self.moments.m10, self.moments.m20][k - 1];
            let [r, g, b] = self.radiance;
            return Ok([r, g, b, self.luminance].map(|l| [l * l * moment, l * l * self.moments.errors[k]]));
        };
        let squares = |y: DVec3| {
            let weight = self.g(y) * if k == 2 { y.z / y.length() } else { 1.0 };
            glow.at(y).map(|l| l * l * weight)
        };
        let sum = textured(glow, &self.pieces, &self.facet, &self.moments, squares)?;
        Ok(from_fn(|c| [sum.value[c], sum.error[c]]))
    }

    /// What x receives from it in one channel: red, green, blue, luminance.
    pub fn in_channel(&self, channel: usize) -> [f64; 2] {
        let [Received { rgb, error }, _] = self.received;
        let luminance = if self.glow.is_some() { luminance(rgb) } else { self.luminance * self.moments.m10 };
        [[rgb[0], rgb[1], rgb[2], luminance][channel], error]
    }

    /// cosθ_x cosθ_y / r² of a point y of the facet: the geometry term of the area formulation,
    /// without V.
    pub fn g(&self, y: DVec3) -> f64 {
        let r2 = y.length_squared();
        (y.z * self.facet.s) / (r2 * r2)
    }

    /// Relative error that the coordinates' rounding leaves in cosθ_x and cosθ_y/r² on the visible
    /// part.
    pub fn slack(&self) -> f64 {
        self.slack_of(&self.moments)
    }

    /// The same on a part with these moments.
    pub(crate) fn slack_of(&self, moments: &Moments) -> f64 {
        let in_grid = self.glow.as_ref().map_or(0.0, |glow| glow.slack(self.facet.reach));
        slack(&self.facet, moments.solid_angle, moments.m10) + in_grid
    }

    /// L_e f_r at a point y of it: red, green, blue, luminance.
    pub(crate) fn radiance_at(&self, y: DVec3) -> [f64; 4] {
        let [r, g, b] = self.radiance;
        self.glow.as_ref().map_or([r, g, b, self.luminance], |glow| glow.at(y))
    }
}

impl Received {
    /// At one radiance.
    fn at(radiance: [f64; 3], moments: &Moments) -> Self {
        Self { rgb: radiance.map(|l| l * moments.m10), error: luminance(radiance) * moments.errors[1] }
    }

    /// By a texture, along whose texels the pieces are cut.
    fn by_texture(glow: &Glow, pieces: &Pieces, facet: &Facet, moments: &Moments) -> Result<Self, Error> {
        let light = |y: DVec3| {
            let r2 = y.length_squared();
            glow.at(y).map(|l| l * (y.z * facet.s) / (r2 * r2))
        };
        let Integral { value: [r, g, b, _], error } = textured(glow, pieces, facet, moments, light)?;
        Ok(Self { rgb: [r, g, b], error: error[3] })
    }
}

/// ∫ f dA over pieces that are cut along the texels, f >= 0 a function of the radiance there, with bounds of all errors.
fn textured<const K: usize>(
    glow: &Glow,
    pieces: &Pieces,
    facet: &Facet,
    moments: &Moments,
    f: impl Fn(DVec3) -> [f64; K],
) -> Result<Integral<K>, Error> {
    let slack = slack(facet, moments.solid_angle, moments.m10) + glow.slack(facet.reach);
    let relative = (0.1 * slack).clamp(1e-12, 1.0);
    let mut sum = integrate(pieces, &f, |total| total.map(|value| relative * value + f64::MIN_POSITIVE))?;
    let outline = line_integral(pieces, &f);
    for k in 0..K {
        sum.error[k] += moments.shift * outline[k] + 4.0 * slack * sum.value[k];
    }
    Ok(sum)
}

/// The plane's distance s and the heights z are known to some ε × reach each; s/r² and z/r carry
/// that over s and over z, whose ratio to r is M_10/M_00 on average.
fn slack(facet: &Facet, solid_angle: f64, m10: f64) -> f64 {
    let over_height = if m10 > 0.0 { solid_angle / m10 } else { f64::INFINITY };
    8.0 * EPSILON * (1.0 + facet.reach / facet.s + over_height)
}

/// Edge sums, or cubature where the sums cancel: tiny, far or nearly edge-on polygons.
fn moments_of(pieces: &Pieces, facet: &Facet, amplification: f64) -> Moments {
    let mut moments = Moments::of(pieces, facet, amplification);
    if moments.error > TOO_ROUGH * moments.m20 {
        // dω = s/r³ dA, cosθ_x = z/r
        let integrands = |y: DVec3| {
            let r2 = y.length_squared();
            let (r, cos_x) = (r2.sqrt(), y.z / r2.sqrt());
            let d_omega = facet.s / (r2 * r);
            [d_omega, d_omega * cos_x, d_omega * cos_x * cos_x]
        };
        // The sums may have lost all digits, and their sign: the slack is that of the cubature.
        let [solid_angle, m10, _] = guess(pieces, integrands);
        let slack = slack(facet, solid_angle, m10);
        let relative = (0.1 * slack).clamp(1e-12, 1.0);
        if let Ok(sum) = integrate(pieces, integrands, |total| total.map(|v| relative * v)) {
            [moments.solid_angle, moments.m10, moments.m20] = sum.value;
            let outline = line_integral(pieces, integrands);
            let bound = |k: usize| sum.error[k] + moments.shift * outline[k] + 2.0 * slack * sum.value[k];
            moments.errors = from_fn(|k| moments.error.min(bound(k)));
        }
    }
    moments
}
