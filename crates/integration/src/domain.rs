//! Measured domains: what an integral is taken over.

use crate::error::Error;

/// A set with a finite measure, and a map that carries the unit cube onto it evenly: equal volumes of the cube to equal
/// measures. Integrals over it are means over the cube, ∫ f dμ = μ ∫ f(x(ξ)) dξ.
///
/// Arrays, vectors and pairs of domains are domains too, with the product measure: `[Interval; 2]` is a rectangle,
/// `vec![interval; d]` is [a, b]^d. A triangle of area one half, as an example of one's own:
///
/// ```
/// use twoforms_integration::{Domain, Estimator, Uniform, Variable};
///
/// /// 0 <= y <= x <= 1, measured by area.
/// struct Triangle;
///
/// impl Domain for Triangle {
///     type Point = [f64; 2];
///     fn dimension(&self) -> usize {
///         2
///     }
///     fn measure(&self) -> f64 {
///         0.5
///     }
///     fn contains(&self, [x, y]: &[f64; 2]) -> bool {
///         0.0 <= *y && y <= x && *x <= 1.0
///     }
///     fn at(&self, xi: &[f64]) -> [f64; 2] {
///         let x = xi[0].sqrt();
///         [x, x * xi[1]]
///     }
/// }
///
/// // ∫₀¹ ∫₀ˣ x y dy dx = 1/8.
/// let estimator = Estimator::new(|[x, y]: [f64; 2]| x * y, Uniform(Triangle));
/// assert!((estimator.exact(1e-10)?.mean - 0.125).abs() < 1e-12);
/// # Ok::<(), twoforms_integration::Error>(())
/// ```
pub trait Domain {
    /// A point of it, in its coordinates.
    type Point;

    /// Random numbers that a point takes.
    fn dimension(&self) -> usize;

    /// μ: the measure of all of it, in the unit of the measure.
    fn measure(&self) -> f64;

    /// Whether a point lies in it.
    fn contains(&self, x: &Self::Point) -> bool;

    /// The point x(ξ), from as many ξ in (0, 1) as [`dimension`](Self::dimension) says.
    fn at(&self, xi: &[f64]) -> Self::Point;
}

/// [a, b], measured by length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    a: f64,
    b: f64,
}

impl Interval {
    /// [0, 1].
    pub const UNIT: Self = Self { a: 0.0, b: 1.0 };

    /// [a, b].
    ///
    /// # Errors
    /// [`Error::BadInterval`] where a and b are not finite or a is not below b.
    pub fn new(a: f64, b: f64) -> Result<Self, Error> {
        // The length too must be finite, which that of two finite numbers need not be.
        if a < b && (b - a).is_finite() { Ok(Self { a, b }) } else { Err(Error::BadInterval { a, b }) }
    }

    /// a.
    pub fn a(&self) -> f64 {
        self.a
    }

    /// b.
    pub fn b(&self) -> f64 {
        self.b
    }

    /// b − a.
    pub fn length(&self) -> f64 {
        self.b - self.a
    }

    /// The nearest number of the interval: x itself where it lies inside.
    pub fn nearest(&self, x: f64) -> f64 {
        x.clamp(self.a, self.b)
    }

    /// (x − a)/(b − a), and 0 or 1 for an x before or beyond the interval.
    pub fn share(&self, x: f64) -> f64 {
        (self.nearest(x) - self.a) / self.length()
    }
}

impl Domain for Interval {
    type Point = f64;

    fn dimension(&self) -> usize {
        1
    }

    fn measure(&self) -> f64 {
        self.length()
    }

    fn contains(&self, x: &f64) -> bool {
        self.a <= *x && *x <= self.b
    }

    /// a + (b − a) ξ, which rounding shall not carry beyond b.
    fn at(&self, xi: &[f64]) -> f64 {
        self.nearest(self.a + self.length() * xi[0])
    }
}
