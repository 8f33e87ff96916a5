//! The estimators whose variance is known here, by name.

use std::fmt;
use std::str::FromStr;

/// Measure in which a point is uniform over the lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Draw {
    /// Uniform in area over the lights, back-facing triangles included.
    Uniform,
    /// Uniform in solid angle over the targets that face x, not clipped to the horizon.
    SolidAngle,
    /// Uniform in projected solid angle over the targets that face x, clipped to the horizon.
    ProjectedSolidAngle,
}

/// How a light is picked before a point is drawn on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Selection {
    /// Not at all: points are drawn over the union of all lights.
    Together,
    /// q = 1/n.
    Uniform,
    /// q ∝ area × luminance × sides.
    Power,
    /// q ∝ luminance of the unoccluded irradiance.
    Contribution,
}

/// Weights of a pair of samples, one from `area/uniform` and one from `hemisphere/cosine`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Weighting {
    /// w_i = p_i / (p_a + p_h) (Veach 1997).
    Balance,
    /// w_i = p_i² / (p_a² + p_h²) (Veach 1997).
    Power,
    /// The weights of least variance, with the known α (Kondapaneni et al. 2019).
    Optimal,
}

/// One estimator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Strategy {
    /// p = 1/2π.
    HemisphereUniform,
    /// p = cosθ_x/π.
    HemisphereCosine,
    /// Directions toward points drawn as `area/uniform` draws them: sample by sample the same values.
    HemisphereTowardLights(Selection),
    /// Points on the lights.
    Area(Draw, Selection),
    /// Two weighted samples.
    Mis(Weighting),
    /// One sample from A · hemisphere/cosine + (1 − A) · area/uniform, 0 <= A <= 1.
    Mixture(f64),
}

impl Strategy {
    /// The strategies with an exact value that are shown when none is asked for.
    pub fn all() -> Vec<Self> {
        use Selection::{Contribution, Power, Together, Uniform};
        vec![
            Self::HemisphereUniform,
            Self::HemisphereCosine,
            Self::HemisphereTowardLights(Together),
            Self::Area(Draw::Uniform, Together),
            Self::Area(Draw::Uniform, Uniform),
            Self::Area(Draw::Uniform, Power),
            Self::Area(Draw::Uniform, Contribution),
            Self::Area(Draw::SolidAngle, Together),
            Self::Area(Draw::ProjectedSolidAngle, Together),
            Self::Area(Draw::ProjectedSolidAngle, Contribution),
            Self::Mis(Weighting::Balance),
            Self::Mis(Weighting::Power),
            Self::Mis(Weighting::Optimal),
            Self::Mixture(0.1),
            Self::Mixture(0.5),
        ]
    }
}

impl fmt::Display for Draw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Uniform => "area/uniform",
            Self::SolidAngle => "area/solid-angle",
            Self::ProjectedSolidAngle => "area/projected-solid-angle",
        })
    }
}

impl fmt::Display for Selection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Together => "",
            Self::Uniform => "@uniform",
            Self::Power => "@power",
            Self::Contribution => "@contribution",
        })
    }
}

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::HemisphereUniform => f.write_str("hemisphere/uniform"),
            Self::HemisphereCosine => f.write_str("hemisphere/cosine"),
            Self::HemisphereTowardLights(selection) => {
                write!(f, "hemisphere/toward-lights{selection}")
            }
            Self::Area(draw, selection) => write!(f, "{draw}{selection}"),
            Self::Mis(Weighting::Balance) => f.write_str("mis/balance"),
            Self::Mis(Weighting::Power) => f.write_str("mis/power"),
            Self::Mis(Weighting::Optimal) => f.write_str("mis/optimal"),
            Self::Mixture(a) => write!(f, "mixture/{a}"),
        }
    }
}

/// A name that stands for no strategy with an exact variance.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no exact variance is known for `{0}`")]
pub struct UnknownStrategy(pub String);

impl FromStr for Strategy {
    type Err = UnknownStrategy;

    fn from_str(name: &str) -> Result<Self, UnknownStrategy> {
        let unknown = || UnknownStrategy(name.to_owned());
        let (density, selection) = match name.split_once('@') {
            None => (name, Selection::Together),
            Some((density, "uniform")) => (density, Selection::Uniform),
            Some((density, "power")) => (density, Selection::Power),
            Some((density, "contribution")) => (density, Selection::Contribution),
            Some(_) => return Err(unknown()),
        };
        match density {
            "hemisphere/toward-lights" => return Ok(Self::HemisphereTowardLights(selection)),
            "area/uniform" => return Ok(Self::Area(Draw::Uniform, selection)),
            "area/solid-angle" => return Ok(Self::Area(Draw::SolidAngle, selection)),
            "area/projected-solid-angle" => {
                return Ok(Self::Area(Draw::ProjectedSolidAngle, selection));
            }
            _ => {}
        }
        match name {
            "hemisphere/uniform" => Ok(Self::HemisphereUniform),
            "hemisphere/cosine" => Ok(Self::HemisphereCosine),
            "mis/balance" => Ok(Self::Mis(Weighting::Balance)),
            "mis/power" => Ok(Self::Mis(Weighting::Power)),
            "mis/optimal" => Ok(Self::Mis(Weighting::Optimal)),
            _ => {
                let share = name.strip_prefix("mixture/").and_then(|a| a.parse::<f64>().ok());
                share.filter(|a| (0.0..=1.0).contains(a)).map(Self::Mixture).ok_or_else(unknown)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for strategy in Strategy::all() {
            assert_eq!(strategy.to_string().parse(), Ok(strategy));
        }
    }

    #[test]
    fn other_names_are_refused() {
        for name in [
            "",
            "area",
            "area/uniform@",
            "hemisphere/cosine@power",
            "mixture/1.5",
            "mixture/NaN",
            "mixture/-0.1",
            "mis/power@power",
        ] {
            assert_eq!(name.parse::<Strategy>(), Err(UnknownStrategy(name.to_owned())));
        }
    }
}
