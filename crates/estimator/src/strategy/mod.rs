//! The catalogue of strategies: single techniques and combinations of them. One list serves the command line, exact light, the
//! tests and reports.

mod name;
mod prepared;
mod team;
mod weighting;

pub use name::UnknownStrategy;
pub use prepared::{Known, Prepared};
pub use team::{MOST, Member, Team};
pub use weighting::Weighting;

use crate::selection::Selection;
use crate::technique::{Kind, Technique};

/// A technique or a combination of some, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Strategy {
    /// `formulation/density[@selection]`: one technique, whose selection must stand alone.
    Single(Technique),
    /// `mis/…`: a sample or more of each technique of a team, weighted.
    Mis(Weighting, Team),
    /// `mixture/A`: one sample from A · the first technique + (1 − A) · the second, 0 <= A <= 1, whose selections must stand alone.
    Mixture(f64, [Technique; 2]),
    /// `ris/M`: one of M candidates of `area/uniform`, resampled by what they would contribute unhidden.
    Resampled(u32),
    /// `ratio`: unhidden irradiance times the sampled part of it that is seen.
    Ratio,
    /// `control-variate`: unhidden irradiance less the sampled part of it that is hidden.
    ControlVariate,
}

/// Points on the lights.
const AREA: Technique = Technique::of(Kind::AreaUniform);
/// Directions by the cosine.
const COSINE: Technique = Technique::of(Kind::HemisphereCosine);

impl Strategy {
    /// What a mixture is of when nothing is said: `hemisphere/cosine` and `area/uniform`.
    pub const PAIR: [Technique; 2] = [COSINE, AREA];

    /// All strategies: every technique, and of the combinations, whose names are without number, those of the default teams.
    pub fn all() -> Vec<Self> {
        let alone = Technique::all().into_iter().filter(|technique| technique.selection.stands_alone());
        let mut all: Vec<Self> = alone.map(Self::Single).collect();
        all.extend(Weighting::ALL.map(|weighting| Self::Mis(weighting, Team::default())));
        all.push(Self::Mis(Weighting::Balance, Team::compensated()));
        all.extend([0.1, 0.5].map(|share| Self::Mixture(share, Self::PAIR)));
        all.extend([Self::Resampled(8), Self::Ratio, Self::ControlVariate]);
        all
    }

    /// Those of them that images can be made by.
    pub fn all_in_images() -> Vec<Self> {
        Self::all().into_iter().filter(|strategy| strategy.impossible_in_images().is_none()).collect()
    }

    /// What `compare` compares when nothing is said.
    pub fn defaults() -> Vec<Self> {
        let kinds = [
            Kind::HemisphereUniform,
            Kind::HemisphereCosine,
            Kind::HemisphereTowardLights,
            Kind::AreaUniform,
            Kind::AreaSolidAngle,
            Kind::AreaProjectedSolidAngle,
        ];
        let mut defaults: Vec<Self> = kinds.into_iter().map(|kind| Self::Single(Technique::of(kind))).collect();
        defaults.push(Self::Mis(Weighting::Balance, Team::default()));
        defaults
    }

    /// The density's own name, which strategies of one density share, and so their random numbers: points toward lights
    /// are points of lights.
    pub fn density_name(self) -> String {
        match self {
            Self::Single(Technique {
                kind: Kind::HemisphereTowardLights | Kind::HemisphereTowardLightsMarginal,
                selection,
            }) => Technique { kind: Kind::AreaUniform, selection }.to_string(),
            other => other.to_string(),
        }
    }

    /// Whether its estimates are biased by design.
    pub fn is_biased(self) -> bool {
        self == Self::Ratio
    }

    /// Whether what a sample is worth can be negative.
    pub fn can_be_negative(self) -> bool {
        matches!(self, Self::ControlVariate | Self::Mis(Weighting::Optimal | Weighting::Pilot(_), _))
    }
}

impl From<Technique> for Strategy {
    fn from(technique: Technique) -> Self {
        Self::Single(technique)
    }
}

impl From<(Kind, Selection)> for Strategy {
    fn from((kind, selection): (Kind, Selection)) -> Self {
        Self::Single(Technique { kind, selection })
    }
}

impl From<Kind> for Strategy {
    fn from(kind: Kind) -> Self {
        Self::Single(Technique::of(kind))
    }
}
