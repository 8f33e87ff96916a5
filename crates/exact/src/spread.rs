//! Mass, mean and spread of a function over the visible part of a facet.

use std::array::from_fn;

use glam::DVec3;

use crate::cubature::{Peak, guess, integrate_near};
use crate::error::Error;
use crate::law::Part;
use crate::outline::line_integral;
use crate::seen::Seen;
use crate::value::EPSILON;

/// ∫ w dA, the mean of u under w dA, and ∫ (u − mean)² w dA over the visible part, where `f` gives
/// \[u, w\] at a point y of the light. Centred, so that a nearly constant u keeps the digits of its
/// spread.
///
/// # Errors
/// [`Error::NotConverged`].
pub fn by_cubature(index: usize, seen: &Seen, f: impl Fn(DVec3) -> [f64; 2]) -> Result<Part, Error> {
    by_cubature_near(index, seen, None, f)
}

/// The same for functions that may have a peak.
///
/// # Errors
/// [`Error::NotConverged`].
pub fn by_cubature_near(
    index: usize,
    seen: &Seen,
    peak: Option<&Peak>,
    f: impl Fn(DVec3) -> [f64; 2],
) -> Result<Part, Error> {
    let [mass, first] = guess(&seen.pieces, |y| {
        let [u, w] = f(y);
        [w, u * w]
    });
    let centre = if mass > 0.0 { first / mass } else { 0.0 };
    let about_centre = |y: DVec3| {
        let [u, w] = f(y);
        let d = u - centre;
        [w, d * w, d * d * w]
    };
    let slack = seen.slack() * peak.map_or(1.0, Peak::steepness);
    // Nothing is gained beyond a tenth of what the coordinates' rounding leaves; beside a peak f itself is rounded as much.
    let gain = if peak.is_some() { 1.0 } else { 0.1 };
    let relative = |least: f64| least.max(gain * slack);
    let tolerance = |&[mass, _, second]: &[f64; 3]| {
        let size = centre.abs() * mass;
        [
            relative(1e-11) * mass,
            relative(1e-9) * (second * mass).sqrt() + 1e-15 * size,
            relative(1e-9) * second + 1e-18 * centre.abs() * size,
        ]
    };
    let sum = integrate_near(&seen.pieces, peak, about_centre, tolerance)?;
    let [mass, first, second] = sum.value;
    let shift = if mass > 0.0 { first / mass } else { 0.0 };
    let spread = second - shift * first;
    // The vertices' rounding moves the outline, and scales u and w by some (1 + slack).
    let edges = line_integral(&seen.pieces, about_centre);
    let outline: [f64; 3] = from_fn(|k| sum.error[k] + edges[k] * seen.moments.shift);
    let size = (second * (second + centre * centre * mass)).sqrt();
    Ok(Part {
        seen: index,
        mass,
        mean: centre + shift,
        spread,
        mass_error: outline[0] + slack * mass,
        mean_error: outline[1] / mass + slack * (size / mass).sqrt() + slack * centre.abs(),
        spread_error: outline[2] + 2.0 * shift.abs() * outline[1] + 4.0 * slack * (size + second),
    })
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
        mass,
        mean,
        spread: second - first * mean,
        mass_error,
        mean_error: (first_error + mean * mass_error) / mass,
        spread_error: second_error + 2.0 * mean * first_error + mean * mean * mass_error,
    }
}
