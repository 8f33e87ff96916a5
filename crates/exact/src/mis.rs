//! Weighted pairs and mixtures of `area/uniform` and `hemisphere/cosine`.
//!
//! Everything depends on one number at each point of a light, ρ = p_h/p_a = A g/π with p_a = r²/(A
//! cosθ_y), p_h = cosθ_x/π and g = cosθ_x cosθ_y/r²; and p_a dω = dA/A. So F/p_a = L π ρ, and ∫ …
//! p_h dω = ∫ … ρ dA/A. No density is divided by.

use std::f64::consts::PI;

use crate::error::Error;
use crate::law::{Colours, Law, Outcome, Part};
use crate::seen::Seen;
use crate::sight::Sight;
use crate::spread::by_cubature;
use crate::value::EPSILON;

/// The law of one sample of density `weight`(ρ) p_a and value L π `value`(ρ); `hidden` is the
/// probability of a miss and its error bound.
fn law(
    sight: &Sight,
    hidden: (f64, f64),
    value: impl Fn(f64) -> f64,
    weight: impl Fn(f64) -> f64,
) -> Result<Law, Error> {
    law_of(sight, |_| true, hidden, value, weight)
}

/// The same over some facets alone.
fn law_of(
    sight: &Sight,
    taken: impl Fn(&Seen) -> bool,
    hidden: (f64, f64),
    value: impl Fn(f64) -> f64,
    weight: impl Fn(f64) -> f64,
) -> Result<Law, Error> {
    let area = sight.total_area();
    let mut law = Law { parts: Vec::new(), hidden: hidden.0, hidden_error: hidden.1 };
    for (index, seen) in sight.seen.iter().enumerate().filter(|(_, seen)| seen.is_visible() && taken(seen)) {
        law.parts.extend(by_cubature(index, seen, |y| {
            let rho = seen.g(y) * (area / PI);
            [PI * value(rho), weight(rho) / area]
        })?);
    }
    Ok(law)
}

/// 1 − ∫ p_a over what x sees, and a bound of its error.
pub fn missed_by_area(sight: &Sight) -> (f64, f64) {
    let area = sight.total_area();
    let seen: f64 = sight.seen.iter().map(|seen| seen.visible_area).sum();
    let error: f64 =
        sight.seen.iter().filter(|seen| seen.blocked || seen.clipped).map(|seen| seen.moments.area_error).sum();
    let rest = not_below_zero(area - seen);
    let rounding = 4.0 * EPSILON * (sight.seen.len() + sight.lights.len()) as f64 * area;
    let whole = sight.seen.iter().all(|seen| !seen.blocked && !seen.clipped) && rest <= rounding;
    if whole { (0.0, 0.0) } else { (rest / area, (error + rounding) / area) }
}

/// 1 − ∫ p_h over what x sees, and a bound of its error.
pub fn missed_by_hemisphere(sight: &Sight) -> (f64, f64) {
    let (m10, error) = sight
        .seen
        .iter()
        .fold((0.0, 0.0), |(m10, error), seen| (m10 + seen.moments.m10, error + seen.moments.errors[1]));
    (not_below_zero(1.0 - m10 / PI), error / PI + 4.0 * EPSILON)
}

/// A probability as a difference: what lies below zero is rounding.
fn not_below_zero(difference: f64) -> f64 {
    if difference < 0.0 { 0.0 } else { difference }
}

/// One sample from A p_h + (1 − A) p_a: w = L π ρ/(1 − A + A ρ).
///
/// # Errors
/// [`Error::NotConverged`].
pub fn mixture(sight: &Sight, a: f64) -> Result<Law, Error> {
    let (by_area, by_hemisphere) = (missed_by_area(sight), missed_by_hemisphere(sight));
    let mix = |area: f64, hemisphere: f64| (1.0 - a) * area + a * hemisphere;
    let hidden = (mix(by_area.0, by_hemisphere.0), mix(by_area.1, by_hemisphere.1));
    law(sight, hidden, |rho| rho / mix(1.0, rho), |rho| mix(1.0, rho))
}

/// The laws of the two samples under the balance heuristic, [area, hemisphere]: both are worth
/// F/(p_a + p_h) = L π ρ/(1 + ρ).
///
/// # Errors
/// [`Error::NotConverged`].
pub fn balance(sight: &Sight) -> Result<[Law; 2], Error> {
    let value = |rho: f64| rho / (1.0 + rho);
    let area = law(sight, missed_by_area(sight), value, |_| 1.0)?;
    let hemisphere = law(sight, missed_by_hemisphere(sight), value, |rho| rho)?;
    Ok([area, hemisphere])
}

/// The laws of the two samples under the power heuristic, β = 2, [area, hemisphere]: F p_i/(p_a² +
/// p_h²) = L π ρ {1, ρ}/(1 + ρ²).
///
/// # Errors
/// [`Error::NotConverged`].
pub fn power(sight: &Sight) -> Result<[Law; 2], Error> {
    let area = law(sight, missed_by_area(sight), |rho| rho / (1.0 + rho * rho), |_| 1.0)?;
    let hemisphere = law(sight, missed_by_hemisphere(sight), |rho| rho * rho / (1.0 + rho * rho), |rho| rho)?;
    Ok([area, hemisphere])
}

/// The least variance of an unbiased weighting of the pair (Kondapaneni et al. 2019).
///
/// With c = p_a + p_h, A_ij = ∫ p_i p_j/c, b_i = ∫ F p_i/c and A α = b, V = ∫ F²/c − αᵀb. That
/// difference cancels; it equals
/// V = ∫ (F − α_a p_a − α_h p_h)²/c over everything that is sampled, where no term is negative.
#[derive(Clone, Debug)]
pub struct Optimal {
    /// ρ under p_a/(1 + ρ) = p_a²/c on every facet: mean, spread and mass give ∫ p_a²/c, ∫ p_a
    /// p_h/c and ∫ p_h²/c.
    law: Law,
    /// The facets that emit by a texture, for each channel.
    woven: Vec<[Woven; 4]>,
    area: (f64, f64),
    hemisphere: (f64, f64),
}

/// ∫ {1, ρ, ρ², lρ, lρ², l²ρ²} p_a/(1 + ρ) on a facet that emits by a texture, l = π L in one channel, with bounds of the errors.
#[derive(Clone, Copy, Debug)]
struct Woven {
    value: [f64; 6],
    error: [f64; 6],
}

impl Woven {
    fn all(seen: &Seen, area: f64) -> Result<Option<[Self; 4]>, Error> {
        let of = |channel: usize| {
            seen.by_texture(channel, |y, radiance| {
                let (rho, l) = (seen.g(y) * (area / PI), PI * radiance);
                let w = 1.0 / (area * (1.0 + rho));
                let (rho_w, l_rho) = (rho * w, l * rho);
                [w, rho_w, rho * rho_w, l * rho_w, l_rho * rho_w, l_rho * l_rho * w]
            })
        };
        let all = (0..4).map(of).collect::<Result<Option<Vec<_>>, _>>()?;
        Ok(all.map(|all| std::array::from_fn(|c| Self { value: all[c].value, error: all[c].error })))
    }
}

impl Optimal {
    /// Integrates ρ over what x sees.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn new(sight: &Sight) -> Result<Self, Error> {
        let constant = |seen: &Seen| seen.glow.is_none();
        let law = law_of(sight, constant, (0.0, 0.0), |rho| rho / PI, |rho| 1.0 / (1.0 + rho))?;
        let visible = sight.seen.iter().filter(|seen| seen.is_visible());
        let woven = visible.filter_map(|seen| Woven::all(seen, sight.total_area()).transpose());
        let woven = woven.collect::<Result<_, _>>()?;
        Ok(Self { law, woven, area: missed_by_area(sight), hemisphere: missed_by_hemisphere(sight) })
    }

    /// Variance of the pair's sum and its mean. On the facets F = L π p_h = L π ρ p_a; where a
    /// light's point is hidden only p_a is not zero, where a direction misses only p_h.
    pub fn outcome(&self, colours: &Colours, channel: usize) -> Outcome {
        let (alpha, mean) = self.alpha(colours, channel);
        let [alpha_a, alpha_h] = alpha;
        let mut outcome = Outcome {
            mean,
            mean_error: 16.0 * EPSILON * mean,
            variance: alpha_a * alpha_a * self.area.0 + alpha_h * alpha_h * self.hemisphere.0,
            error: alpha_a * alpha_a * self.area.1 + alpha_h * alpha_h * self.hemisphere.1,
        };
        for part in &self.law.parts {
            outcome.add_residual(part, PI * colours.0[part.seen][channel] - alpha_h, alpha_a);
        }
        for woven in &self.woven {
            outcome.add_woven(&woven[channel], alpha);
        }
        outcome.error += 16.0 * EPSILON * (outcome.variance + mean.abs() * outcome.variance.abs().sqrt());
        outcome
    }

    /// α, [area, hemisphere], and the mean.
    pub fn alpha(&self, colours: &Colours, channel: usize) -> ([f64; 2], f64) {
        let mut matrix = [self.area.0, 0.0, self.hemisphere.0];
        let mut b = [0.0; 2];
        let mut mean = 0.0;
        for part in &self.law.parts {
            let l_pi = PI * colours.0[part.seen][channel];
            let (a_h, h_h) = (part.mass * part.mean, part.spread + part.mass * part.mean * part.mean);
            matrix[0] += part.mass;
            matrix[1] += a_h;
            matrix[2] += h_h;
            b[0] += l_pi * a_h;
            b[1] += l_pi * h_h;
            mean += l_pi * (a_h + h_h);
        }
        for woven in &self.woven {
            let [a_a, a_h, h_h, b_a, b_h, _] = woven[channel].value;
            matrix = [matrix[0] + a_a, matrix[1] + a_h, matrix[2] + h_h];
            b = [b[0] + b_a, b[1] + b_h];
            mean += b_a + b_h;
        }
        (solve(matrix, b), mean)
    }
}

impl Outcome {
    /// ∫ (l ρ − α_a − α_h ρ)² p_a/(1 + ρ) on one facet, l varying over it.
    fn add_woven(&mut self, woven: &Woven, [alpha_a, alpha_h]: [f64; 2]) {
        let factors =
            [alpha_a * alpha_a, 2.0 * alpha_a * alpha_h, alpha_h * alpha_h, -2.0 * alpha_a, -2.0 * alpha_h, 1.0];
        for (k, factor) in factors.into_iter().enumerate() {
            self.variance += factor * woven.value[k];
            self.error += factor.abs() * woven.error[k];
        }
        self.mean_error += woven.error[3] + woven.error[4];
    }

    /// ∫ (k ρ − α_a)² p_a/(1 + ρ) on one facet, k = L π − α_h.
    fn add_residual(&mut self, part: &Part, k: f64, alpha_a: f64) {
        let at_mean = k * part.mean - alpha_a;
        self.variance += at_mean * at_mean * part.mass + k * k * part.spread;
        self.error += at_mean * at_mean * part.mass_error
            + 2.0 * (at_mean * k).abs() * part.mass * part.mean_error
            + k * k * part.spread_error;
        self.mean_error +=
            (k.abs() + alpha_a.abs()) * (part.mass * part.mean_error + part.mean * part.mass_error + part.spread_error);
    }
}

/// α of least norm error with [[aa, ah], [ah, hh]] α = b; zero when nothing is seen.
fn solve([aa, ah, hh]: [f64; 3], b: [f64; 2]) -> [f64; 2] {
    let determinant = aa * hh - ah * ah;
    if determinant.abs() <= 8.0 * EPSILON * aa * hh {
        let trace = aa + hh;
        return if trace > 0.0 { b.map(|b| b / trace) } else { [0.0; 2] };
    }
    [(b[0] * hh - b[1] * ah) / determinant, (b[1] * aa - b[0] * ah) / determinant]
}
