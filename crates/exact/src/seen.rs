//! One facet as x sees it, with its moments.

use std::array::from_fn;
use std::sync::OnceLock;

use glam::DVec3;

use crate::cubature::{guess, integrate};
use crate::error::Error;
use crate::facet::Facet;
use crate::facing::Facing;
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
    /// The target it belongs to.
    pub target: usize,
    /// The light it belongs to.
    pub light: usize,
    /// L_e toward x, linear RGB.
    pub radiance: [f64; 3],
    /// Luminance of L_e.
    pub luminance: f64,
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

/// Results that are computed when first asked for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cubatures {
    /// Of g under dA.
    pub area: OnceLock<Result<Part, Error>>,
    /// Of cosθ_x under dω.
    pub solid_angle: OnceLock<Result<Part, Error>>,
    /// Of cosθ_x over the bilinear cosine, under that times dω.
    pub bilinear: OnceLock<Result<Part, Error>>,
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
        let open = if blocked { moments_of(&Pieces::one(&outline), &facet, 1.0) } else { moments };
        let whole_solid_angle = if clipped { solid_angle_of(&facet.corners) } else { open.solid_angle };
        let visible_area = if blocked || clipped { area * (moments.area / facet.area) } else { area };
        Ok(Self {
            target: facing.target as usize,
            light: facing.light as usize,
            radiance: facing.radiance,
            luminance: luminance(facing.radiance),
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
        slack(&self.facet, moments.solid_angle, moments.m10)
    }
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
