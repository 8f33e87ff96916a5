//! Sweeps as the command line and files write them: `PARAM=FROM:TO[:log]:STEPS`.

use std::str::FromStr;

use twoforms_estimator::nearest::nearest;

use crate::sweep::{Parameter, Spacing, Sweep};

const FORM: &str = "the form is PARAM=FROM:TO[:log]:STEPS, as in receiver.y=0.1:10:log:25";

/// What a text that is no sweep lacks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct NoSweep(String);

impl FromStr for Sweep {
    type Err = NoSweep;

    fn from_str(text: &str) -> Result<Self, NoSweep> {
        sweep(text).map_err(NoSweep)
    }
}

fn sweep(text: &str) -> Result<Sweep, String> {
    let (name, range) = text.split_once('=').ok_or_else(|| format!("has no \"=\"; {FORM}"))?;
    let parameter = parameter(name.trim())?;
    let parts: Vec<&str> = range.split(':').map(str::trim).collect();
    let (from, to, spacing, steps) = match parts[..] {
        [from, to, steps] => (from, to, Spacing::Linear, steps),
        [from, to, "log", steps] => (from, to, Spacing::Log, steps),
        [_, _, other, _] => return Err(format!("\"{other}\" stands where only \"log\" can; {FORM}")),
        _ => return Err(format!("has {} parts after \"=\" where 3 or 4 are needed; {FORM}", parts.len())),
    };
    let steps = steps.parse().map_err(|_| format!("\"{steps}\" is not a number of steps; {FORM}"))?;
    Sweep::new(parameter, number(from)?, number(to)?, spacing, steps).map_err(|error| error.to_string())
}

fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| format!("\"{text}\" is not a number; {FORM}"))
}

fn parameter(name: &str) -> Result<Parameter, String> {
    Parameter::named(name).ok_or_else(|| {
        let names = Parameter::ALL.map(Parameter::name);
        let nearest = nearest(name, &names).unwrap_or_default();
        format!("there is no parameter \"{name}\"; did you mean \"{nearest}\"? (all: {})", names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::sweep;
    use crate::sweep::{Parameter, Spacing, Sweep};

    #[test]
    fn sweeps_are_read() {
        let read = |text| sweep(text).expect("a sweep");
        let made =
            |parameter, from, to, spacing, steps| Sweep::new(parameter, from, to, spacing, steps).expect("a sweep");
        assert_eq!(read("receiver.y=-1:2.5:8"), made(Parameter::ReceiverY, -1.0, 2.5, Spacing::Linear, 8));
        assert_eq!(read("light.scale = 1e-1:10:log:37"), made(Parameter::LightScale, 0.1, 10.0, Spacing::Log, 37));
    }

    #[test]
    fn what_is_no_sweep_is_refused_with_what_is_wrong() {
        for (text, says) in [
            ("receiver.y", "no \"=\""),
            ("recever.y=0:1:5", "did you mean \"receiver.y\"?"),
            ("light=0:1:5", "did you mean \"light.x\"?"),
            ("light.x=0:1", "2 parts"),
            ("light.x=0:1:log:5:6", "5 parts"),
            ("light.x=1:2:lin:5", "\"lin\" stands where only \"log\""),
            ("light.x=a:1:5", "\"a\" is not a number"),
            ("light.x=0:1:-5", "\"-5\" is not a number of steps"),
            ("light.x=0:inf:5", "not finite"),
            ("light.x=NaN:1:5", "not finite"),
            ("light.x=0:1:1", "2 to 100000"),
            ("light.x=0:1:log:5", "above zero"),
            ("light.scale=-1:1:5", "above zero"),
            ("light.x=3:3:5", "different numbers"),
        ] {
            assert!(sweep(text).is_err_and(|error| error.contains(says)), "{text}: {:?}", sweep(text));
        }
    }
}
