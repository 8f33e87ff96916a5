//! Strategies with what they need of a scene, and of one x.

use super::{AREA, MOST, Strategy, Team, Weighting};
use crate::combination::{ControlVariate, Mis, Mixture, Ratio, Resampled, Shadow, Split};
use crate::density::{AreaOnLights, ByArea, OnLights, Ready};
use crate::estimator::Estimator;
use crate::lights::Lights;
use crate::query::Query;
use crate::technique::{Prepared as PreparedTechnique, Technique};
use crate::xi::Key;
use twoforms_geometry::view::View;

/// A strategy with what it needs of one scene.
#[derive(Clone, Debug)]
pub struct Prepared {
    strategy: Strategy,
    techniques: Vec<PreparedTechnique>,
    points: AreaOnLights,
}

/// What is known of the light at x beforehand, for strategies that use it.
#[derive(Clone, Debug)]
pub struct Known {
    /// α_i of the techniques of teams with optimal weights, RGB.
    pub alpha: Vec<(Team, Vec<[f64; 3]>)>,
    /// What x would receive were nothing in between, RGB, where f_r is not the same for all directions.
    pub unoccluded: Option<[f64; 3]>,
    /// The key of pilot samples.
    pub key: Key,
}

/// Nothing is known.
impl Default for Known {
    fn default() -> Self {
        Self { alpha: Vec::new(), unoccluded: None, key: Key::new([]) }
    }
}

impl Known {
    /// α_i of a team, RGB, if they are known.
    pub fn alpha(&self, team: Team) -> Option<&[[f64; 3]]> {
        self.alpha.iter().find(|(known, _)| *known == team).map(|(_, alpha)| &alpha[..])
    }
}

impl Strategy {
    /// Builds what the strategy needs once per scene. The scene must have a light.
    pub fn prepare(self, lights: &Lights) -> Prepared {
        let techniques = self.techniques().iter().map(|technique| technique.prepare(lights)).collect();
        Prepared { strategy: self, techniques, points: AreaOnLights::prepare(lights, AREA.selection) }
    }

    /// Whether it uses what x would receive were nothing in between, which must be known beforehand where f_r is not the same
    /// for all directions: [`Known::unoccluded`].
    pub fn needs_unoccluded(self) -> bool {
        matches!(self, Self::Ratio | Self::ControlVariate)
    }

    /// The team whose α must be known beforehand, if one must: see [`Known::alpha`].
    pub fn needs_alpha(self) -> Option<Team> {
        match self {
            Self::Mis(Weighting::Optimal, team) => Some(team),
            _ => None,
        }
    }

    /// Why the strategy can't be sampled in an image, if it can't.
    pub fn impossible_in_images(self) -> Option<String> {
        let needs = |_| {
            format!("\"{self}\" needs the α of each point, which an image does not know: take mis/optimal-pilot/64")
        };
        self.needs_alpha().map(needs)
    }

    /// Pairs of random numbers that a sample takes.
    pub fn pairs(self) -> usize {
        match self {
            Self::Mis(_, team) => team.members().map(|member| member.samples as usize).sum(),
            Self::Resampled(candidates) => candidates as usize + 1,
            _ => 1,
        }
    }

    /// The techniques that it draws samples of.
    pub fn techniques(self) -> Vec<Technique> {
        match self {
            Self::Single(technique) => vec![technique],
            Self::Mis(_, team) => team.members().map(|member| member.technique).collect(),
            Self::Mixture(_, pair) => pair.to_vec(),
            Self::Resampled(_) | Self::Ratio | Self::ControlVariate => vec![AREA],
        }
    }
}

impl Prepared {
    /// Which strategy it is.
    pub fn strategy(&self) -> Strategy {
        self.strategy
    }

    /// Whether each x needs an estimator of its own, so that a view of many x has none.
    pub fn depends_on_x(&self) -> bool {
        let by_itself = match self.strategy {
            Strategy::Mis(weighting, _) => matches!(weighting, Weighting::Optimal | Weighting::Pilot(_)),
            strategy => strategy.needs_unoccluded(),
        };
        by_itself || self.techniques.iter().any(PreparedTechnique::depends_on_x)
    }

    /// The strategy's estimator at x. An α that should be known and is not is zero, which leaves the weights of the balance
    /// heuristic. Where the strategy needs what x would receive were nothing in between, and neither a closed form nor `known`
    /// has it, no estimate is a number.
    pub fn at<'a>(&'a self, view: &'a View<'a>, query: &'a Query<'a>, known: &Known) -> Box<dyn Estimator + 'a> {
        let at = |k: usize| self.techniques[k].at(view, query);
        let pairs = self.strategy.pairs();
        match self.strategy {
            Strategy::Single(_) => self.techniques[0].boxed(view, query),
            Strategy::Mis(weighting, team) => {
                let locals = team.members().enumerate().map(|(k, member)| (at(k), member.samples)).collect();
                let mis = Mis { view, query, team: locals, pairs, weighting, alpha: Vec::new(), setup_rays: 0 };
                Box::new(match weighting {
                    Weighting::Optimal => {
                        Mis { alpha: known.alpha(team).map_or_else(|| vec![[0.0; 3]; MOST], rounded), ..mis }
                    }
                    Weighting::Pilot(samples) => mis.pilot(view, samples, known.key),
                    _ => mis,
                })
            }
            Strategy::Mixture(share, _) => {
                Box::new(Mixture { view, query, pair: [at(0), at(1)], split: Split::new(share) })
            }
            Strategy::Resampled(candidates) => {
                Box::new(Resampled { view, query, density: self.points(view, query), candidates, pairs })
            }
            Strategy::Ratio => Box::new(Ratio { shadow: self.shadow(view, query, known) }),
            Strategy::ControlVariate => Box::new(ControlVariate { shadow: self.shadow(view, query, known) }),
        }
    }

    fn points(&self, view: &View, query: &Query) -> OnLights<'_, ByArea> {
        self.points.at(view, query)
    }

    fn shadow<'a>(&'a self, view: &'a View<'a>, query: &'a Query<'a>, known: &Known) -> Shadow<'a> {
        let unoccluded = query.unoccluded(view).or(known.unoccluded).unwrap_or([f64::NAN; 3]);
        Shadow { view, query, density: self.points(view, query), unoccluded }
    }
}

fn rounded(alpha: &[[f64; 3]]) -> Vec<[f32; 3]> {
    alpha.iter().map(|alpha| alpha.map(|alpha| alpha as f32)).collect()
}
