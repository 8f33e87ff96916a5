//! Light reflected by a surface with a highlight: f_r depends on Ψ, no closed form is known, and cubature over what x sees gives
//! the radiance and the variances.
//!
//! With F(y) = L_e f_r G per area and a density p(y) per area, a sample is worth F/p. Of a team of techniques with q_k = n_k p_k,
//! a sample of technique i is worth F/Σ q_k by the balance heuristic and F q_i/Σ q_k² by the power heuristic.

use std::f64::consts::PI;

use glam::DVec3;
use twoforms_estimator::glossy::{Glossy, MetallicRoughness};
use twoforms_estimator::rgb::luminance;
use twoforms_estimator::strategy::{Strategy, Team, Weighting};
use twoforms_estimator::technique::{Kind, Technique};

use crate::cubature::{Peak, integrate_near};
use crate::error::Error;
use crate::law::{Law, Outcome};
use crate::mis::missed_by_hemisphere;
use crate::outline::line_integral;
use crate::picked::{self, Draw, Method};
use crate::seen::Seen;
use crate::sight::Sight;
use crate::spread::by_cubature_near;
use crate::value::{EPSILON, Value};
use crate::visible::{Pieces, above_horizon};

/// Red, green, blue, luminance.
const CHANNELS: usize = 4;
/// The relative error at which cubature of the radiance stops.
const FINE: f64 = 1e-12;

/// A surface with a highlight as an eye sees it, and the radiance that leaves it.
#[derive(Clone, Debug)]
pub(crate) struct Reflected {
    surface: MetallicRoughness,
    theta: [f64; 3],
    pub(crate) arriving: Value,
    pub(crate) unoccluded: Value,
}

impl Sight {
    /// The sight as a surface with a highlight reflects it toward the eye; its facets carry L_e as it is (f_r = 1).
    ///
    /// # Errors
    /// [`Error::BehindSurface`], [`Error::NotConverged`].
    pub fn reflected(mut self, glossy: &Glossy) -> Result<Self, Error> {
        // Θ as samples have it, rounded once.
        let theta = glossy.theta::<f32>(None).to_array().map(f64::from);
        if theta[2] <= 0.0 {
            return Err(Error::BehindSurface);
        }
        let (arriving, unoccluded) = (Value::default(), Value::default());
        let mut reflected = Reflected { surface: *glossy.surface(), theta, arriving, unoccluded };
        reflected.arriving = reflected.radiance(&self, |seen| seen.pieces.clone())?;
        let open = |seen: &Seen| Pieces::one(&above_horizon(&seen.facet).0);
        reflected.unoccluded = reflected.radiance(&self, open)?;
        self.reflected = Some(reflected);
        Ok(self)
    }
}

/// A density at a point of the facet with this number, per area.
type Pdf<'a> = dyn Fn(usize, &Seen, DVec3) -> f64 + 'a;

/// How a technique draws: its density at a point y of a facet, per area, and the probability of a sample worth zero with a
/// bound of its error.
struct Drawn<'a> {
    pdf: Box<Pdf<'a>>,
    hidden: f64,
    hidden_error: f64,
}

impl Reflected {
    /// V of one sample of a strategy (of one of each technique's n for a team).
    pub(crate) fn variance(&self, sight: &Sight, strategy: Strategy) -> Result<Value, Error> {
        match strategy {
            Strategy::Single(technique) => self.of_one(sight, &self.drawn(sight, technique)?),
            Strategy::Mixture(0.0, [_, technique]) | Strategy::Mixture(1.0, [technique, _]) => {
                self.of_one(sight, &self.drawn(sight, technique)?)
            }
            Strategy::Mixture(share, [one, other]) => {
                let (one, other) = (self.drawn(sight, one)?, self.drawn(sight, other)?);
                self.of_one(sight, &Drawn::mixed(share, one, other))
            }
            Strategy::Mis(Weighting::Balance, team) => self.of_team(sight, team, |q, _| 1.0 / q.iter().sum::<f64>()),
            Strategy::Mis(Weighting::Power, team) => {
                self.of_team(sight, team, |q, i| q[i] / q.iter().map(|q| q * q).sum::<f64>())
            }
            Strategy::Mis(Weighting::Optimal, _) => Err(Error::NotConstant),
            // Weights that jump keep cubature from converging.
            Strategy::Mis(Weighting::Cutoff | Weighting::Maximum, _)
            | Strategy::Resampled(_)
            | Strategy::Ratio
            | Strategy::ControlVariate => Err(Error::NoFormula),
        }
    }

    fn drawn<'a>(&'a self, sight: &'a Sight, Technique { kind, selection }: Technique) -> Result<Drawn<'a>, Error> {
        let law = |draw| picked::law(sight, draw, selection, Method::Edges);
        let on_lights = |draw| law(draw).map(|law| on_lights(draw, &law, sight));
        match kind {
            Kind::HemisphereUniform => Ok(uniform(sight)),
            Kind::HemisphereCosine => {
                let (hidden, hidden_error) = missed_by_hemisphere(sight);
                Ok(Drawn { pdf: Box::new(|_, seen, y| seen.g(y) / PI), hidden, hidden_error })
            }
            Kind::HemisphereBrdf => self.by_itself(sight),
            Kind::HemisphereTowardLights | Kind::AreaUniform => on_lights(Draw::Uniform),
            Kind::HemisphereTowardLightsMarginal => Err(Error::NoFormula),
            Kind::AreaSolidAngle => on_lights(Draw::SolidAngle),
            Kind::AreaProjectedSolidAngle => on_lights(Draw::ProjectedSolidAngle),
        }
    }

    /// The surface's own density; what it does not find is what is left of one.
    fn by_itself<'a>(&'a self, sight: &Sight) -> Result<Drawn<'a>, Error> {
        let pdf = |_, seen: &Seen, y: DVec3| self.surface.pdf(self.theta, direction(y)) * d_omega_d_area(seen, y);
        let (mut found, mut error) = (0.0, 4.0 * EPSILON);
        for (index, seen) in sight.seen.iter().enumerate().filter(|(_, seen)| seen.is_visible()) {
            let part = by_cubature_near(index, seen, Some(&self.peak()), |y| [1.0, pdf(index, seen, y)])?;
            found += part.mass;
            error += part.mass_error;
        }
        Ok(Drawn { pdf: Box::new(pdf), hidden: 1.0 - found, hidden_error: error })
    }

    fn of_one(&self, sight: &Sight, drawn: &Drawn) -> Result<Value, Error> {
        let worth = |index: usize, seen: &Seen, y: DVec3| {
            let pdf = (drawn.pdf)(index, seen, y);
            if pdf == 0.0 { 0.0 } else { 1.0 / pdf }
        };
        let laws = self.laws(sight, drawn, worth)?;
        checked(sight, &laws.map(|law| law.outcome(|_| 1.0)))
    }

    /// Samples are independent, so that their variances add up. `per_density` is w_i/q_i of the q_k and i.
    fn of_team(&self, sight: &Sight, team: Team, per_density: impl Fn(&[f64], usize) -> f64) -> Result<Value, Error> {
        let members: Vec<_> = team.members().collect();
        let drawn = members.iter().map(|member| self.drawn(sight, member.technique)).collect::<Result<Vec<_>, _>>()?;
        let mut sums = [Outcome::default(); CHANNELS];
        for (i, member) in members.iter().enumerate() {
            let worth = |index: usize, seen: &Seen, y: DVec3| {
                let q = |k: usize| f64::from(members[k].samples) * (drawn[k].pdf)(index, seen, y);
                let q: Vec<f64> = (0..members.len()).map(q).collect();
                if q.iter().all(|&q| q == 0.0) { 0.0 } else { per_density(&q, i) }
            };
            let laws = self.laws(sight, &drawn[i], worth)?;
            for (sum, law) in sums.iter_mut().zip(laws) {
                sum.add_samples(member.samples, &law.outcome(|_| 1.0));
            }
        }
        checked(sight, &sums)
    }

    /// The law of one sample in each channel, worth F times `per_density` at its point.
    fn laws(
        &self,
        sight: &Sight,
        drawn: &Drawn,
        per_density: impl Fn(usize, &Seen, DVec3) -> f64,
    ) -> Result<[Law; CHANNELS], Error> {
        let law = || Law { parts: Vec::new(), hidden: drawn.hidden, hidden_error: drawn.hidden_error };
        let mut laws = [(); CHANNELS].map(|()| law());
        for (index, seen) in sight.seen.iter().enumerate().filter(|(_, seen)| seen.is_visible()) {
            for (channel, law) in laws.iter_mut().enumerate() {
                let f = |y: DVec3| {
                    let worth = self.integrand(seen, y)[channel] * per_density(index, seen, y);
                    [worth, (drawn.pdf)(index, seen, y)]
                };
                law.parts.push(by_cubature_near(index, seen, Some(&self.peak()), f)?);
            }
        }
        Ok(laws)
    }

    /// F(y) = L_e f_r cosθ_x cosθ_y/r², in every channel.
    fn integrand(&self, seen: &Seen, y: DVec3) -> [f64; CHANNELS] {
        let (f_r, g) = (self.surface.f_r(self.theta, direction(y)), seen.g(y));
        let [r, g, b] = [0, 1, 2].map(|c| seen.radiance[c] * f_r[c] * g);
        [r, g, b, luminance([r, g, b])]
    }

    /// ∫ F dA over some part of every facet.
    fn radiance(&self, sight: &Sight, part: impl Fn(&Seen) -> Pieces) -> Result<Value, Error> {
        let (mut sum, mut error_bound) = ([0.0; CHANNELS], 0.0);
        for seen in sight.seen.iter().filter(|seen| seen.luminance > 0.0) {
            let (pieces, f) = (part(seen), |y: DVec3| self.integrand(seen, y));
            let slack = seen.slack_of(&seen.open) * self.peak().steepness();
            let relative = FINE.max(slack);
            let found = integrate_near(&pieces, Some(&self.peak()), f, |total| total.map(|v| relative * v))?;
            (0..CHANNELS).for_each(|c| sum[c] += found.value[c]);
            let outline = seen.open.shift * line_integral(&pieces, f)[3];
            error_bound += found.error[3] + outline + 2.0 * slack * found.value[3];
        }
        let [r, g, b, luminance] = sum;
        let rounding = EPSILON * (sight.seen.len() + 4) as f64 * luminance;
        Ok(Value { rgb: [r, g, b], luminance, error_bound: error_bound + rounding })
    }

    /// Around Θ mirrored at N_x. D's poles lie where the half vector is ±iα off N_x: 2α from there in the plane of Θ and N_x,
    /// 2α cosθ_o across it.
    fn peak(&self) -> Peak {
        let [x, y, z] = self.theta;
        Peak { toward: DVec3::new(-x, -y, z), width: 2.0 * self.surface.alpha() * z }
    }
}

impl Drawn<'_> {
    /// A p_1 + (1 − A) p_2.
    fn mixed(share: f64, one: Self, other: Self) -> Self {
        let mix = move |one: f64, other: f64| share * one + (1.0 - share) * other;
        Self {
            hidden: mix(one.hidden, other.hidden),
            hidden_error: mix(one.hidden_error, other.hidden_error),
            pdf: Box::new(move |index, seen, y| mix((one.pdf)(index, seen, y), (other.pdf)(index, seen, y))),
        }
    }
}

/// p(Ψ) = 1/2π.
fn uniform(sight: &Sight) -> Drawn<'static> {
    let found: f64 = sight.seen.iter().map(|seen| seen.moments.solid_angle).sum();
    let error: f64 = sight.seen.iter().map(|seen| seen.moments.errors[0]).sum();
    Drawn {
        pdf: Box::new(|_, seen, y| d_omega_d_area(seen, y) / (2.0 * PI)),
        hidden: 1.0 - found / (2.0 * PI),
        hidden_error: error / (2.0 * PI) + 4.0 * EPSILON,
    }
}

/// Points uniform in a measure over the lights: the density of each facet is the probability of its visible part over the measure
/// of that part.
fn on_lights(draw: Draw, law: &Law, sight: &Sight) -> Drawn<'static> {
    let mut shares = vec![0.0; sight.seen.len()];
    for part in &law.parts {
        let seen = &sight.seen[part.seen];
        shares[part.seen] = part.mass
            / match draw {
                Draw::Uniform => seen.visible_area,
                Draw::SolidAngle => seen.moments.solid_angle,
                Draw::ProjectedSolidAngle => seen.moments.m10,
            };
    }
    let per_area = move |seen: &Seen, y: DVec3| match draw {
        Draw::Uniform => 1.0,
        Draw::SolidAngle => d_omega_d_area(seen, y),
        Draw::ProjectedSolidAngle => seen.g(y),
    };
    let pdf = move |index: usize, seen: &Seen, y: DVec3| shares[index] * per_area(seen, y);
    Drawn { pdf: Box::new(pdf), hidden: law.hidden, hidden_error: law.hidden_error }
}

/// The variance from its four channels, if its own mean is the radiance.
fn checked(sight: &Sight, outcomes: &[Outcome; CHANNELS]) -> Result<Value, Error> {
    sight.consistent(outcomes[3])?;
    Ok(Value::of_outcomes(|channel| outcomes[channel]))
}

impl Outcome {
    /// Adds so many independent samples.
    fn add_samples(&mut self, samples: u32, one: &Self) {
        let n = f64::from(samples);
        self.mean += n * one.mean;
        self.mean_error += n * one.mean_error;
        self.variance += n * one.variance;
        self.error += n * one.error;
    }
}

fn direction(y: DVec3) -> [f64; 3] {
    y.normalize().to_array()
}

/// dω/dA = cosθ_y/r² = s/r³.
fn d_omega_d_area(seen: &Seen, y: DVec3) -> f64 {
    let r2 = y.length_squared();
    seen.facet.s / (r2 * r2.sqrt())
}
