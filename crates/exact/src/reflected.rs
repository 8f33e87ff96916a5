//! Light reflected by a surface with a highlight: f_r depends on Ψ, no closed form is known, and cubature over what x sees gives
//! the radiance and the variances.
//!
//! With F(y) = L_e f_r G per area and a density p(y) per area, a sample is worth F/p. Of a team of techniques with q_k = n_k p_k,
//! a sample of technique i is worth F/Σ q_k by the balance heuristic and F q_i/Σ q_k² by the power heuristic.

use std::borrow::Cow;

use glam::DVec3;
use twoforms_estimator::glossy::{Glossy, MetallicRoughness};
use twoforms_estimator::rgb::luminance;
use twoforms_estimator::strategy::{Strategy, Team, Weighting};
use twoforms_estimator::technique::Technique;

use crate::cubature::{Manner, Peak, integrate_as};
use crate::density::Density;
use crate::error::Error;
use crate::law::{Colours, Law, Outcome};
use crate::mis::{self, Members, over, visible};
use crate::outline::line_integral;
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
        reflected.arriving = reflected.radiance(&self, |seen| Ok(seen.pieces.clone()))?;
        let open = |seen: &Seen| {
            let whole = Pieces::one(&above_horizon(&seen.facet).0);
            seen.glow.as_ref().map_or(Ok(whole.clone()), |glow| glow.cut(&whole, seen.target))
        };
        reflected.unoccluded = reflected.radiance(&self, open)?;
        self.reflected = Some(reflected);
        Ok(self)
    }
}

/// One density, or several mixed: shares that add up to one.
struct Mixed(Vec<(Density, f64)>);

impl Mixed {
    fn per_area(&self, index: usize, seen: &Seen, y: DVec3) -> f64 {
        self.0.iter().map(|(density, share)| share * density.per_area(index, seen, y)).sum()
    }

    /// The probability of a sample worth zero, and a bound of its error.
    fn missed(&self) -> (f64, f64) {
        let missed = self.0.iter().map(|(density, share)| (density.missed(), share));
        missed.fold((0.0, 0.0), |sum, ((missed, error), share)| (sum.0 + share * missed, sum.1 + share * error))
    }
}

impl Reflected {
    /// V of one sample of a strategy (of one of each technique's n for a team).
    pub(crate) fn variance(&self, sight: &Sight, strategy: Strategy) -> Result<Value, Error> {
        let of = |technique: Technique, share: f64| Ok((Density::new(sight, technique)?, share));
        match strategy {
            Strategy::Single(technique) => self.of_one(sight, &Mixed(vec![of(technique, 1.0)?])),
            Strategy::Mixture(0.0, [_, technique]) | Strategy::Mixture(1.0, [technique, _]) => {
                self.of_one(sight, &Mixed(vec![of(technique, 1.0)?]))
            }
            Strategy::Mixture(share, [one, other]) => {
                self.of_one(sight, &Mixed(vec![of(one, share)?, of(other, 1.0 - share)?]))
            }
            Strategy::Mis(weighting @ (Weighting::Balance | Weighting::Power), team) => {
                self.of_team(sight, weighting, team)
            }
            Strategy::Mis(Weighting::Optimal, _) => Err(Error::NotConstant),
            // Weights that jump keep cubature from converging.
            Strategy::Mis(Weighting::Cutoff | Weighting::Maximum | Weighting::Pilot(_), _)
            | Strategy::Resampled(_)
            | Strategy::Ratio
            | Strategy::ControlVariate => Err(Error::NoFormula),
        }
    }

    /// The surface's own density at a point of a facet, per area.
    pub(crate) fn own_density(&self, seen: &Seen, y: DVec3) -> f64 {
        self.surface.pdf(self.theta, direction(y)) * d_omega_d_area(seen, y)
    }

    /// The probability that the surface's own density finds nothing, with a bound of its error: what is left of one.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub(crate) fn missed_by_itself(&self, sight: &Sight) -> Result<(f64, f64), Error> {
        let (mut found, mut error) = (0.0, 4.0 * EPSILON);
        for (index, seen) in visible(sight) {
            let part = by_cubature_near(index, seen, &seen.pieces, &self.peak(), |y| [1.0, self.own_density(seen, y)])?;
            found += part.mass;
            error += part.mass_error;
        }
        Ok((1.0 - found, error))
    }

    fn of_one(&self, sight: &Sight, mixed: &Mixed) -> Result<Value, Error> {
        let p = |index: usize, seen: &Seen, y: DVec3| mixed.per_area(index, seen, y);
        let cut = |index, seen| mis::cut(mixed.0.iter().map(|(density, _)| density), index, seen);
        let laws = self.laws(sight, mixed.missed(), cut, p, |index, seen, y| {
            let p = p(index, seen, y);
            if p == 0.0 { 0.0 } else { 1.0 / p }
        })?;
        checked(sight, &laws.map(|law| law.outcome(&Colours(vec![[1.0; CHANNELS]; sight.seen.len()]), 0)))
    }

    /// Samples are independent, so that their variances add up.
    fn of_team(&self, sight: &Sight, weighting: Weighting, team: Team) -> Result<Value, Error> {
        let members = Members::new(sight, team)?;
        let mut sums = [Outcome::default(); CHANNELS];
        for i in 0..members.count() {
            let p = |index: usize, seen: &Seen, y: DVec3| members.densities(index, seen, y)[i];
            let cut = |index, seen| members.cut(index, seen);
            let laws = self.laws(sight, members.missed(i), cut, p, |index, seen, y| {
                over(weighting, members.expected(members.densities(index, seen, y)), i)
            })?;
            for (sum, law) in sums.iter_mut().zip(laws) {
                sum.add_samples(members.samples(i), &law.outcome(&Colours(vec![[1.0; CHANNELS]; sight.seen.len()]), 0));
            }
        }
        checked(sight, &sums)
    }

    /// The law of one sample in each channel, drawn by `p` and worth F times `per_density` at its point, both smooth on the
    /// pieces of `cut`.
    fn laws<'s>(
        &self,
        sight: &'s Sight,
        (hidden, hidden_error): (f64, f64),
        cut: impl Fn(usize, &'s Seen) -> Cow<'s, Pieces>,
        p: impl Fn(usize, &Seen, DVec3) -> f64,
        per_density: impl Fn(usize, &Seen, DVec3) -> f64,
    ) -> Result<[Law; CHANNELS], Error> {
        let mut laws = [(); CHANNELS].map(|()| Law { parts: Vec::new(), hidden, hidden_error });
        for (index, seen) in visible(sight) {
            let pieces = cut(index, seen);
            for (channel, law) in laws.iter_mut().enumerate() {
                let f = |y: DVec3| [self.integrand(seen, y)[channel] * per_density(index, seen, y), p(index, seen, y)];
                law.parts.push(by_cubature_near(index, seen, &pieces, &self.peak(), f)?);
            }
        }
        Ok(laws)
    }

    /// F(y) = L_e f_r cosθ_x cosθ_y/r², in every channel.
    fn integrand(&self, seen: &Seen, y: DVec3) -> [f64; CHANNELS] {
        let (f_r, g) = (self.surface.f_r(self.theta, direction(y)), seen.g(y));
        let radiance = seen.radiance_at(y);
        let [r, g, b] = [0, 1, 2].map(|c| radiance[c] * f_r[c] * g);
        [r, g, b, luminance([r, g, b])]
    }

    /// ∫ F dA over some part of every facet.
    fn radiance(&self, sight: &Sight, part: impl Fn(&Seen) -> Result<Pieces, Error>) -> Result<Value, Error> {
        let (mut sum, mut error_bound) = ([0.0; CHANNELS], 0.0);
        for seen in sight.seen.iter().filter(|seen| seen.luminance > 0.0) {
            let (pieces, f) = (part(seen)?, |y: DVec3| self.integrand(seen, y));
            let slack = seen.slack_of(&seen.open) * self.peak().steepness();
            let relative = FINE.max(slack);
            let found = integrate_as(&pieces, Manner::Peaked(&self.peak()), f, |total| total.map(|v| relative * v))?;
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

/// The variance from its four channels, if its own mean is the radiance.
fn checked(sight: &Sight, outcomes: &[Outcome; CHANNELS]) -> Result<Value, Error> {
    sight.consistent(outcomes[3])?;
    Ok(Value::of_outcomes(|channel| outcomes[channel]))
}

impl Outcome {
    /// Adds so many independent samples.
    fn add_samples(&mut self, n: f64, one: &Self) {
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
