//! The densities of techniques at points of the lights.

use std::borrow::Cow;
use std::f64::consts::PI;

use glam::DVec3;
use twoforms_estimator::technique::{Kind, Technique};

use crate::bilinear::Bilinear;
use crate::error::Error;
use crate::law::Law;
use crate::picked::{self, Draw, Shares, shares};
use crate::reflected::Reflected;
use crate::seen::Seen;
use crate::sight::Sight;
use crate::value::EPSILON;
use crate::visible::Pieces;

/// The density of a technique over what x sees, and the probability of seeing nothing.
pub struct Density {
    measure: Measure,
    shares: Shares,
}

/// What a density is constant in, on each facet.
enum Measure {
    /// dA.
    Area,
    /// dω.
    SolidAngle,
    /// cosθ_x dω.
    ProjectedSolidAngle,
    /// w dω, w a bilinear cosine.
    BilinearCosine(Vec<Bilinear>),
    /// What a surface with a highlight draws by itself.
    Surface(Reflected),
}

impl Density {
    /// The density at the sight's x.
    ///
    /// # Errors
    /// [`Error::NoFormula`] for a density that no formula is known of; else as [`shares`], and [`Error::NotConverged`] of a surface's
    /// own density.
    pub fn new(sight: &Sight, Technique { kind, selection }: Technique) -> Result<Self, Error> {
        let drawn = |measure, draw| Ok(Self { measure, shares: shares(sight, draw, selection)? });
        match kind {
            Kind::HemisphereUniform => Ok(Self::over_hemisphere(sight, Measure::SolidAngle, 2.0 * PI)),
            Kind::HemisphereCosine => Ok(Self::over_hemisphere(sight, Measure::ProjectedSolidAngle, PI)),
            Kind::AreaUniform | Kind::HemisphereTowardLights => drawn(Measure::Area, Draw::Uniform),
            Kind::AreaSolidAngle => drawn(Measure::SolidAngle, Draw::SolidAngle),
            Kind::AreaProjectedSolidAngle => drawn(Measure::ProjectedSolidAngle, Draw::ProjectedSolidAngle),
            Kind::AreaBilinearCosine => {
                let bilinear = sight.seen.iter().map(|seen| Bilinear::new(&seen.corners)).collect();
                drawn(Measure::BilinearCosine(bilinear), Draw::BilinearCosine)
            }
            Kind::HemisphereBrdf => Self::of_surface(sight),
            Kind::AreaLuminance => Self::of_luminance(sight),
            Kind::HemisphereTowardLightsMarginal => Err(Error::NoFormula),
        }
    }

    /// The cosine, where f_r is constant.
    fn of_surface(sight: &Sight) -> Result<Self, Error> {
        let Some(reflected) = &sight.reflected else {
            return Ok(Self::over_hemisphere(sight, Measure::ProjectedSolidAngle, PI));
        };
        let (hidden, hidden_error) = reflected.missed_by_itself(sight)?;
        let shares = Shares { per_measure: vec![1.0; sight.seen.len()], hidden, hidden_error };
        Ok(Self { measure: Measure::Surface(reflected.clone()), shares })
    }

    /// In proportion to what each light emits; of textured lights the density jumps from cell to cell, and no formula is known here.
    fn of_luminance(sight: &Sight) -> Result<Self, Error> {
        if sight.seen.iter().any(|seen| seen.glow.is_some()) {
            return Err(Error::NoFormula);
        }
        let total: f64 = sight.lights.iter().map(|light| light.power).sum();
        let per_area = |seen: &Seen| sight.lights[seen.light].power / (sight.lights[seen.light].area * total);
        let per_measure = sight.seen.iter().map(per_area).collect();
        let Law { hidden, hidden_error, .. } = picked::by_luminance(sight)?;
        Ok(Self { measure: Measure::Area, shares: Shares { per_measure, hidden, hidden_error } })
    }

    /// One over the whole of a measure over the hemisphere.
    fn over_hemisphere(sight: &Sight, measure: Measure, whole: f64) -> Self {
        let (mut seen, mut error) = (0.0, 0.0);
        for Seen { moments, .. } in &sight.seen {
            let (moment, bound) = match &measure {
                Measure::SolidAngle => (moments.solid_angle, moments.errors[0]),
                _ => (moments.m10, moments.errors[1]),
            };
            seen += moment;
            error += bound;
        }
        let missed = 1.0 - seen / whole;
        // What lies below zero is rounding.
        let hidden = if missed < 0.0 { 0.0 } else { missed };
        let per_measure = vec![1.0 / whole; sight.seen.len()];
        Self { measure, shares: Shares { per_measure, hidden, hidden_error: error / whole + 4.0 * EPSILON } }
    }

    /// p(y) in 1/m², y on a facet of the sight.
    pub fn per_area(&self, index: usize, seen: &Seen, y: DVec3) -> f64 {
        let r2 = y.length_squared();
        self.shares.per_measure[index]
            * match &self.measure {
                Measure::Area => 1.0,
                Measure::SolidAngle => seen.facet.s / (r2 * r2.sqrt()),
                Measure::ProjectedSolidAngle => seen.g(y),
                Measure::BilinearCosine(bilinear) => bilinear[index].at(y) * seen.facet.s / (r2 * r2.sqrt()),
                Measure::Surface(reflected) => reflected.own_density(seen, y),
            }
    }

    /// Whether points of a facet are drawn.
    pub fn reaches(&self, index: usize) -> bool {
        self.shares.per_measure[index] > 0.0
    }

    /// What x sees of a facet, in pieces on which the density is smooth, where those are smaller than the facet's.
    pub fn cut<'s>(&self, index: usize, seen: &'s Seen) -> Option<Cow<'s, Pieces>> {
        match &self.measure {
            Measure::BilinearCosine(bilinear) => Some(bilinear[index].cut(seen)),
            _ => None,
        }
    }

    /// The probability of a sample worth zero, and a bound of its error.
    pub fn missed(&self) -> (f64, f64) {
        (self.shares.hidden, self.shares.hidden_error)
    }
}
