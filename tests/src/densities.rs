//! The density of each strategy, with its domain.

use twoforms_estimator::density::{CosineHemisphere, Density, OnLights, TowardLights, UniformHemisphere};
use twoforms_estimator::lights::Lights;
use twoforms_estimator::measure::Measure;
use twoforms_estimator::selection::Picker;
use twoforms_estimator::strategy::{Draw, Strategy};
use twoforms_geometry::view::View;

use crate::domain::{Domain, HemisphereCells, LightCells};

/// Something to do with a density, whichever it is.
pub trait Visitor {
    /// What comes of it.
    type Output;
    /// Does it, for the density as it is at x.
    fn visit<M: Measure, D: Density<M>>(self, view: &View, density: &D, domain: &impl Domain<M>) -> Self::Output;
}

/// Hands the density of `strategy` to the visitor; `None` for one that has no sampler. A strategy that is new does not
/// compile here until its density has a domain to be tested on.
pub fn visit<V: Visitor>(strategy: Strategy, lights: &Lights, view: &View, visitor: V) -> Option<V::Output> {
    match strategy {
        Strategy::from(Kind::HemisphereUniform) => Some(visitor.visit(view, &UniformHemisphere, &HemisphereCells)),
        Strategy::from(Kind::HemisphereCosine) => Some(visitor.visit(view, &CosineHemisphere, &HemisphereCells)),
        Strategy::from((Kind::HemisphereTowardLights, selection)) => {
            let picker = &Picker::new(selection, lights)?;
            Some(visitor.visit(view, &TowardLights { lights: OnLights { picker } }, &LightCells::new(view, picker)))
        }
        Strategy::from((Kind::AreaUniform, selection)) => {
            let picker = &Picker::new(selection, lights)?;
            Some(visitor.visit(view, &OnLights { picker }, &LightCells::new(view, picker)))
        }
        Strategy::Area(Draw::SolidAngle | Draw::ProjectedSolidAngle, _) | Strategy::Mis(_) | Strategy::Mixture(_) => {
            None
        }
    }
}
