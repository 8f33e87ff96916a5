//! The variance of one sample of each strategy.

use std::f64::consts::PI;

use crate::error::Error;
use crate::law::{Colours, Law, Outcome};
use crate::mis::{self, Optimal};
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
        Strategy::Single(technique) => technique.kind != Kind::HemisphereTowardLightsMarginal,
        Strategy::Mixture(share, [one, other]) => match share {
            1.0 => has_formula(one.into()),
            0.0 => has_formula(other.into()),
            _ => [one, other] == Strategy::PAIR,
        },
        Strategy::Mis(weighting, team) => {
            team == Team::default() && !matches!(weighting, Weighting::Cutoff | Weighting::Maximum)
        }
        Strategy::Resampled(_) | Strategy::Ratio | Strategy::ControlVariate => false,
    }
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
        match strategy {
            Strategy::Single(technique) => self.of_technique(technique),
            Strategy::Mixture(0.0, [_, technique]) | Strategy::Mixture(1.0, [technique, _]) => {
                self.of_technique(technique)
            }
            Strategy::Mixture(a, pair) if pair == Strategy::PAIR => self.sum_of_laws(&[mis::mixture(self, a)?]),
            Strategy::Mis(weighting, team) if team == Team::default() => match weighting {
                Weighting::Balance => self.sum_of_laws(&mis::balance(self)?),
                Weighting::Power => self.sum_of_laws(&mis::power(self)?),
                Weighting::Optimal => self.optimal(),
                Weighting::Cutoff | Weighting::Maximum => Err(Error::NoFormula),
            },
            _ => Err(Error::NoFormula),
        }
    }

    fn of_technique(&self, Technique { kind, selection }: Technique) -> Result<Value, Error> {
        match kind {
            Kind::HemisphereUniform => self.over_hemisphere(2.0 * PI, 2),
            Kind::HemisphereCosine => self.over_hemisphere(PI, 1),
            Kind::AreaUniform | Kind::HemisphereTowardLights => self.over_lights(Draw::Uniform, selection),
            Kind::HemisphereTowardLightsMarginal => Err(Error::NoFormula),
            Kind::AreaSolidAngle => self.over_lights(Draw::SolidAngle, selection),
            Kind::AreaProjectedSolidAngle => self.over_lights(Draw::ProjectedSolidAngle, selection),
            Kind::AreaLuminance => self.sum_of_laws(&[picked::by_luminance(self)?]),
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

    /// Independent samples are added, so their variances add up.
    fn sum_of_laws(&self, laws: &[Law]) -> Result<Value, Error> {
        let colours = self.colours();
        let sum = |channel: usize| {
            let outcomes = laws.iter().map(|law| law.outcome(&colours, channel));
            outcomes.fold(Outcome::default(), |sum, o| Outcome {
                mean: sum.mean + o.mean,
                mean_error: sum.mean_error + o.mean_error,
                variance: sum.variance + o.variance,
                error: sum.error + o.error,
            })
        };
        self.consistent(sum(LUMINANCE))?;
        Ok(Value::of_outcomes(sum))
    }

    /// α of `area/uniform` and `hemisphere/cosine` with the weights of least variance, RGB.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn optimal_alpha(&self) -> Result<[[f64; 3]; 2], Error> {
        let (colours, optimal) = (self.colours(), Optimal::new(self)?);
        let channels = [0, 1, 2].map(|channel| optimal.alpha(&colours, channel).0);
        Ok([0, 1].map(|technique| channels.map(|alpha| alpha[technique])))
    }

    fn optimal(&self) -> Result<Value, Error> {
        let (colours, optimal) = (self.colours(), Optimal::new(self)?);
        let outcome = |channel: usize| optimal.outcome(&colours, channel);
        self.consistent(outcome(LUMINANCE))?;
        Ok(Value::of_outcomes(outcome))
    }

    /// Refuses a variance whose own mean is not the irradiance.
    fn consistent(&self, outcome: Outcome) -> Result<(), Error> {
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
