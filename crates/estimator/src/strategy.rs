//! The catalogue of strategies: `formulation/density[@selection]`. One list serves the command line, the tests and reports.

use std::fmt;
use std::str::FromStr;

use twoforms_geometry::view::View;

use crate::density::{CosineHemisphere, Density, OnLights, TowardLights, UniformHemisphere};
use crate::estimator::Estimator;
use crate::formulation::{Area, Formulation, Hemisphere};
use crate::lights::Lights;
use crate::query::Query;
use crate::selection::{Picker, SELECTIONS, Selection};

/// A formulation with a density of its measure, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Strategy {
    /// `hemisphere/uniform`: p(Ψ) = 1/2π.
    HemisphereUniform,
    /// `hemisphere/cosine`: p(Ψ) = cosθ/π.
    HemisphereCosine,
    /// `hemisphere/toward-lights[@selection]`: the density of `area/uniform`, the integral over the hemisphere.
    HemisphereTowardLights(Selection),
    /// `area/uniform[@selection]`: uniform over the lights' area, or over that of a light picked first.
    AreaUniform(Selection),
}

impl Strategy {
    /// All strategies.
    pub fn all() -> Vec<Self> {
        let toward = SELECTIONS.map(Self::HemisphereTowardLights);
        let area = SELECTIONS.map(Self::AreaUniform);
        [&[Self::HemisphereUniform, Self::HemisphereCosine], &toward[..], &area[..]].concat()
    }

    /// What `compare` compares when nothing is said.
    pub fn defaults() -> Vec<Self> {
        let selection = Selection::ByArea;
        vec![
            Self::HemisphereUniform,
            Self::HemisphereCosine,
            Self::HemisphereTowardLights(selection),
            Self::AreaUniform(selection),
        ]
    }

    /// The density's own name, which strategies of one density share, and so their random numbers: points toward lights
    /// are points of lights.
    pub fn density_name(self) -> String {
        match self {
            Self::HemisphereTowardLights(selection) => Self::AreaUniform(selection).to_string(),
            other => other.to_string(),
        }
    }

    /// One line on what it does.
    pub fn description(self) -> &'static str {
        match self {
            Self::HemisphereUniform => "directions uniform over the hemisphere, p = 1/2π",
            Self::HemisphereCosine => "directions by the cosine, p = cosθ/π",
            Self::HemisphereTowardLights(_) => {
                "directions toward points drawn as area/uniform does: its density, the other integral"
            }
            Self::AreaUniform(Selection::ByArea) => "points uniform over the area of all lights, p = 1/A",
            Self::AreaUniform(Selection::Uniform) => "a light first, each alike, then a point uniform over it",
            Self::AreaUniform(Selection::Power) => "a light first, by its power, then a point uniform over it",
        }
    }

    fn selection(self) -> Selection {
        match self {
            Self::HemisphereUniform | Self::HemisphereCosine => Selection::ByArea,
            Self::HemisphereTowardLights(selection) | Self::AreaUniform(selection) => selection,
        }
    }

    /// Builds what the strategy needs once per scene. The scene must have a light.
    pub fn prepare(self, lights: &Lights) -> Prepared {
        Prepared { strategy: self, picker: Picker::new(self.selection(), lights) }
    }
}

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::HemisphereUniform => "hemisphere/uniform",
            Self::HemisphereCosine => "hemisphere/cosine",
            Self::HemisphereTowardLights(_) => "hemisphere/toward-lights",
            Self::AreaUniform(_) => "area/uniform",
        })?;
        match self.selection() {
            Selection::ByArea => Ok(()),
            selection => write!(f, "@{}", selection.word()),
        }
    }
}

/// A name that no strategy has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no strategy \"{name}\"; did you mean \"{nearest}\"? (all: {all})")]
pub struct UnknownStrategy {
    /// What was asked for.
    pub name: String,
    /// The nearest name there is.
    pub nearest: String,
    /// All names.
    pub all: String,
}

impl FromStr for Strategy {
    type Err = UnknownStrategy;

    fn from_str(name: &str) -> Result<Self, UnknownStrategy> {
        let all = Self::all();
        all.iter().copied().find(|strategy| strategy.to_string() == name).ok_or_else(|| {
            let names: Vec<String> = all.iter().map(ToString::to_string).collect();
            let nearest =
                names.iter().max_by(|a, b| strsim::jaro_winkler(a, name).total_cmp(&strsim::jaro_winkler(b, name)));
            UnknownStrategy {
                name: name.to_owned(),
                nearest: nearest.cloned().unwrap_or_default(),
                all: names.join(", "),
            }
        })
    }
}

/// A strategy with what it needs of one scene.
#[derive(Clone, Debug)]
pub struct Prepared {
    strategy: Strategy,
    picker: Picker,
}

/// Something to do with an estimator, whichever it is: matched once, then wholly inlined.
pub trait Kernel {
    /// What comes of it.
    type Output;
    /// Does it.
    fn run<F: Formulation, D: Density<F::Measure>>(self, estimator: &Estimator<F, D>) -> Self::Output;
}

impl Prepared {
    /// Which strategy it is.
    pub fn strategy(&self) -> Strategy {
        self.strategy
    }

    /// Runs the kernel with this strategy's estimator at x.
    pub fn run<K: Kernel>(&self, view: &View, query: &Query, kernel: K) -> K::Output {
        let lights = OnLights { picker: &self.picker };
        match self.strategy {
            Strategy::HemisphereUniform => kernel.run(&Estimator::<Hemisphere, _>::new(view, query, UniformHemisphere)),
            Strategy::HemisphereCosine => kernel.run(&Estimator::<Hemisphere, _>::new(view, query, CosineHemisphere)),
            Strategy::HemisphereTowardLights(_) => {
                kernel.run(&Estimator::<Hemisphere, _>::new(view, query, TowardLights { lights }))
            }
            Strategy::AreaUniform(_) => kernel.run(&Estimator::<Area, _>::new(view, query, lights)),
        }
    }
}
