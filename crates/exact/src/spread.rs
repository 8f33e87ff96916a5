//! Mass, mean and spread of a function over the visible part of a facet.

use std::array::from_fn;

use glam::DVec3;

use crate::cubature::{Manner, Peak, guess, integrate_as};
use crate::error::Error;
use crate::glow::Glow;
use crate::law::Part;
use crate::outline::line_integral;
use crate::seen::Seen;
use crate::value::EPSILON;
use crate::visible::Pieces;

/// ∫ w dA, the mean of u under w dA, and ∫ (u − mean)² w dA over the visible part, in pieces on which both are smooth, where `f` gives
/// \[u, w\] at a point y of the light. Centred, so that a nearly constant u keeps the digits of its
/// spread. Where the facet emits by a texture, u times the radiance in each channel.
///
/// # Errors
/// [`Error::NotConverged`]; [`Error::TooManyTexels`].
pub fn by_cubature(
    index: usize,
    seen: &Seen,
    pieces: &Pieces,
    f: impl Fn(DVec3) -> [f64; 2],
) -> Result<Vec<Part>, Error> {
    within(index, seen, pieces, Manner::Smooth, f)
}

/// The same to a thousandth, where u or w jump across a curve: cells along it are halved until what they leave is that small, and
/// the bounds say how small.
///
/// # Errors
/// [`Error::NotConverged`]; [`Error::TooManyTexels`].
pub fn by_rough_cubature(
    index: usize,
    seen: &Seen,
    pieces: &Pieces,
    f: impl Fn(DVec3) -> [f64; 2],
) -> Result<Vec<Part>, Error> {
    let may_miss = |part: Part| Part {
        mass_error: part.mass_error + MISSED * part.mass,
        mean_error: part.mean_error + MISSED * part.mean.abs(),
        spread_error: part.spread_error + MISSED * part.spread,
        ..part
    };
    Ok(within(index, seen, pieces, Manner::Jumping, f)?.into_iter().map(may_miss).collect())
}

/// The same of one function, radiance in it, that may have a peak.
///
/// # Errors
/// [`Error::NotConverged`].
pub fn by_cubature_near(
    index: usize,
    seen: &Seen,
    pieces: &Pieces,
    peak: &Peak,
    f: impl Fn(DVec3) -> [f64; 2],
) -> Result<Part, Error> {
    of_function(index, seen, pieces, Manner::Peaked(peak), f)
}

/// u = L g Φ/Y under Y dA/Φ, with Y the luminance times sides that the cell of y emits and Φ that of all lights.
///
/// # Errors
/// [`Error::NotConverged`]; [`Error::TooManyTexels`].
pub fn by_cells(index: usize, seen: &Seen, glow: &Glow, total: f64) -> Result<Vec<Part>, Error> {
    let pieces = glow.cut_in_cells(&seen.pieces, seen.target)?;
    let drawn = |y: DVec3| {
        let share = glow.emitted(y) / total;
        let per_share = if share > 0.0 { seen.g(y) / share } else { 0.0 };
        (glow.at(y).map(|radiance| radiance * per_share), share)
    };
    of_channels(index, seen, &pieces, Manner::Smooth, drawn)
}

/// Relative errors of the mass, and of mean and spread.
const FINE: [f64; 2] = [1e-11, 1e-9];
const ROUGH: [f64; 2] = [1e-3, 1e-3];
/// What may lie beyond a curve between a cell's edge and its outermost nodes, where no rule sees it: a share of the whole. Half of
/// this is the most that was seen, by means that are known.
const MISSED: f64 = 1e-3;

/// To which they are computed.
fn fineness(manner: Manner) -> [f64; 2] {
    if let Manner::Jumping = manner { ROUGH } else { FINE }
}

fn within(
    index: usize,
    seen: &Seen,
    pieces: &Pieces,
    manner: Manner,
    f: impl Fn(DVec3) -> [f64; 2],
) -> Result<Vec<Part>, Error> {
    let Some(glow) = &seen.glow else {
        return Ok(vec![of_function(index, seen, pieces, manner, f)?]);
    };
    let in_channels = |y: DVec3| {
        let [u, w] = f(y);
        (glow.at(y).map(|radiance| radiance * u), w)
    };
    of_channels(index, seen, pieces, manner, in_channels)
}

fn of_function(
    index: usize,
    seen: &Seen,
    pieces: &Pieces,
    manner: Manner,
    f: impl Fn(DVec3) -> [f64; 2],
) -> Result<Part, Error> {
    let [mass, first] = guess(pieces, |y| {
        let [u, w] = f(y);
        [w, u * w]
    });
    let centre = if mass > 0.0 { first / mass } else { 0.0 };
    let about_centre = |y: DVec3| {
        let [u, w] = f(y);
        let d = u - centre;
        [w, d * w, d * d * w]
    };
    // Beside a peak f itself is rounded by as much as the coordinates' rounding leaves.
    let (steepness, gain) = if let Manner::Peaked(peak) = manner { (peak.steepness(), 10.0) } else { (1.0, 1.0) };
    let (slack, fine) = (seen.slack() * steepness, fineness(manner));
    let sum = integrate_as(pieces, manner, about_centre, |&[mass, _, second]| {
        let [first, second] = allowed(centre, mass, second, relative(fine[1], gain * slack));
        [relative(fine[0], gain * slack) * mass, first, second]
    })?;
    let edges = line_integral(pieces, about_centre);
    let outline: [f64; 3] = from_fn(|k| sum.error[k] + edges[k] * seen.moments.shift);
    Ok(Part { seen: index, ..part(centre, sum.value, outline, slack) })
}

/// Most pieces of a facet that emits by a texture over which variances are worth computing.
const MOST: usize = 1 << 16;

/// A part for each channel, `f` giving their u and w, over pieces that are cut along the texels.
fn of_channels(
    index: usize,
    seen: &Seen,
    pieces: &Pieces,
    manner: Manner,
    f: impl Fn(DVec3) -> ([f64; 4], f64),
) -> Result<Vec<Part>, Error> {
    if pieces.len() > MOST {
        return Err(Error::TooManyTexels { target: seen.target, limit: MOST });
    }
    let [mass, firsts @ ..] = guess::<5>(pieces, |y| {
        let (u, w) = f(y);
        [w, u[0] * w, u[1] * w, u[2] * w, u[3] * w]
    });
    let centres = firsts.map(|first| if mass > 0.0 { first / mass } else { 0.0 });
    let about_centres = |y: DVec3| -> [f64; 9] {
        let (u, w) = f(y);
        let d: [f64; 4] = from_fn(|c| u[c] - centres[c]);
        [w, d[0] * w, d[1] * w, d[2] * w, d[3] * w, d[0] * d[0] * w, d[1] * d[1] * w, d[2] * d[2] * w, d[3] * d[3] * w]
    };
    let (slack, fine) = (seen.slack(), fineness(manner));
    let sum = integrate_as(pieces, manner, about_centres, |total| {
        let of_channel: [[f64; 2]; 4] =
            from_fn(|c| allowed(centres[c], total[0], total[5 + c], relative(fine[1], slack)));
        from_fn(|k| match k {
            0 => relative(fine[0], slack) * total[0],
            1..5 => of_channel[k - 1][0],
            _ => of_channel[k - 5][1],
        })
    })?;
    let edges = line_integral(pieces, about_centres);
    let outline: [f64; 9] = from_fn(|k| sum.error[k] + edges[k] * seen.moments.shift);
    let in_channel = |c: usize| {
        let of = |all: &[f64; 9]| [all[0], all[1 + c], all[5 + c]];
        Part { seen: index, channel: Some(c), ..part(centres[c], of(&sum.value), of(&outline), slack) }
    };
    Ok((0..4).map(in_channel).collect())
}

/// Nothing is gained beyond a tenth of what the coordinates' rounding leaves.
fn relative(least: f64, slack: f64) -> f64 {
    least.max(0.1 * slack)
}

/// The errors allowed of ∫ (u − centre) w and ∫ (u − centre)² w.
fn allowed(centre: f64, mass: f64, second: f64, relative: f64) -> [f64; 2] {
    let size = centre.abs() * mass;
    [relative * (second * mass).sqrt() + 1e-15 * size, relative * second + 1e-18 * centre.abs() * size]
}

/// From ∫ w, ∫ (u − centre) w and ∫ (u − centre)² w, with what cubature and the rounding of the outline leave open.
fn part(centre: f64, [mass, first, second]: [f64; 3], outline: [f64; 3], slack: f64) -> Part {
    let shift = if mass > 0.0 { first / mass } else { 0.0 };
    // The vertices' rounding also scales u and w by some (1 + slack).
    let size = (second * (second + centre * centre * mass)).sqrt();
    let per_mass = |value: f64| if mass > 0.0 { value / mass } else { 0.0 };
    Part {
        seen: 0,
        channel: None,
        mass,
        mean: centre + shift,
        spread: second - shift * first,
        mass_error: outline[0] + slack * mass,
        mean_error: per_mass(outline[1]) + slack * per_mass(size).sqrt() + slack * centre.abs(),
        spread_error: outline[2] + 2.0 * shift.abs() * outline[1] + 4.0 * slack * (size + second),
    }
}

/// u = g = cosθ_x cosθ_y/r² under dA, by edge sums: ∫ g dA = M_10 and ∫ g² dA = M_23/s².
pub fn of_area(index: usize, seen: &Seen) -> Part {
    let (moments, s2) = (&seen.moments, seen.facet.s * seen.facet.s);
    let mass_error = if seen.blocked || seen.clipped { moments.area_error } else { 0.0 };
    let relative_plane = 16.0 * EPSILON * seen.facet.reach / seen.facet.s;
    let second = moments.m23 / s2;
    let second_error = moments.error / s2 + relative_plane * second.abs();
    closed(index, (seen.visible_area, mass_error), (moments.m10, moments.errors[1]), (second, second_error))
}

/// u = cosθ_x under dω: M_00, M_10 and M_20.
pub fn of_solid_angle(index: usize, seen: &Seen) -> Part {
    let moments = &seen.moments;
    closed(
        index,
        (moments.solid_angle, moments.errors[0]),
        (moments.m10, moments.errors[1]),
        (moments.m20, moments.errors[2]),
    )
}

/// u = 1 under cosθ_x dω.
pub fn of_projected_solid_angle(index: usize, seen: &Seen) -> Part {
    let moments = &seen.moments;
    Part { seen: index, mass: moments.m10, mass_error: moments.error, mean: 1.0, ..Part::default() }
}

/// From ∫ w, ∫ u w and ∫ u² w, each with its error.
fn closed(
    seen: usize,
    (mass, mass_error): (f64, f64),
    (first, first_error): (f64, f64),
    (second, second_error): (f64, f64),
) -> Part {
    let mean = first / mass;
    Part {
        seen,
        channel: None,
        mass,
        mean,
        spread: second - first * mean,
        mass_error,
        mean_error: (first_error + mean * mass_error) / mass,
        spread_error: second_error + 2.0 * mean * first_error + mean * mean * mass_error,
    }
}
