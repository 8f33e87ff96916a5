//! Directions of the hemisphere, measured by solid angle.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use libm::{acos, asin, cos};

use crate::density::Density;
use crate::domain::Domain;

/// Directions around a normal, measured by solid angle: dω = sinθ dθ dφ, 2π sr in all.
///
/// The lecture's irradiance, by both ways to count directions. In (φ, θ) the integrand holds the sinθ, and so does the density;
/// per solid angle neither does. Either estimator is π L, and the mean of N is π/N Σ L.
///
/// ```
/// use std::f64::consts::{FRAC_PI_2, PI, TAU};
/// use twoforms_integration::hemisphere::Angles;
/// use twoforms_integration::{CosineHemisphere, Estimator, Given, Interval, Uniform};
///
/// // A sky that is brighter above.
/// let l = |theta: f64| 1.0 + theta.cos();
///
/// // p = cosθ sinθ/π: φ uniform on [0, 2π], θ on [0, π/2] with density 2 cosθ sinθ.
/// let phi = Uniform(Interval::new(0.0, TAU)?);
/// let theta = Given::closed(
///     Interval::new(0.0, FRAC_PI_2)?,
///     |t: f64| 2.0 * t.cos() * t.sin(),
///     |t: f64| t.sin() * t.sin(),
///     |xi: f64| xi.sqrt().asin(),
/// )?;
/// let per_angles = Estimator::new(|(_, t): (f64, f64)| l(t) * t.cos() * t.sin(), (phi, theta));
///
/// // p = cosθ/π.
/// let per_solid_angle = Estimator::new(|Angles { theta, .. }| l(theta) * theta.cos(), CosineHemisphere);
///
/// for xi in [[0.1, 0.2], [0.5, 0.9]] {
///     let pi_l = PI * l(f64::asin(f64::sqrt(xi[1])));
///     assert!((per_angles.primary(&xi) - pi_l).abs() < 1e-14);
///     assert!((per_solid_angle.primary(&xi) - pi_l).abs() < 1e-14);
/// }
/// # Ok::<(), twoforms_integration::Error>(())
/// ```
///
/// The two are different types, so that a density per solid angle cannot meet an integrand over (φ, θ):
///
/// ```compile_fail
/// use twoforms_integration::{CosineHemisphere, Estimator};
/// let mixed = Estimator::new(|(phi, theta): (f64, f64)| theta.sin(), CosineHemisphere);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hemisphere;

/// A direction by its angles, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angles {
    /// φ around the normal, from 0 to 2π.
    pub phi: f64,
    /// θ from the normal, from 0 to π/2.
    pub theta: f64,
}

impl Domain for Hemisphere {
    type Point = Angles;

    fn dimension(&self) -> usize {
        2
    }

    fn measure(&self) -> f64 {
        TAU
    }

    fn contains(&self, at: &Angles) -> bool {
        (0.0..=FRAC_PI_2).contains(&at.theta)
    }

    /// Heights of points that lie evenly on a sphere are uniform (Archimedes): cosθ = 1 − ξ.
    fn at(&self, xi: &[f64]) -> Angles {
        Angles { phi: TAU * xi[0], theta: acos(1.0 - xi[1]) }
    }
}

/// p = cosθ/π per steradian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CosineHemisphere;

impl Density for CosineHemisphere {
    type Domain = Hemisphere;

    fn dimension(&self) -> usize {
        2
    }

    /// Points under it lie evenly on the disk (Malley): sin²θ = ξ.
    fn sample(&self, xi: &[f64]) -> Angles {
        Angles { phi: TAU * xi[0], theta: asin(xi[1].sqrt()) }
    }

    fn pdf(&self, at: &Angles) -> f64 {
        cos(at.theta) / PI
    }
}
