//! The catalogue of strategies: `formulation/density[@selection]`. One list of names serves the command line, exact
//! light, the tests and reports. Some strategies have an exact variance and no sampler yet: [`Strategy::prepare`] says so.

use std::fmt;
use std::str::FromStr;

use twoforms_geometry::view::View;

use crate::density::{CosineHemisphere, Density, OnLights, TowardLights, UniformHemisphere};
use crate::estimator::Estimator;
use crate::formulation::{Area, Formulation, Hemisphere};
use crate::lights::Lights;
use crate::nearest::nearest;
use crate::query::Query;
use crate::selection::{Pick, Picker, Selection};

/// A formulation with a density of its measure, or a combination of two, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Strategy {
    /// `hemisphere/uniform`: p(Ψ) = 1/2π.
    HemisphereUniform,
    /// `hemisphere/cosine`: p(Ψ) = cosθ/π.
    HemisphereCosine,
    /// `hemisphere/toward-lights[@selection]`: the density of `area/uniform`, the integral over the hemisphere.
    HemisphereTowardLights(Selection),
    /// `area/draw[@selection]`: points on the lights, uniform in a measure.
    Area(Draw, Selection),
    /// `mis/…`: one sample of `area/uniform` and one of `hemisphere/cosine`, weighted.
    Mis(Weighting),
    /// `mixture/A`: one sample from A · `hemisphere/cosine` + (1 − A) · `area/uniform`, 0 <= A <= 1.
    Mixture(f64),
}

/// The measure in which points are uniform over the lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Draw {
    /// Area, back-facing targets included.
    Uniform,
    /// Solid angle of the targets that face x, not clipped to the horizon.
    SolidAngle,
    /// Projected solid angle of the targets that face x, clipped to the horizon.
    ProjectedSolidAngle,
}

/// How two samples are weighted (Veach 1997, chapter 9; optimal: Kondapaneni et al. 2019).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Weighting {
    /// w_i = p_i / (p_a + p_h).
    Balance,
    /// w_i = p_i² / (p_a² + p_h²).
    Power,
    /// The weights of least variance, with the known α.
    Optimal,
}

impl Strategy {
    /// All strategies that can be sampled.
    pub fn all() -> Vec<Self> {
        use Selection::{Power, Together, Uniform};
        let selections = [Together, Uniform, Power];
        let toward = selections.map(Self::HemisphereTowardLights);
        let area = selections.map(|selection| Self::Area(Draw::Uniform, selection));
        [&[Self::HemisphereUniform, Self::HemisphereCosine], &toward[..], &area[..]].concat()
    }

    /// All strategies that have an exact variance; mixtures by some of their many names.
    pub fn with_exact_variance() -> Vec<Self> {
        let toward = Selection::ALL.map(Self::HemisphereTowardLights);
        let area = |draw| Selection::ALL.map(|selection| Self::Area(draw, selection));
        let areas = [Draw::Uniform, Draw::SolidAngle, Draw::ProjectedSolidAngle].map(area).concat();
        let mis = [Weighting::Balance, Weighting::Power, Weighting::Optimal].map(Self::Mis);
        let mixtures = [0.1, 0.5].map(Self::Mixture);
        [&[Self::HemisphereUniform, Self::HemisphereCosine], &toward[..], &areas, &mis, &mixtures].concat()
    }

    /// What `compare` compares when nothing is said.
    pub fn defaults() -> Vec<Self> {
        let together = Selection::Together;
        vec![
            Self::HemisphereUniform,
            Self::HemisphereCosine,
            Self::HemisphereTowardLights(together),
            Self::Area(Draw::Uniform, together),
        ]
    }

    /// The density's own name, which strategies of one density share, and so their random numbers: points toward lights
    /// are points of lights.
    pub fn density_name(self) -> String {
        match self {
            Self::HemisphereTowardLights(selection) => Self::Area(Draw::Uniform, selection).to_string(),
            other => other.to_string(),
        }
    }

    /// Builds what the strategy needs once per scene. The scene must have a light.
    ///
    /// # Errors
    /// When the strategy has an exact variance but no sampler.
    pub fn prepare(self, lights: &Lights) -> Result<Prepared, NotSampled> {
        let not_sampled = NotSampled { strategy: self };
        let picker = |selection| Picker::new(selection, lights).ok_or(not_sampled);
        let density = match self {
            Self::HemisphereUniform => Ready::HemisphereUniform,
            Self::HemisphereCosine => Ready::HemisphereCosine,
            Self::HemisphereTowardLights(selection) => Ready::HemisphereTowardLights(picker(selection)?),
            Self::Area(Draw::Uniform, selection) => Ready::AreaUniform(picker(selection)?),
            Self::Area(..) | Self::Mis(_) | Self::Mixture(_) => return Err(not_sampled),
        };
        Ok(Prepared { strategy: self, density })
    }

    /// Whether it can be sampled.
    pub fn is_sampled(self) -> bool {
        Self::all().contains(&self)
    }

    fn selection(self) -> Selection {
        match self {
            Self::HemisphereTowardLights(selection) | Self::Area(_, selection) => selection,
            _ => Selection::Together,
        }
    }
}

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let density = match self {
            Self::HemisphereUniform => "hemisphere/uniform",
            Self::HemisphereCosine => "hemisphere/cosine",
            Self::HemisphereTowardLights(_) => "hemisphere/toward-lights",
            Self::Area(Draw::Uniform, _) => "area/uniform",
            Self::Area(Draw::SolidAngle, _) => "area/solid-angle",
            Self::Area(Draw::ProjectedSolidAngle, _) => "area/projected-solid-angle",
            Self::Mis(Weighting::Balance) => "mis/balance",
            Self::Mis(Weighting::Power) => "mis/power",
            Self::Mis(Weighting::Optimal) => "mis/optimal",
            Self::Mixture(share) => return write!(f, "{MIXTURE}{share}"),
        };
        write!(f, "{density}{}", self.selection().suffix())
    }
}

const MIXTURE: &str = "mixture/";

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

/// A strategy that is known, and its variance too, but that has no sampler.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("\"{strategy}\" has an exact variance but no sampler yet: use `twoforms exact`, or one of {}", sampled())]
pub struct NotSampled {
    /// Which strategy.
    pub strategy: Strategy,
}

fn sampled() -> String {
    Strategy::all().iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

impl FromStr for Strategy {
    type Err = UnknownStrategy;

    fn from_str(name: &str) -> Result<Self, UnknownStrategy> {
        let all = Self::with_exact_variance();
        let mixture =
            || Some(Self::Mixture(name.strip_prefix(MIXTURE)?.parse().ok().filter(|a| (0.0..=1.0).contains(a))?));
        all.iter().copied().find(|strategy| strategy.to_string() == name).or_else(mixture).ok_or_else(|| {
            let names: Vec<String> = all.iter().map(ToString::to_string).collect();
            UnknownStrategy {
                name: name.to_owned(),
                nearest: nearest(name, &names).unwrap_or_default(),
                all: names.join(", "),
            }
        })
    }
}

/// A strategy with what it needs of one scene.
#[derive(Clone, Debug)]
pub struct Prepared {
    strategy: Strategy,
    density: Ready,
}

/// The densities, each with its tables.
#[derive(Clone, Debug)]
enum Ready {
    HemisphereUniform,
    HemisphereCosine,
    HemisphereTowardLights(Picker),
    AreaUniform(Picker),
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
        match &self.density {
            Ready::HemisphereUniform => kernel.run(&Estimator::<Hemisphere, _>::new(view, query, UniformHemisphere)),
            Ready::HemisphereCosine => kernel.run(&Estimator::<Hemisphere, _>::new(view, query, CosineHemisphere)),
            Ready::HemisphereTowardLights(picker) => match picker.only() {
                Some(only) => kernel.run(&toward_lights(view, query, &only)),
                None => kernel.run(&toward_lights(view, query, picker)),
            },
            Ready::AreaUniform(picker) => match picker.only() {
                Some(only) => kernel.run(&on_lights(view, query, &only)),
                None => kernel.run(&on_lights(view, query, picker)),
            },
        }
    }
}

fn on_lights<'a, P: Pick>(view: &'a View, query: &'a Query, picker: &'a P) -> Estimator<'a, Area, OnLights<'a, P>> {
    Estimator::new(view, query, OnLights { picker })
}

fn toward_lights<'a, P: Pick>(
    view: &'a View,
    query: &'a Query,
    picker: &'a P,
) -> Estimator<'a, Hemisphere, TowardLights<'a, P>> {
    Estimator::new(view, query, TowardLights { lights: OnLights { picker } })
}

#[cfg(test)]
mod tests {
    use super::Strategy;

    #[test]
    fn every_name_is_read_as_it_is_written() {
        for strategy in Strategy::with_exact_variance().into_iter().chain(Strategy::all()) {
            assert_eq!(strategy.to_string().parse(), Ok(strategy));
        }
        assert_eq!("mixture/0.25".parse(), Ok(Strategy::Mixture(0.25)));
    }

    #[test]
    fn what_can_be_sampled_has_an_exact_variance() {
        let exact = Strategy::with_exact_variance();
        assert!(Strategy::all().iter().all(|strategy| exact.contains(strategy)));
    }

    #[test]
    fn other_names_are_refused_with_the_nearest() {
        for (name, nearest) in [("area/unifrom", "area/uniform"), ("hemispher/cosine", "hemisphere/cosine")] {
            assert_eq!(name.parse::<Strategy>().map_err(|unknown| unknown.nearest), Err(nearest.to_owned()));
        }
        for name in ["", "cosine", "mixture/2", "mixture/NaN", "hemisphere/cosine@power"] {
            assert!(name.parse::<Strategy>().is_err(), "{name}");
        }
    }
}
