//! The density of each technique, with its domain.

use twoforms_estimator::density::{
    AreaOnLights, CosineHemisphere, Density, LuminanceOnLights, ProjectedSolidAngleOnLights, Ready, SolidAngleOnLights,
    TowardLightsMarginally, TowardPreparedLights, UniformHemisphere,
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
        Kind::HemisphereUniform => visitor.visit(view, &UniformHemisphere, &HemisphereCells),
        Kind::HemisphereCosine => visitor.visit(view, &CosineHemisphere, &HemisphereCells),
        Kind::HemisphereTowardLights => {
            let ready = TowardPreparedLights::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LightCells::new(view, &density.lights.picker))
        }
        Kind::HemisphereTowardLightsMarginal => {
            let ready = TowardLightsMarginally::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LitDirections::new(view, &density.lights.picker))
        }
        Kind::AreaUniform => {
            let ready = AreaOnLights::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LightCells::new(view, &density.picker))
        }
        Kind::AreaLuminance => {
            let ready = LuminanceOnLights::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LightCells::new(view, &density.picker))
        }
        Kind::AreaSolidAngle => {
            let ready = SolidAngleOnLights::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LightCells::varying(view, &density.picker))
        }
        Kind::AreaProjectedSolidAngle => {
            let ready = ProjectedSolidAngleOnLights::prepare(query.lights(), selection);
            let density = ready.at(view, query);
            visitor.visit(view, &density, &LightCells::varying(view, &density.picker))
        }
    }
}
