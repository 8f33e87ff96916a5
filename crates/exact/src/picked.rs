//! Estimators that draw a point on the lights, after picking a light or over all together.

use std::f64::consts::PI;

use glam::DVec3;

use crate::bilinear::Bilinear;
use crate::error::Error;
use crate::glow::Glow;
use crate::law::{Law, Part};
use crate::seen::Seen;
use crate::sight::Sight;
use crate::spread;
use crate::value::EPSILON;
use twoforms_estimator::selection::Selection;

/// The measure in which points are uniform over the lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Draw {
    /// Area, back-facing targets included.
    Uniform,
    /// Solid angle of the targets that face x, not clipped to the horizon.
    SolidAngle,
    /// Projected solid angle of the targets that face x, clipped to the horizon.
    ProjectedSolidAngle,
    /// Solid angle of the targets that face x, times a bilinear cosine.
    BilinearCosine,
}

/// Spreads by edge sums, or by cubature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Sums over edges.
    Edges,
    /// Centred cubature.
    Cubature,
}

/// Targets that are drawn on as one: those of all lights, of one, or a single one; the probability of picking them and their whole measure, hidden
/// parts included.
struct Group {
    pick: f64,
    whole: f64,
    /// The part of `whole` that lies on targets that do not face x.
    unlisted: f64,
}

/// How likely a draw is to land on each facet, per measure, and how likely to land where x sees nothing.
pub struct Shares {
    /// Probability per measure on each facet of the sight.
    pub per_measure: Vec<f64>,
    /// Probability of a sample worth zero.
    pub hidden: f64,
    /// Bound of its error.
    pub hidden_error: f64,
}

/// The shares of a draw: light ℓ with probability q_ℓ, then a point uniform in the draw's measure, T_ℓ in all: q_ℓ/T_ℓ.
///
/// # Errors
/// [`Error::NeverPicked`] for a light that contributes with q = 0, where nothing makes up for it; [`Error::NoTree`].
pub fn shares(sight: &Sight, draw: Draw, selection: Selection) -> Result<Shares, Error> {
    let groups = groups(sight, draw, selection)?;
    let mut shares = Shares { per_measure: Vec::with_capacity(sight.seen.len()), hidden: 0.0, hidden_error: 0.0 };
    for group in &groups {
        shares.hidden += group.pick * if group.whole > 0.0 { group.unlisted / group.whole } else { 1.0 };
    }
    if groups.iter().all(|group| group.pick <= 0.0) {
        shares.hidden = 1.0;
    }
    for (index, seen) in sight.seen.iter().enumerate() {
        let group = &groups[group_of(seen, selection)];
        if selection.stands_alone() && group.pick <= 0.0 && seen.luminance * seen.moments.m10 > 0.0 {
            return Err(Error::NeverPicked { light: seen.light });
        }
        let share = if group.pick > 0.0 && group.whole > 0.0 { group.pick / group.whole } else { 0.0 };
        if share > 0.0 {
            let (hidden, error) = match draw {
                Draw::BilinearCosine => hidden_of_bilinear(sight, index, seen)?,
                _ => hidden(seen, draw),
            };
            shares.hidden += share * hidden;
            shares.hidden_error += share * error;
        }
        shares.per_measure.push(share);
    }
    // What lies below zero is rounding.
    shares.hidden = if shares.hidden < 0.0 { 0.0 } else { shares.hidden };
    shares.hidden_error += 4.0 * EPSILON * shares.hidden;
    Ok(shares)
}

/// The law of one sample: P = share × (visible measure) and w = L u/share with u = cosθ_x cosθ_y/r², cosθ_x or 1.
///
/// # Errors
/// As [`shares`]; [`Error::NotConverged`].
pub fn law(sight: &Sight, draw: Draw, selection: Selection, method: Method) -> Result<Law, Error> {
    let Shares { per_measure, hidden, hidden_error } = shares(sight, draw, selection)?;
    let mut law = Law { parts: Vec::new(), hidden, hidden_error };
    for ((index, seen), share) in sight.seen.iter().enumerate().zip(per_measure) {
        if share > 0.0 && seen.is_visible() {
            law.parts.extend(parts(index, seen, draw, method)?.into_iter().map(|part| scaled(part, share)));
        }
    }
    Ok(law)
}

/// The law of one sample of `area/luminance`: p(y) = Y(y)/Φ, with Y the luminance times sides that the cell of y emits, and Φ
/// the integral of Y over all lights; w = L g Φ/Y.
///
/// # Errors
/// [`Error::NotConverged`]; [`Error::TooManyTexels`].
pub fn by_luminance(sight: &Sight) -> Result<Law, Error> {
    let total = sight.lights.iter().map(|light| light.power).sum::<f64>() / PI;
    let mut law = Law::default();
    let mut listed = 0.0;
    for (index, seen) in sight.seen.iter().enumerate() {
        let light = &sight.lights[seen.light];
        let whole = seen.area * seen.glow.as_ref().map_or_else(|| light.power / (PI * light.area), Glow::mean_emitted);
        listed += whole;
        let parts = match &seen.glow {
            _ if !seen.is_visible() => Vec::new(),
            None => vec![scaled(constant(index, seen)?, whole / seen.area / total)],
            Some(glow) => spread::by_cells(index, seen, glow, total)?,
        };
        let partial = seen.blocked || seen.clipped;
        if partial || parts.is_empty() {
            let mass = parts.first().map_or((0.0, 0.0), |part| (part.mass, part.mass_error));
            law.hidden += whole / total - mass.0;
            law.hidden_error += mass.1;
        }
        law.parts.extend(parts);
    }
    let rest = total - listed;
    let rounding = 4.0 * EPSILON * (sight.seen.len() + sight.lights.len()) as f64;
    law.hidden += if rest.abs() <= rounding * total { 0.0 } else { rest / total };
    law.hidden_error += 4.0 * EPSILON * law.hidden + rounding;
    Ok(law)
}

/// g under dA of a facet of one radiance.
fn constant(index: usize, seen: &Seen) -> Result<Part, Error> {
    let parts = parts(index, seen, Draw::Uniform, Method::Cubature)?;
    Ok(parts[0])
}

fn parts(index: usize, seen: &Seen, draw: Draw, method: Method) -> Result<Vec<Part>, Error> {
    let kept = &seen.cubatures;
    let method = if seen.glow.is_some() { Method::Cubature } else { method };
    match (draw, method) {
        (Draw::Uniform, Method::Edges) => Ok(vec![spread::of_area(index, seen)]),
        (Draw::Uniform, Method::Cubature) => {
            let by_cubature = || spread::by_cubature(index, seen, &seen.pieces, |y| [seen.g(y), 1.0]);
            kept.area.get_or_init(by_cubature).clone()
        }
        (Draw::SolidAngle, Method::Edges) => Ok(vec![spread::of_solid_angle(index, seen)]),
        (Draw::SolidAngle, Method::Cubature) => {
            let f = |y: DVec3| cos_x_and_d_omega(y, seen.facet.s);
            let by_cubature = || spread::by_cubature(index, seen, &seen.pieces, f);
            kept.solid_angle.get_or_init(by_cubature).clone()
        }
        (Draw::ProjectedSolidAngle, _) if seen.glow.is_none() => {
            Ok(vec![spread::of_projected_solid_angle(index, seen)])
        }
        (Draw::ProjectedSolidAngle, _) => {
            let by_cubature = || spread::by_cubature(index, seen, &seen.pieces, |y| [1.0, seen.g(y)]);
            kept.projected_solid_angle.get_or_init(by_cubature).clone()
        }
        (Draw::BilinearCosine, _) => kept.bilinear.get_or_init(|| by_bilinear_cosine(index, seen)).clone(),
    }
}

/// cosθ_x/w under w dω.
fn by_bilinear_cosine(index: usize, seen: &Seen) -> Result<Vec<Part>, Error> {
    let bilinear = Bilinear::new(&seen.corners);
    let f = |y: DVec3| {
        let ([cos_x, d_omega], w) = (cos_x_and_d_omega(y, seen.facet.s), bilinear.at(y));
        [cos_x / w, w * d_omega]
    };
    // Near the plane of a target binary64 leaves few digits of the map, and smooth cubature has nothing to converge to.
    let pieces = bilinear.cut(seen);
    spread::by_cubature(index, seen, &pieces, f).or_else(|_| spread::by_rough_cubature(index, seen, &pieces, f))
}

/// cosθ_x = z/r and dω/dA = s/r³.
fn cos_x_and_d_omega(y: DVec3, s: f64) -> [f64; 2] {
    let r2 = y.length_squared();
    let r = r2.sqrt();
    [y.z / r, s / (r2 * r)]
}

/// Probability = share × measure, value = u/share.
fn scaled(part: Part, share: f64) -> Part {
    Part {
        seen: part.seen,
        channel: part.channel,
        mass: part.mass * share,
        mean: part.mean / share,
        spread: part.spread / share,
        mass_error: part.mass_error * share,
        mean_error: part.mean_error / share,
        spread_error: part.spread_error / share,
    }
}

/// The measure of a facet as it is drawn on.
fn whole(seen: &Seen, draw: Draw) -> f64 {
    match draw {
        Draw::Uniform => seen.area,
        Draw::SolidAngle => seen.whole_solid_angle,
        Draw::ProjectedSolidAngle => seen.open.m10,
        Draw::BilinearCosine => Bilinear::new(&seen.corners).whole() * (seen.facet.area / flat_area(&seen.corners)),
    }
}

/// The area of a target's triangles.
fn flat_area(corners: &[DVec3]) -> f64 {
    let of = |pair: &[DVec3]| 0.5 * (pair[0] - corners[0]).cross(pair[1] - corners[0]).length();
    corners[1..].windows(2).map(of).sum()
}

/// What x does not see of a facet's share of its target's measure. Where a target is two facets, their shares are by area, and what
/// one has too much the other lacks.
fn hidden_of_bilinear(sight: &Sight, index: usize, seen: &Seen) -> Result<(f64, f64), Error> {
    if sight.seen.iter().all(|seen| !seen.blocked && !seen.clipped) {
        return Ok((0.0, 0.0));
    }
    let parts =
        if seen.is_visible() { parts(index, seen, Draw::BilinearCosine, Method::Cubature)? } else { Vec::new() };
    let (mass, error) = parts.first().map_or((0.0, 0.0), |part| (part.mass, part.mass_error));
    Ok((whole(seen, Draw::BilinearCosine) - mass, error))
}

/// The measure of what x does not see of a facet, and a bound of its error.
fn hidden(seen: &Seen, draw: Draw) -> (f64, f64) {
    let (open, moments) = (&seen.open, &seen.moments);
    let partial = match draw {
        Draw::ProjectedSolidAngle => seen.blocked,
        Draw::Uniform | Draw::SolidAngle | Draw::BilinearCosine => seen.blocked || seen.clipped,
    };
    match draw {
        _ if !partial => (0.0, 0.0),
        Draw::Uniform => (seen.area - seen.visible_area, moments.area_error),
        Draw::SolidAngle | Draw::BilinearCosine => {
            (seen.whole_solid_angle - moments.solid_angle, open.error + moments.error)
        }
        Draw::ProjectedSolidAngle => (open.m10 - moments.m10, open.errors[1] + moments.errors[1]),
    }
}

fn groups(sight: &Sight, draw: Draw, selection: Selection) -> Result<Vec<Group>, Error> {
    let by_tree = if selection == Selection::Tree { sight.by_tree()? } else { Vec::new() };
    let count = match selection {
        Selection::Together => 1,
        Selection::Tree => by_tree.len(),
        _ => sight.lights.len(),
    };
    let per_group = |f: &dyn Fn(&Seen) -> f64| {
        let mut sums = vec![0.0; count];
        sight.seen.iter().for_each(|seen| sums[group_of(seen, selection)] += f(seen));
        sums
    };
    let listed = per_group(&|seen| whole(seen, draw));
    let areas: Vec<f64> = match selection {
        Selection::Together => vec![sight.total_area()],
        Selection::Tree => listed.clone(),
        _ => sight.lights.iter().map(|light| light.area).collect(),
    };
    let weights: Vec<f64> = match selection {
        Selection::Together | Selection::Uniform => vec![1.0; count],
        Selection::Power => sight.lights.iter().map(|light| light.power).collect(),
        Selection::Contribution => per_group(&|seen| seen.emitted * seen.open.m10),
        Selection::Compensated(compensation) => {
            let given = per_group(&|seen| seen.emitted * seen.open.m10);
            compensation.weights(&given, &per_group(&|seen| seen.open.m10))
        }
        Selection::Tree if draw == Draw::Uniform => by_tree,
        Selection::Tree => by_tree.iter().zip(&listed).map(|(&p, &m)| if m > 0.0 { p } else { 0.0 }).collect(),
    };
    let total: f64 = weights.iter().sum();
    let groups = weights.iter().zip(&listed).zip(&areas);
    let rounding = 4.0 * EPSILON * (sight.seen.len() + sight.lights.len()) as f64;
    let group = |((&weight, &listed), &area): ((&f64, &f64), &f64)| {
        let whole = if draw == Draw::Uniform { area } else { listed };
        let rest = whole - listed;
        Group {
            pick: if total > 0.0 { weight / total } else { 0.0 },
            whole,
            unlisted: if rest.abs() <= rounding * whole { 0.0 } else { rest },
        }
    };
    Ok(groups.map(group).collect())
}

fn group_of(seen: &Seen, selection: Selection) -> usize {
    match selection {
        Selection::Together => 0,
        Selection::Tree => seen.target as usize,
        _ => seen.light,
    }
}
