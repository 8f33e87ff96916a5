//! The variance of one sample of each strategy.

use std::f64::consts::PI;

use crate::error::Error;
use crate::law::{Colours, Law, Outcome};
use crate::mis::{self, Members};
use crate::optimal::Optimal;
use crate::picked::{self, Draw, Method};
use crate::seen::Seen;
use crate::sight::Sight;
use crate::value::{EPSILON, Value};
use twoforms_estimator::selection::Selection;
use twoforms_estimator::strategy::{Strategy, Team, Weighting};
use twoforms_estimator::technique::{Kind, Technique};

/// Relative error bound above which edge sums give way to cubature.
const TOO_ROUGH: f64 = 1e-9;

/// The channel of the luminance, after red, green and blue.
const LUMINANCE: usize = 3;

/// Whether the variance of a strategy is known here: by a closed form or by cubature.
pub fn has_formula(strategy: Strategy) -> bool {
    match strategy {
        Strategy::Mixture(1.0, [technique, _]) | Strategy::Mixture(0.0, [_, technique]) => is_known(technique),
        Strategy::Mis(Weighting::Pilot(_), _) | Strategy::Resampled(_) | Strategy::Ratio => false,
        Strategy::Single(_) | Strategy::Mis(..) | Strategy::Mixture(..) => {
            strategy.techniques().into_iter().all(is_known)
        }
        Strategy::ControlVariate => true,
    }
}

/// How the variance of a technique comes about.
enum Formula {
    /// Over the hemisphere, by c and k of [`Sight::over_hemisphere`].
    Hemisphere(f64, usize),
    /// Over the lights, uniform in a measure.
    Lights(Draw),
    /// Over the lights in proportion to what they emit.
    Luminance,
}

/// That of a kind of techniques; `None` where no formula is known.
fn formula(kind: Kind) -> Option<Formula> {
    match kind {
        Kind::HemisphereUniform => Some(Formula::Hemisphere(2.0 * PI, 2)),
        // f_r is constant, so that its own density is the cosine.
        Kind::HemisphereCosine | Kind::HemisphereBrdf => Some(Formula::Hemisphere(PI, 1)),
        Kind::AreaUniform | Kind::HemisphereTowardLights => Some(Formula::Lights(Draw::Uniform)),
        Kind::AreaSolidAngle => Some(Formula::Lights(Draw::SolidAngle)),
        Kind::AreaBilinearCosine => Some(Formula::Lights(Draw::BilinearCosine)),
        Kind::AreaProjectedSolidAngle => Some(Formula::Lights(Draw::ProjectedSolidAngle)),
        Kind::AreaLuminance => Some(Formula::Luminance),
        Kind::HemisphereTowardLightsMarginal => None,
    }
}

fn is_known(technique: Technique) -> bool {
    formula(technique.kind).is_some()
}

/// All strategies whose variance is known here; combinations by some of their many names.
pub fn with_formula() -> Vec<Strategy> {
    Strategy::all().into_iter().filter(|&strategy| has_formula(strategy)).collect()
}

impl Sight {
    /// V = E\[w²\] − E² of one sample of a strategy (of one pair for `mis`).
    ///
    /// # Errors
    /// The reason why there is no value: cubature that does not converge, or a selection that never
    /// picks a light that contributes.
    pub fn variance(&self, strategy: Strategy) -> Result<Value, Error> {
        if let Some(reflected) = &self.reflected {
            return reflected.variance(self, strategy);
        }
        match strategy {
            Strategy::Single(technique) => self.of_technique(technique),
            Strategy::Mixture(0.0, [_, technique]) | Strategy::Mixture(1.0, [technique, _]) => {
                self.of_technique(technique)
            }
            Strategy::Mixture(share, pair) => self.sum_of_laws(&[(mis::mixture(self, share, pair)?, 1.0)]),
            Strategy::Mis(Weighting::Optimal, team) => self.optimal(team),
            Strategy::Mis(weighting, team) => {
                let members = Members::new(self, team)?;
                let laws = members.laws(self, weighting)?.into_iter().enumerate();
                self.sum_of_laws(&laws.map(|(k, law)| (law, members.samples(k))).collect::<Vec<_>>())
            }
            Strategy::ControlVariate => self.control_variate(),
            Strategy::Resampled(_) | Strategy::Ratio => Err(Error::NoFormula),
        }
    }

    fn of_technique(&self, Technique { kind, selection }: Technique) -> Result<Value, Error> {
        match formula(kind).ok_or(Error::NoFormula)? {
            Formula::Hemisphere(c, k) => self.over_hemisphere(c, k),
            Formula::Lights(draw) => self.over_lights(draw, selection),
            Formula::Luminance => self.sum_of_laws(&[(picked::by_luminance(self)?, 1.0)]),
        }
    }

    /// The variances of several strategies, each or the reason why there is none.
    pub fn variances(&self, strategies: &[Strategy]) -> Vec<(Strategy, Result<Value, Error>)> {
        strategies.iter().map(|&strategy| (strategy, self.variance(strategy))).collect()
    }

    /// w = c L a or c L with E[w²] = c Σ ∫ L² aᵏ dω: c = 2π and k = 2 for p = 1/2π, c = π and k = 1 for
    /// p = cosθ_x/π.
    fn over_hemisphere(&self, c: f64, k: usize) -> Result<Value, Error> {
        let squared = self.seen.iter().map(|seen| seen.squared(k)).collect::<Result<Vec<_>, _>>()?;
        Ok(Value::of_outcomes(|channel| {
            let mut outcome = Outcome::default();
            let (mut second, mut second_error) = (0.0, 0.0);
            for (seen, squared) in self.seen.iter().zip(&squared) {
                let [mean, mean_error] = seen.in_channel(channel);
                outcome.mean += mean;
                outcome.mean_error += mean_error;
                second += c * squared[channel][0];
                second_error += c * squared[channel][1];
            }
            outcome.variance = second - outcome.mean * outcome.mean;
            outcome.error = second_error + 2.0 * outcome.mean * outcome.mean_error + 8.0 * EPSILON * second;
            outcome
        }))
    }

    fn over_lights(&self, draw: Draw, selection: Selection) -> Result<Value, Error> {
        let colours = self.colours();
        let by_edges = picked::law(self, draw, selection, Method::Edges)?.variance(&colours);
        if draw == Draw::ProjectedSolidAngle || by_edges.error_bound <= TOO_ROUGH * by_edges.luminance {
            return Ok(by_edges);
        }
        let law = picked::law(self, draw, selection, Method::Cubature)?;
        self.consistent(law.outcome(&colours, LUMINANCE))?;
        let by_cubature = law.variance(&colours);
        Ok(if by_cubature.error_bound < by_edges.error_bound { by_cubature } else { by_edges })
    }

    /// So many independent samples of each law are added, so their variances add up.
    fn sum_of_laws(&self, laws: &[(Law, f64)]) -> Result<Value, Error> {
        let colours = self.colours();
        let sum = |channel: usize| {
            let outcomes = laws.iter().map(|(law, n)| (law.outcome(&colours, channel), n));
            outcomes.fold(Outcome::default(), |sum, (o, n)| Outcome {
                mean: sum.mean + n * o.mean,
                mean_error: sum.mean_error + n * o.mean_error,
                variance: sum.variance + n * o.variance,
                error: sum.error + n * o.error,
            })
        };
        self.consistent(sum(LUMINANCE))?;
        Ok(Value::of_outcomes(sum))
    }

    /// w = U − h with h the hidden part of the sample: V = E\[h²\] − E\[h\]², and E\[h²\] = A Σ L² (M_23 unhidden − M_23)/s².
    /// Where a light emits by a texture, what is known is the light of its mean.
    fn control_variate(&self) -> Result<Value, Error> {
        if self.seen.iter().any(|seen| seen.glow.is_some()) {
            return Err(Error::NoFormula);
        }
        let (colours, area) = (self.colours(), self.total_area());
        let hidden = || self.seen.iter().zip(&colours.0).filter(|(seen, _)| seen.blocked);
        Ok(Value::of_outcomes(|channel| {
            let (mut first, mut first_error, mut second, mut error) = (0.0, 0.0, 0.0, 0.0);
            for (Seen { open, moments, facet, .. }, colour) in hidden() {
                let radiance = colour[channel];
                let square = area * radiance * radiance / (facet.s * facet.s);
                first += radiance * (open.m10 - moments.m10);
                first_error += radiance * (open.errors[1] + moments.errors[1]);
                second += square * (open.m23 - moments.m23);
                let plane = 16.0 * EPSILON * facet.reach / facet.s * (open.m23.abs() + moments.m23.abs());
                error += square * (open.error + moments.error + plane);
            }
            let variance = second - first * first;
            let error = error + 2.0 * first * first_error + 16.0 * EPSILON * second.abs();
            Outcome { mean: first, mean_error: first_error, variance, error }
        }))
    }

    /// α of a team's techniques with the weights of least variance, RGB.
    ///
    /// # Errors
    /// [`Error::NotConverged`]; [`Error::NoFormula`] where a density of the team is not known; [`Error::NotConstant`] of a reflected
    /// sight.
    pub fn optimal_alpha(&self, team: Team) -> Result<Vec<[f64; 3]>, Error> {
        if self.reflected.is_some() {
            return Err(Error::NotConstant);
        }
        let alpha = Optimal::new(self, Members::new(self, team)?)?.alpha();
        Ok((0..team.members().count()).map(|k| [0, 1, 2].map(|channel| alpha[channel][k])).collect())
    }

    fn optimal(&self, team: Team) -> Result<Value, Error> {
        let outcomes = Optimal::new(self, Members::new(self, team)?)?.outcomes()?;
        self.consistent(outcomes[LUMINANCE])?;
        Ok(Value::of_outcomes(|channel| outcomes[channel]))
    }

    /// Refuses a variance whose own mean is not the irradiance.
    pub(crate) fn consistent(&self, outcome: Outcome) -> Result<(), Error> {
        let irradiance = self.irradiance();
        let allowed = 1e-9 * irradiance.luminance + irradiance.error_bound + outcome.mean_error;
        if (outcome.mean - irradiance.luminance).abs() <= allowed {
            return Ok(());
        }
        Err(Error::Inconsistent { mean: outcome.mean, irradiance: irradiance.luminance })
    }

    fn colours(&self) -> Colours {
        let colour = |seen: &Seen| [seen.radiance[0], seen.radiance[1], seen.radiance[2], seen.luminance];
        Colours(self.seen.iter().map(colour).collect())
    }
}
