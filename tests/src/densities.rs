//! The density of each technique, with its domain.

use twoforms_estimator::density::{
    AreaOnLights, BilinearCosineOnLights, BrdfOfSurface, CosineHemisphere, Density, LuminanceOnLights,
    ProjectedSolidAngleOnLights, Ready, SolidAngleOnLights, TowardLightsMarginally, TowardPreparedLights,
    UniformHemisphere,
};
use twoforms_estimator::measure::Measure;
use twoforms_estimator::query::Query;
use twoforms_estimator::technique::{Kind, Technique};
use twoforms_geometry::view::View;

use crate::domain::{Domain, HemisphereCells, LightCells, LitDirections};

/// Something to do with a density, whichever it is.
pub trait Visitor {
    /// What comes of it.
    type Output;
    /// Does it, for the density as it is at x.
    fn visit<M: Measure, D: Density<M>>(self, view: &View, density: &D, domain: &impl Domain<M>) -> Self::Output;
}

/// Hands the density of `technique` to the visitor. A technique that is new does not compile here until its density has a
/// domain to be tested on.
pub fn visit<V: Visitor>(technique: Technique, query: &Query, view: &View, visitor: V) -> V::Output {
    let Technique { kind, selection } = technique;
    match kind {
        Kind::HemisphereUniform => visitor.visit(view, &UniformHemisphere, &HemisphereCells::EVEN),
        Kind::HemisphereCosine => visitor.visit(view, &CosineHemisphere, &HemisphereCells::EVEN),
        Kind::HemisphereBrdf => {
            let ready = BrdfOfSurface::prepare(query.lights(), selection);
            visitor.visit(view, &ready.at(view, query), &HemisphereCells::EVEN)
        }
        Kind::HemisphereTowardLights => {
            let ready = TowardPreparedLights::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LightCells::new(view, &density.lights.picking))
        }
        Kind::HemisphereTowardLightsMarginal => {
            let ready = TowardLightsMarginally::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LitDirections::new(view, &density.lights.picking))
        }
        Kind::AreaUniform => {
            let ready = AreaOnLights::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LightCells::new(view, &density.picking))
        }
        Kind::AreaLuminance => {
            let ready = LuminanceOnLights::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LightCells::new(view, &density.picking))
        }
        Kind::AreaSolidAngle => {
            let ready = SolidAngleOnLights::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LightCells::varying(view, &density.picking))
        }
        Kind::AreaProjectedSolidAngle => {
            let ready = ProjectedSolidAngleOnLights::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LightCells::varying(view, &density.picking))
        }
        Kind::AreaBilinearCosine => {
            let ready = BilinearCosineOnLights::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LightCells::varying(view, &density.picking))
        }
    }
}
