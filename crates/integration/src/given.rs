//! Densities given by their functions, inverted in closed form or numerically.

use crate::density::Density;
use crate::domain::{Domain, Interval};
use crate::error::Error;
use crate::line::Line;

/// A density on [a, b] given by p, F and F⁻¹.
///
/// The lecture's cosine-weighted angle, p = 2 cosθ sinθ, F = sin²θ, by both kinds of inversion:
///
/// ```
/// use std::f64::consts::FRAC_PI_2;
/// use twoforms_integration::{Given, Interval, Line};
///
/// let quarter = Interval::new(0.0, FRAC_PI_2)?;
/// let (p, cdf) = (|t: f64| 2.0 * t.cos() * t.sin(), |t: f64| t.sin() * t.sin());
/// let closed = Given::closed(quarter, p, cdf, |xi: f64| xi.sqrt().asin())?;
/// let numeric = Given::numeric(quarter, p, cdf)?;
/// for xi in [0.001, 0.25, 0.5, 0.999] {
///     assert!((closed.invert(xi) - numeric.invert(xi)).abs() < 1e-14);
/// }
/// # Ok::<(), twoforms_integration::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Given<P, F, G> {
    interval: Interval,
    pdf: P,
    cdf: F,
    inverse: G,
}

/// ξ at which a given density is tried.
const TRIALS: u32 = 64;
/// How far F(F⁻¹(ξ)) may be from ξ.
const TOLERANCE: f64 = 1e-9;

impl<P: Fn(f64) -> f64, F: Fn(f64) -> f64, G: Fn(f64) -> f64> Given<P, F, G> {
    /// A density by its pdf, its cdf and the inverse of that. They are tried at 64 ξ in (0, 1) and at both ends; whether p is
    /// the derivative of F is not.
    ///
    /// # Errors
    /// [`Error::NotADensity`] where F(F⁻¹(ξ)) is not ξ, F⁻¹(ξ) lies outside [a, b], p is negative, F(a) is not 0 or F(b) not 1.
    pub fn closed(interval: Interval, pdf: P, cdf: F, inverse: G) -> Result<Self, Error> {
        let given = Self { interval, pdf, cdf, inverse };
        let inside = (0..TRIALS).map(|k| (f64::from(k) + 0.5) / f64::from(TRIALS)).map(|xi| (xi, (given.inverse)(xi)));
        let ends = [(0.0, interval.a()), (1.0, interval.b())];
        for (xi, x) in ends.into_iter().chain(inside) {
            let (cdf, pdf) = ((given.cdf)(x), (given.pdf)(x));
            if !((cdf - xi).abs() <= TOLERANCE && pdf >= 0.0 && interval.contains(&x)) {
                return Err(Error::NotADensity { xi, x, cdf, pdf });
            }
        }
        Ok(given)
    }
}

impl<P: Fn(f64) -> f64 + Clone, F: Fn(f64) -> f64 + Clone> Given<P, F, ()> {
    /// A density by its pdf and its cdf, which is inverted to rounding by Newton's method within a bracket.
    ///
    /// # Errors
    /// As [`closed`](Given::closed).
    pub fn numeric(interval: Interval, pdf: P, cdf: F) -> Result<Given<P, F, impl Fn(f64) -> f64>, Error> {
        let (slope, rise) = (pdf.clone(), cdf.clone());
        Given::closed(interval, pdf, cdf, move |xi| solve(&rise, &slope, interval, xi))
    }
}

/// Steps after which any bracket has been halved down to neighbouring numbers, or Newton's method has long ended.
const STEPS: usize = 200;

/// x with F(x) = ξ: Newton's method, and a halving wherever its step would leave the bracket or is not half the last.
fn solve(cdf: &impl Fn(f64) -> f64, pdf: &impl Fn(f64) -> f64, interval: Interval, xi: f64) -> f64 {
    let (mut low, mut high) = (interval.a(), interval.b());
    let (mut x, mut last) = (0.5 * (low + high), high - low);
    for _ in 0..STEPS {
        let excess = cdf(x) - xi;
        (low, high) = if excess > 0.0 { (low, x) } else { (x, high) };
        let newton = x - excess / pdf(x);
        let steady = low <= newton && newton <= high && 2.0 * (newton - x).abs() <= last;
        let next = if steady { newton } else { 0.5 * (low + high) };
        if next == x || excess.abs() <= f64::EPSILON * xi {
            break;
        }
        (x, last) = (next, (next - x).abs());
    }
    x
}

impl<P: Fn(f64) -> f64, F: Fn(f64) -> f64, G: Fn(f64) -> f64> Density for Given<P, F, G> {
    type Domain = Interval;

    fn dimension(&self) -> usize {
        1
    }

    fn sample(&self, xi: &[f64]) -> f64 {
        self.interval.nearest((self.inverse)(xi[0]))
    }

    fn pdf(&self, x: &f64) -> f64 {
        if self.interval.contains(x) { (self.pdf)(*x) } else { 0.0 }
    }
}

impl<P: Fn(f64) -> f64, F: Fn(f64) -> f64, G: Fn(f64) -> f64> Line for Given<P, F, G> {
    fn cdf(&self, x: f64) -> f64 {
        (self.cdf)(self.interval.nearest(x))
    }
}
