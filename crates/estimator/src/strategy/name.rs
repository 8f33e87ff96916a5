//! Names of strategies, written and read.

use std::fmt;
use std::str::FromStr;

use super::{Member, Strategy, Team, Weighting};
use crate::nearest::nearest;
use crate::technique::Technique;

const MIS: &str = "mis/";
const MIXTURE: &str = "mixture/";
const RESAMPLED: &str = "ris/";
const RATIO: &str = "ratio";
const CONTROL: &str = "control-variate";
/// Most candidates of a resampled estimate.
const MOST_CANDIDATES: u32 = 1024;

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Single(technique) => technique.fmt(f),
            Self::Mis(weighting, team) => write!(f, "{MIS}{weighting}{team}"),
            Self::Mixture(share, pair) if *pair == Self::PAIR => write!(f, "{MIXTURE}{share}"),
            Self::Mixture(share, [one, other]) => write!(f, "{MIXTURE}{share}({one},{other})"),
            Self::Resampled(candidates) => write!(f, "{RESAMPLED}{candidates}"),
            Self::Ratio => f.write_str(RATIO),
            Self::ControlVariate => f.write_str(CONTROL),
        }
    }
}

/// A name that no strategy has, or none that could be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("strategy \"{name}\": {why}")]
pub struct UnknownStrategy {
    /// What was asked for.
    pub name: String,
    /// Why it cannot be had, and what can.
    pub why: String,
}

impl FromStr for Strategy {
    type Err = UnknownStrategy;

    fn from_str(name: &str) -> Result<Self, UnknownStrategy> {
        read(name).map_err(|why| UnknownStrategy { name: name.to_owned(), why })
    }
}

fn read(name: &str) -> Result<Strategy, String> {
    let (head, inside) = brackets(name)?;
    if let Some(weighting) = head.strip_prefix(MIS) {
        let weighting = Weighting::of_name(weighting).map_err(|why| why.unwrap_or_else(|| unknown(name)))?;
        let team = inside.map_or_else(|| Ok(Team::default()), |inside| Team::new(&members(inside)?))?;
        return Ok(Strategy::Mis(weighting, team));
    }
    if let Some(share) = head.strip_prefix(MIXTURE) {
        let share = number(share).filter(|share| (0.0..=1.0).contains(share));
        let share = share.ok_or_else(|| format!("a mixture needs a share from 0 to 1, as in {MIXTURE}0.5"))?;
        return Ok(Strategy::Mixture(share, inside.map_or(Ok(Strategy::PAIR), pair)?));
    }
    if inside.is_some() {
        return Err(format!("only {MIS}… and {MIXTURE}… take techniques in brackets"));
    }
    if let Some(candidates) = head.strip_prefix(RESAMPLED) {
        let candidates = candidates.parse().ok().filter(|m| (1..=MOST_CANDIDATES).contains(m));
        let wanted = || format!("{RESAMPLED}M needs a number M of candidates from 1 to {MOST_CANDIDATES}");
        return candidates.map(Strategy::Resampled).ok_or_else(wanted);
    }
    match head {
        RATIO => Ok(Strategy::Ratio),
        CONTROL => Ok(Strategy::ControlVariate),
        _ => alone(head).map(Strategy::Single),
    }
}

/// A name's part before brackets, and what stands in them.
fn brackets(name: &str) -> Result<(&str, Option<&str>), String> {
    match name.split_once('(') {
        None => Ok((name, None)),
        Some((head, rest)) => match rest.strip_suffix(')') {
            Some(inside) => Ok((head, Some(inside))),
            None => Err("its brackets are not closed".to_owned()),
        },
    }
}

fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

fn technique(name: &str) -> Result<Technique, String> {
    let is_combination =
        || [MIS, MIXTURE, RESAMPLED].iter().any(|head| name.starts_with(head)) || [RATIO, CONTROL].contains(&name);
    let why = |()| if is_combination() { format!("{name} is no technique but a combination") } else { unknown(name) };
    name.parse().map_err(why)
}

/// A technique that no other need stand beside.
fn alone(name: &str) -> Result<Technique, String> {
    let technique = technique(name)?;
    if technique.selection.stands_alone() {
        return Ok(technique);
    }
    Err(format!(
        "{technique} never picks a light of which hemisphere/cosine gives enough, so it would be biased anywhere but in a \
         team of two with it: take {MIS}balance({technique},hemisphere/cosine)"
    ))
}

fn members(inside: &str) -> Result<Vec<Member>, String> {
    let member = |part: &str| {
        let (name, samples) = part.split_once(':').unwrap_or((part, "1"));
        let samples = samples.trim().parse().map_err(|_| format!("\"{samples}\" is no number of samples"))?;
        Ok(Member { technique: technique(name.trim())?, samples })
    };
    inside.split(',').map(member).collect()
}

fn pair(inside: &str) -> Result<[Technique; 2], String> {
    let two: Vec<Technique> = inside.split(',').map(|name| alone(name.trim())).collect::<Result<_, _>>()?;
    let [one, other] = two[..] else { return Err(format!("a mixture is of two techniques, not {}", two.len())) };
    if one == other { Err(format!("\"{one}\" is named twice")) } else { Ok([one, other]) }
}

fn unknown(name: &str) -> String {
    let names: Vec<String> = Strategy::all().iter().map(ToString::to_string).collect();
    let nearest = nearest(name, &names).unwrap_or_default();
    format!("there is none of this name; did you mean \"{nearest}\"? (all: {})", names.join(", "))
}

#[cfg(test)]
mod tests {
    use super::Strategy;

    #[test]
    fn every_name_is_read_as_it_is_written() {
        let more = [
            "mixture/0.25",
            "mixture/0.5(area/uniform@power,hemisphere/uniform)",
            "mis/balance(area/uniform:2,hemisphere/cosine)",
            "mis/power(area/uniform@uniform,hemisphere/cosine:3,hemisphere/uniform)",
            "ris/32",
            "mis/optimal-pilot/256",
            "mis/optimal-pilot/16(area/solid-angle,hemisphere/cosine:2)",
            "mis/power(hemisphere/cosine:3,area/solid-angle@compensated:2)",
        ];
        let names = Strategy::all().into_iter().map(|strategy| strategy.to_string());
        for name in names.chain(more.map(str::to_owned)) {
            assert_eq!(name.parse::<Strategy>().map(|strategy| strategy.to_string()), Ok(name.clone()));
        }
        let default: Result<Strategy, _> = "mis/balance(area/uniform:1, hemisphere/cosine:1)".parse();
        assert_eq!(default.map(|strategy| strategy.to_string()).as_deref(), Ok("mis/balance"));
    }

    #[test]
    fn other_names_are_refused_with_the_reason() {
        for (name, reason) in [
            ("area/unifrom", "there is none of this name; did you mean \"area/uniform\""),
            ("hemispher/cosine", "did you mean \"hemisphere/cosine\""),
            ("", "did you mean"),
            ("hemisphere/cosine@power", "did you mean"),
            ("mixture/2", "from 0 to 1"),
            ("mixture/NaN", "from 0 to 1"),
            ("mixture/0.5(area/uniform)", "two techniques"),
            ("mis/optimal(area/uniform)", "two or three"),
            ("mis/balance(ratio,hemisphere/cosine)", "ratio is no technique but a combination"),
            ("mis/balance(area/uniform,area/uniform)", "twice"),
            ("mis/balance(area/uniform:0,hemisphere/cosine)", "samples"),
            ("mis/balance(area/uniform,hemisphere/cosine", "not closed"),
            ("ris/0", "candidates"),
            ("mis/optimal-pilot/0", "pilot samples"),
            ("area/uniform(hemisphere/cosine)", "brackets"),
            ("area/uniform@compensated", "mis/balance(area/uniform@compensated,hemisphere/cosine)"),
            ("mixture/0.5(area/uniform@compensated,hemisphere/cosine)", "biased anywhere but in a team of two"),
            ("mis/balance(area/uniform@compensated,hemisphere/uniform)", "what hemisphere/cosine leaves"),
            ("mis/balance(area/uniform@compensated,hemisphere/cosine,hemisphere/uniform)", "a team of two"),
            ("mis/balance(area/uniform@compensated,area/solid-angle@compensated)", "what hemisphere/cosine leaves"),
        ] {
            let error = name.parse::<Strategy>().map_err(|unknown| unknown.to_string());
            assert!(error.as_ref().is_err_and(|error| error.contains(reason)), "{name}: {error:?}");
        }
    }
}
