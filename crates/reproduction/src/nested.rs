//! L = L_e + one integral + two nested integrals: the first terms of the rendering equation written out, at a receiver.
//!
//! Light that reaches x directly is E₁(x) = ∫ L_e cosθ dω. Light that was reflected once on its way is
//! E₂(x) = ∫ ρ(y)/π E₁(y) cosθ dω with y = vp(x, Ψ): an integral within an integral, and so on. Each further bounce nests one
//! more, and samples multiply: that is why paths are hard to find.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use twoforms_comparison::exactly;
use twoforms_comparison::experiment::Experiment as Comparison;
use twoforms_comparison::place::{Place, Quantity};
use twoforms_comparison::statistics::student_quantile;
use twoforms_comparison::verdict::Criteria;
use twoforms_estimator::rgb::luminance;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::Kind;
use twoforms_geometry::ray::Ray;
use twoforms_geometry::solid_angle::solid_angle as of_corners;
use twoforms_geometry::view::{Effort, View};
use twoforms_integration::{Moments, Source, Variable};

use crate::lighting::{ARITHMETIC, Lighting};
use crate::outcome::{Finding, Measured};
use crate::toolkit::z;

/// ∫ cosθ_y/r² dA over the targets that x faces, by points on them, beside their solid angle: dω = dA cosθ_y/r².
pub fn solid_angle(lighting: &Lighting, at: usize) -> Finding {
    let view = View::new(&lighting.world.geometry, lighting.places[at].frame(), Effort::Cast);
    let targets = 0..lighting.world.geometry.targets().len() as u32;
    let facing: Vec<Vec<DVec3>> = targets.filter_map(|k| view.facing(k, <[DVec3]>::to_vec)).collect();
    let exact: f64 = facing.iter().map(|corners| of_corners(corners)).sum();
    let of = |(k, corners): (usize, &Vec<DVec3>)| {
        let source = Source::independent(lighting.seed.wrapping_add(k as u64));
        let values = PerArea(corners).samples(&source.stream(lighting.replicates, 0)).unwrap_or_default();
        let moments = Moments::of(&values);
        [moments.mean, moments.variance().unwrap_or(0.0) / values.len() as f64]
    };
    let sum = facing.iter().enumerate().map(of).fold([0.0; 2], |sum, one| [sum[0] + one[0], sum[1] + one[1]]);
    let half = student_quantile(z(lighting.level), f64::from(lighting.replicates) - 1.0) * sum[1].sqrt();
    let measured = Some(Measured::around(sum[0], half));
    Finding { exact: Some([exact, 1e-12 * exact]), measured, ..Finding::default() }
}

/// A cosθ_y/r² of a point that is uniform over a triangle or a parallelogram.
struct PerArea<'a>(&'a [DVec3]);

impl Variable for PerArea<'_> {
    fn dimension(&self) -> usize {
        2
    }

    fn at(&self, xi: &[f64]) -> f64 {
        let [a, b, c] = [self.0[0], self.0[1], self.0[self.0.len() - 1]];
        let (across, up) = (b - a, c - a);
        let (s, t, area) = match self.0.len() {
            4 => (xi[0], xi[1], 1.0),
            _ => (xi[0].sqrt() * (1.0 - xi[1]), xi[0].sqrt() * xi[1], 0.5),
        };
        let (y, normal) = (a + across * s + up * t, across.cross(up) * area);
        normal.dot(y).abs() / y.length().powi(3)
    }
}

/// L_e of the surface that the receiver lies on, toward its normal.
pub fn emitted(lighting: &Lighting, at: usize) -> Finding {
    let place = &lighting.places[at];
    let seen = lighting.world.surface_at(place.position, place.normal);
    let emission = seen.map_or([0.0; 3], |seen| lighting.world.emission(&seen).map(f64::from));
    Finding { exact: Some([luminance(emission), 0.0]), ..Finding::default() }
}

/// The light that arrives directly, E₁ or what the receiver's surface reflects of it: one integral, by points on the lights.
///
/// # Errors
/// Where a sample is not finite.
pub fn direct(lighting: &Lighting, at: usize) -> Result<Finding, String> {
    let emission = luminance(lighting.places[at].emission());
    let exact = lighting.exact[at].light.irradiance.map(|value| [value.luminance - emission, value.error_bound]);
    let [outer, inner] = lighting.nested.ok_or("it needs nested = [outer, inner]")?;
    let place = &lighting.places[at];
    let comparison = Comparison { replicates: outer, ..inner_samples(lighting, inner) };
    let results = comparison.run(&lighting.world, std::slice::from_ref(place), &|_| ());
    let results = results.map_err(|error| error.to_string())?;
    let row = &results[0].rows[0];
    let deviation = (row.variance_of_mean.unwrap_or(0.0) / f64::from(outer)).sqrt();
    let half = student_quantile(z(lighting.level), f64::from(outer) - 1.0) * deviation;
    let mean = row.mean.luminance - emission;
    let measured = Measured::around(mean, half + ARITHMETIC * mean);
    let note = Some(format!("{} rays", u64::from(outer) * u64::from(inner)));
    Ok(Finding { exact, measured: Some(measured), note, ..Finding::default() })
}

/// The light that was reflected once on its way, E₂ or what the receiver's surface reflects of it: two nested integrals, by
/// directions over the hemisphere and, where each meets a surface, points on the lights. Beside it the midpoint rule over
/// directions with E₁ exact at each. How far that is off is estimated by half as many directions along each axis: the integrand
/// jumps where one surface ends before another, and no bound is known.
///
/// # Errors
/// Where a sample is not finite, or the receiver's surface has a highlight.
pub fn twice(lighting: &Lighting, at: usize) -> Result<Finding, String> {
    let [outer, inner] = lighting.nested.ok_or("it needs nested = [outer, inner]")?;
    let f_r = lighting.places[at].f_r().ok_or("the receiver's surface has a highlight: add lambert = true")?;
    let source = Source::independent(lighting.seed);
    let stream = source.stream(outer, 0);
    let coordinate = |k: usize| Coordinate(k).samples(&stream).map_err(|error| error.to_string());
    let xi: Vec<DVec2> = coordinate(0)?.into_iter().zip(coordinate(1)?).map(|(u, v)| DVec2::new(u, v)).collect();
    let met: Vec<Option<Met>> = xi.iter().map(|&xi| meet(lighting, at, xi)).collect();
    let places: Vec<Place> = met.iter().flatten().map(|met| met.place.clone()).collect();
    let comparison = Comparison { replicates: 1, ..inner_samples(lighting, inner) };
    let results = comparison.run(&lighting.world, &places, &|_| ()).map_err(|error| error.to_string())?;
    let mut worth = vec![0.0; met.len() - places.len()];
    let reflected = met.iter().flatten().zip(&results).map(|(met, result)| met.reflects(result.rows[0].mean.rgb, f_r));
    worth.extend(reflected);
    let moments = Moments::of(&worth);
    let deviation = (moments.variance().unwrap_or(0.0) / f64::from(outer)).sqrt();
    let half = student_quantile(z(lighting.level), f64::from(outer) - 1.0) * deviation;
    let [coarse, fine] = [RULE / 2, RULE].map(|m| by_rule(lighting, at, m, f_r));
    let exact = coarse.zip(fine).map(|(coarse, fine)| [fine, (fine - coarse).abs()]);
    let rays = format!("{} rays", u64::from(outer) * u64::from(inner + 1));
    let note = exact.map_or(rays.clone(), |[_, error]| {
        format!(
            "{rays}; exact: midpoints of {RULE} × {RULE} cells of directions, the inner integral exact at each; half as many \
             along each axis differ by {error:.1e}, which stands for its error and is no bound"
        )
    });
    Ok(Finding { exact, measured: Some(Measured::around(moments.mean, half)), note: Some(note), ..Finding::default() })
}

/// Directions along each axis of the rule.
const RULE: u32 = 128;

/// Points on the lights for E₁ within another integral.
fn inner_samples(lighting: &Lighting, inner: u32) -> Comparison {
    Comparison {
        strategies: vec![Strategy::from(Kind::AreaUniform)],
        samplers: vec![Sampler::Independent],
        samples: vec![inner],
        replicates: 1,
        seed: lighting.seed,
        criteria: Criteria::default(),
    }
}

/// A random number of a pair.
struct Coordinate(usize);

impl Variable for Coordinate {
    fn dimension(&self) -> usize {
        2
    }

    fn at(&self, xi: &[f64]) -> f64 {
        xi[self.0]
    }
}

/// What a direction from x meets: y, and how it reflects.
struct Met {
    place: Place,
    albedo: [f64; 3],
}

impl Met {
    /// Luminance of f_r ρ E₁, f_r at the receiver: with p = cosθ/π, f_r π cosθ/cosθ · ρ/π E₁.
    fn reflects(&self, irradiance: [f64; 3], f_r: [f64; 3]) -> f64 {
        luminance(std::array::from_fn(|c| f_r[c] * self.albedo[c] * irradiance[c]))
    }
}

/// y = vp(x, Ψ) with Ψ drawn over the cosine.
fn meet(lighting: &Lighting, at: usize, xi: DVec2) -> Option<Met> {
    let (frame, world) = (lighting.places[at].frame(), &lighting.world);
    let (sin, phi) = (xi.x.sqrt(), TAU * xi.y);
    let psi = frame.to_world(DVec3::new(sin * phi.cos(), sin * phi.sin(), (1.0 - xi.x).sqrt()));
    let seen = world.see(&Ray::new(lighting.places[at].position, psi))?;
    let albedo = world.scene.appearance_at(seen.triangle, [1.0 / 3.0; 2]).albedo().map(f64::from);
    let place = Place {
        name: String::new(),
        position: seen.position,
        normal: seen.normal,
        quantity: Quantity::Irradiance,
        known: None,
    };
    Some(Met { place, albedo })
}

/// The same by the midpoint rule over directions, with E₁ exact; `None` where E₁ is not known somewhere.
fn by_rule(lighting: &Lighting, at: usize, m: u32, f_r: [f64; 3]) -> Option<f64> {
    let node = |k: u32| (f64::from(k) + 0.5) / f64::from(m);
    let worth = |k: u32| {
        let Some(met) = meet(lighting, at, DVec2::new(node(k / m), node(k % m))) else { return Some(0.0) };
        let light = exactly::at(&lighting.world, &met.place, &[]).light.irradiance?;
        Some(met.reflects(light.rgb, f_r))
    };
    let values: Option<Vec<f64>> = (0..m * m).into_par_iter().map(worth).collect();
    values.map(|values| values.iter().sum::<f64>() / f64::from(m * m))
}
