//! Sweeps: one parameter of the scene runs through a range, and nothing else changes.

use serde::{Serialize, Serializer};

/// What moves. Receivers and lights move in binary64 and are not rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// Offset of every receiver along x, in metres.
    ReceiverX,
    /// Offset of every receiver along y, in metres.
    ReceiverY,
    /// Offset of every receiver along z, in metres.
    ReceiverZ,
    /// Offset of every receiver along its own normal, in metres.
    ReceiverNormal,
    /// Offset of all lights along x, in metres.
    LightX,
    /// Offset of all lights along y, in metres.
    LightY,
    /// Offset of all lights along z, in metres.
    LightZ,
    /// Scale of every light about its own centroid; radiances stay, so powers grow with the areas.
    LightScale,
}

impl Parameter {
    /// All parameters.
    pub const ALL: [Self; 8] = [
        Self::ReceiverX,
        Self::ReceiverY,
        Self::ReceiverZ,
        Self::ReceiverNormal,
        Self::LightX,
        Self::LightY,
        Self::LightZ,
        Self::LightScale,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::ReceiverX => "receiver.x",
            Self::ReceiverY => "receiver.y",
            Self::ReceiverZ => "receiver.z",
            Self::ReceiverNormal => "receiver.normal",
            Self::LightX => "light.x",
            Self::LightY => "light.y",
            Self::LightZ => "light.z",
            Self::LightScale => "light.scale",
        }
    }

    /// The parameter of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|parameter| parameter.name() == name)
    }
}

impl Serialize for Parameter {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// How steps are spaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Spacing {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Log,
}

/// A parameter and the values that it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    parameter: Parameter,
    from: f64,
    to: f64,
    spacing: Spacing,
    steps: u32,
}

/// Most steps of a sweep.
pub const MOST_STEPS: u32 = 100_000;

/// A sweep that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SweepError {
    /// An end of the range is NaN or infinite.
    #[error("the range from {from} to {to} is not finite: give two finite numbers")]
    NotFinite {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
    },
    /// The range holds one value alone.
    #[error("the range begins and ends at {at}: give two different numbers")]
    Empty {
        /// First and last value.
        at: f64,
    },
    /// Ratios need positive numbers.
    #[error("steps of equal ratio need a range above zero, not {from} to {to}: leave out \"log\", or move the range")]
    NotPositive {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
    },
    /// A light of no size, or turned inside out.
    #[error("light.scale needs a range above zero, not {from} to {to}: 1 is the size that the scene gives")]
    BadScale {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
    },
    /// Too few or too many steps.
    #[error("a sweep has 2 to {MOST_STEPS} steps, both ends among them, not {steps}")]
    BadSteps {
        /// How many were asked for.
        steps: u32,
    },
}

impl Sweep {
    /// A sweep in `steps` values from `from` to `to`, both among them; either may be the larger.
    ///
    /// # Errors
    /// [`SweepError`] where there is no such sweep.
    pub fn new(parameter: Parameter, from: f64, to: f64, spacing: Spacing, steps: u32) -> Result<Self, SweepError> {
        let positive = from > 0.0 && to > 0.0;
        if !from.is_finite() || !to.is_finite() {
            Err(SweepError::NotFinite { from, to })
        } else if from == to {
            Err(SweepError::Empty { at: from })
        } else if spacing == Spacing::Log && !positive {
            Err(SweepError::NotPositive { from, to })
        } else if parameter == Parameter::LightScale && !positive {
            Err(SweepError::BadScale { from, to })
        } else if !(2..=MOST_STEPS).contains(&steps) {
            Err(SweepError::BadSteps { steps })
        } else {
            Ok(Self { parameter, from, to, spacing, steps })
        }
    }

    /// What moves.
    pub fn parameter(&self) -> Parameter {
        self.parameter
    }

    /// First and last value.
    pub fn range(&self) -> [f64; 2] {
        [self.from, self.to]
    }

    /// How steps are spaced.
    pub fn spacing(&self) -> Spacing {
        self.spacing
    }

    /// How many values it takes.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// The values' places, from 0 to 1 at equal distances.
    pub(crate) fn places(&self) -> impl Iterator<Item = f64> + use<> {
        let last = self.steps - 1;
        (0..=last).map(move |k| f64::from(k) / f64::from(last))
    }

    /// The value at a place `u` between 0, the first, and 1, the last: both are met exactly.
    pub(crate) fn at(&self, u: f64) -> f64 {
        let between = |from: f64, to: f64| from * (1.0 - u) + to * u;
        match self.spacing {
            _ if u == 0.0 => self.from,
            _ if u == 1.0 => self.to,
            Spacing::Linear => between(self.from, self.to),
            Spacing::Log => between(self.from.ln(), self.to.ln()).exp(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Parameter, Spacing, Sweep, SweepError};

    fn sweep(from: f64, to: f64, spacing: Spacing, steps: u32) -> Result<Sweep, SweepError> {
        Sweep::new(Parameter::LightScale, from, to, spacing, steps)
    }

    #[test]
    fn both_ends_are_among_the_steps_and_ratios_are_equal() {
        let log = sweep(0.1, 10.0, Spacing::Log, 3).expect("a sweep");
        let values: Vec<f64> = log.places().map(|u| log.at(u)).collect();
        assert_eq!([values[0], values[2]], [0.1, 10.0]);
        assert!((values[1] - 1.0).abs() < 1e-15 && values.len() == 3, "{values:?}");
        let down = sweep(3.0, 1.0, Spacing::Linear, 5).expect("a sweep");
        assert_eq!(down.places().map(|u| down.at(u)).collect::<Vec<_>>(), [3.0, 2.5, 2.0, 1.5, 1.0]);
    }

    #[test]
    fn what_is_no_sweep_is_refused() {
        use Spacing::{Linear, Log};
        for (from, to, spacing, steps, says) in [
            (f64::NAN, 1.0, Linear, 3, "not finite"),
            (1.0, f64::INFINITY, Linear, 3, "not finite"),
            (1.0, 1.0, Linear, 3, "begins and ends at 1"),
            (0.0, 1.0, Log, 3, "leave out \"log\""),
            (-1.0, 1.0, Linear, 3, "light.scale needs"),
            (1.0, 2.0, Linear, 1, "2 to 100000 steps"),
            (1.0, 2.0, Linear, 100_001, "2 to 100000 steps"),
        ] {
            let refused = sweep(from, to, spacing, steps).map_err(|error| error.to_string());
            assert!(refused.as_ref().is_err_and(|error| error.contains(says)), "{refused:?}");
        }
    }

    #[test]
    fn every_name_is_read_as_it_is_written() {
        for parameter in Parameter::ALL {
            assert_eq!(Parameter::named(parameter.name()), Some(parameter));
        }
        assert_eq!(Parameter::named("light.w"), None);
    }
}
