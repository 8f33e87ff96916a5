//! Estimators of integrals, and functions of random points.

use twoforms_estimator::moments::Moments;
use twoforms_estimator::sampler::Stream;

use crate::density::{Density, Point};
use crate::error::Error;
use crate::variable::Variable;

/// The estimator of I = ∫ f dμ by points with density p, f and p per unit of the measure μ of their domain.
///
/// The lecture's ∫₀¹ 5x⁴ dx, with its four samples and their running averages:
///
/// ```
/// use twoforms_integration::{Estimator, Interval, Uniform, Variable, running_means};
///
/// let estimator = Estimator::new(|x| 5.0 * x * x * x * x, Uniform(Interval::UNIT));
/// let worth = [0.86, 0.41, 0.02, 0.38].map(|x| estimator.primary(&[x]));
/// let averages: Vec<String> = running_means(worth).map(|mean| format!("{mean:.2}")).collect();
/// assert_eq!(averages, ["2.74", "1.44", "0.96", "0.75"]);
///
/// // "Variance: what is it?" 16/9.
/// let exact = estimator.exact(1e-12)?;
/// assert!((exact.mean - 1.0).abs() < 1e-12 && (exact.variance - 16.0 / 9.0).abs() < 1e-11);
/// # Ok::<(), twoforms_integration::Error>(())
/// ```
///
/// It is biased where p is zero and f is not: such points are never drawn.
#[derive(Clone, Copy, Debug)]
pub struct Estimator<F, P> {
    /// f: the integrand.
    pub f: F,
    /// p: the density of the points.
    pub p: P,
}

impl<F: Fn(Point<P>) -> f64, P: Density> Estimator<F, P> {
    /// The estimator of ∫ f by points with density p.
    pub fn new(f: F, p: P) -> Self {
        Self { f, p }
    }

    /// ⟨I⟩_prim = f(x)/p(x), x drawn with ξ.
    pub fn primary(&self, xi: &[f64]) -> f64 {
        let x = self.p.sample(xi);
        let p = self.p.pdf(&x);
        (self.f)(x) / p
    }

    /// ⟨I⟩_sec = (1/N) Σ f(x_i)/p(x_i): the `mean`; the `variance()` beside it is that of one sample.
    ///
    /// # Errors
    /// As [`Variable::samples`].
    pub fn secondary(&self, stream: &Stream) -> Result<Moments, Error> {
        self.average(stream)
    }
}

/// An estimator is the random variable f(x)/p(x). Its expected value is I and its variance ∫ f²/p dμ − I².
impl<F: Fn(Point<P>) -> f64, P: Density> Variable for Estimator<F, P> {
    fn dimension(&self) -> usize {
        self.p.dimension()
    }

    fn at(&self, xi: &[f64]) -> f64 {
        self.primary(xi)
    }
}

/// The random variable g(x), x a point with density p. Its expected value is `E[g] = ∫ g p dμ`.
///
/// ```
/// use twoforms_integration::{Interval, Transformed, Uniform, Variable};
///
/// // A uniform variable on [a, b] has mean (a + b)/2 and variance (b − a)²/12.
/// let exact = Transformed::new(|x| x, Uniform(Interval::new(1.0, 4.0)?)).exact(1e-12)?;
/// assert!((exact.mean - 2.5).abs() < 1e-14 && (exact.variance - 0.75).abs() < 1e-14);
/// # Ok::<(), twoforms_integration::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Transformed<G, P> {
    /// g.
    pub g: G,
    /// p: the density of the points.
    pub p: P,
}

impl<G: Fn(Point<P>) -> f64, P: Density> Transformed<G, P> {
    /// g of a point with density p.
    pub fn new(g: G, p: P) -> Self {
        Self { g, p }
    }
}

impl<G: Fn(Point<P>) -> f64, P: Density> Variable for Transformed<G, P> {
    fn dimension(&self) -> usize {
        self.p.dimension()
    }

    fn at(&self, xi: &[f64]) -> f64 {
        (self.g)(self.p.sample(xi))
    }
}
