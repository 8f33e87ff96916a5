//! Teams: which techniques are weighted together, and how many samples each draws.

use std::fmt;

use super::{AREA, COSINE};
use crate::compensation::Compensation;
use crate::selection::Selection;
use crate::technique::Technique;

/// Most techniques of a team.
pub const MOST: usize = 3;
/// Most samples that a technique of a team draws.
const MOST_SAMPLES: u32 = 64;

/// A technique of a team.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Member {
    /// The technique.
    pub technique: Technique,
    /// n: samples it draws for one sample of the team.
    pub samples: u32,
}

/// Two or three techniques, none of them twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Team {
    first: [Member; 2],
    third: Option<Member>,
}

/// One sample of `area/uniform` and one of `hemisphere/cosine`.
impl Default for Team {
    fn default() -> Self {
        let one = |technique| Member { technique, samples: 1 };
        Self { first: [one(AREA), one(COSINE)], third: None }
    }
}

impl Team {
    /// `area/uniform@compensated` with `hemisphere/cosine`, one sample of each.
    pub(super) fn compensated() -> Self {
        let Self { first: [area, cosine], third } = Self::default();
        let selection = Selection::Compensated(Compensation::default());
        Self { first: [Member { technique: Technique { selection, ..area.technique }, ..area }, cosine], third }
    }

    /// A team of these members. A selection that compensates for the cosine learns how many samples there are of each.
    ///
    /// # Errors
    /// Why they are none: too few or too many, one of them twice, no samples, or a selection that needs another team.
    pub fn new(members: &[Member]) -> Result<Self, String> {
        let twice = |k: usize| members[..k].iter().any(|other| other.technique == members[k].technique);
        if let Some(k) = (0..members.len()).find(|&k| twice(k)) {
            return Err(format!("\"{}\" is named twice; give it samples instead, as in :2", members[k].technique));
        }
        if let Some(member) = members.iter().find(|member| !(1..=MOST_SAMPLES).contains(&member.samples)) {
            return Err(format!("\"{}\" needs 1 to {MOST_SAMPLES} samples", member.technique));
        }
        match *members {
            [one, two] => Ok(Self { first: [beside(one, two)?, beside(two, one)?], third: None }),
            [..] if members.iter().any(|member| !member.technique.selection.stands_alone()) => Err(COSINE_ALONE.into()),
            [one, two, three] => Ok(Self { first: [one, two], third: Some(three) }),
            _ => Err(format!("{} technique(s) named where two or three are weighted together", members.len())),
        }
    }

    /// The members in order.
    pub fn members(&self) -> impl Iterator<Item = Member> + use<> {
        self.first.into_iter().chain(self.third)
    }
}

/// What a selection that compensates needs.
const COSINE_ALONE: &str = "\"@compensated\" picks what hemisphere/cosine leaves of each light: it needs a team of two, \
                            as in mis/balance(area/uniform@compensated,hemisphere/cosine)";

/// A member as it is in a team of two.
fn beside(member: Member, other: Member) -> Result<Member, String> {
    match member.technique.selection {
        Selection::Compensated(_) if other.technique == COSINE => {
            let [own, cosine] = [member, other].map(|member| member.samples as u8); // at most [`MOST_SAMPLES`]
            let selection = Selection::Compensated(Compensation { own, cosine });
            Ok(Member { technique: Technique { selection, ..member.technique }, ..member })
        }
        Selection::Compensated(_) => Err(COSINE_ALONE.into()),
        _ => Ok(member),
    }
}

/// `(technique[:samples],…)`; nothing for the default team.
impl fmt::Display for Team {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::default() {
            return Ok(());
        }
        let name = |Member { technique, samples }: Member| match samples {
            1 => technique.to_string(),
            n => format!("{technique}:{n}"),
        };
        write!(f, "({})", self.members().map(name).collect::<Vec<_>>().join(","))
    }
}
