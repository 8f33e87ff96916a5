//! Densities made of straight pieces: tables, and functions read into tables.

use crate::density::Density;
use crate::domain::{Domain, Interval};
use crate::error::Error;
use crate::line::Line;
use crate::linear::Linear;
use crate::shares::Shares;

/// A density that is a straight line, level or not, on each of several intervals in a row. Its cdf is piecewise linear or
/// quadratic, and inverted exactly: a piece is picked, then a point in it.
///
/// ```
/// use twoforms_integration::{Estimator, Interval, Line, Piecewise, Uniform, Variable};
///
/// let steps = Piecewise::steps(&[0.0, 1.0, 4.0], &[3.0, 1.0])?;
/// assert_eq!(steps.cdf(1.0), 0.5);
///
/// // The best density for f is f/∫f, which takes the integral to know. A table of f comes close.
/// let interval = Interval::new(0.0, 2.0)?;
/// let f = |x: f64| (-x * x).exp();
/// let evenly = Estimator::new(f, Uniform(interval)).exact(1e-9)?.variance;
/// let by_table = Estimator::new(f, Piecewise::of(interval, 16, f)?).exact(1e-9)?.variance;
/// assert!(by_table < evenly / 10_000.0);
/// # Ok::<(), twoforms_integration::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Piecewise {
    /// Where pieces begin, and where the last ends.
    places: Vec<f64>,
    /// Each piece as a density by itself.
    pieces: Vec<Linear>,
    shares: Shares,
}

impl Piecewise {
    /// A histogram: level pieces between the places, each with a height.
    ///
    /// # Errors
    /// [`Error::BadTable`] unless there is one place more than heights; [`Error::BadInterval`] where places do not increase;
    /// [`Error::BadWeight`] where a height is negative or not finite, or none is positive.
    pub fn steps(places: &[f64], heights: &[f64]) -> Result<Self, Error> {
        let must = "one place more than values";
        require(places.len() == heights.len() + 1, places, heights, must)?;
        Self::new(places, heights.iter().map(|&height| [height; 2]))
    }

    /// Straight lines from value to value, given at the places.
    ///
    /// # Errors
    /// As [`steps`](Self::steps), for as many values as places, at least two.
    pub fn lines(places: &[f64], values: &[f64]) -> Result<Self, Error> {
        let must = "as many of each, at least two";
        require(places.len() == values.len() && values.len() >= 2, places, values, must)?;
        Self::new(places, values.windows(2).map(|ends| [ends[0], ends[1]]))
    }

    /// Straight lines between so many cells of equal width, with the values that f has at their ends.
    ///
    /// # Errors
    /// As [`lines`](Self::lines).
    pub fn of(interval: Interval, cells: u32, f: impl Fn(f64) -> f64) -> Result<Self, Error> {
        let place = |k| if k == cells { interval.b() } else { interval.at(&[f64::from(k) / f64::from(cells)]) };
        let places: Vec<f64> = (0..=cells).map(place).collect();
        let values: Vec<f64> = places.iter().map(|&x| f(x)).collect();
        Self::lines(&places, &values)
    }

    fn new(places: &[f64], ends: impl Iterator<Item = [f64; 2]>) -> Result<Self, Error> {
        let (mut pieces, mut areas) = (Vec::new(), Vec::new());
        for (side, ends) in places.windows(2).zip(ends) {
            let interval = Interval::new(side[0], side[1])?;
            // A piece of height zero has no density of its own; it is never picked, and any will do.
            pieces.push(Linear::new(interval, if ends == [0.0; 2] { [1.0; 2] } else { ends })?);
            areas.push(interval.length() * (0.5 * ends[0] + 0.5 * ends[1]));
        }
        Ok(Self { places: places.to_vec(), pieces, shares: Shares::new(areas)? })
    }

    /// The piece that x lies on; the first or the last for an x before or beyond all.
    fn piece(&self, x: f64) -> usize {
        let begun = self.places.partition_point(|&place| place <= x);
        begun.saturating_sub(1).min(self.pieces.len() - 1)
    }
}

fn require(fits: bool, places: &[f64], values: &[f64], must: &'static str) -> Result<(), Error> {
    let [places, values] = [places.len(), values.len()];
    if fits { Ok(()) } else { Err(Error::BadTable { places, values, must }) }
}

impl Density for Piecewise {
    type Domain = Interval;

    fn dimension(&self) -> usize {
        1
    }

    fn sample(&self, xi: &[f64]) -> f64 {
        let (k, rest) = self.shares.invert(xi[0]);
        self.pieces[k].sample(&[rest])
    }

    fn pdf(&self, x: &f64) -> f64 {
        let k = self.piece(*x);
        self.shares.share(k) * self.pieces[k].pdf(x)
    }
}

impl Line for Piecewise {
    fn cdf(&self, x: f64) -> f64 {
        let k = self.piece(x);
        self.shares.before(k) + self.shares.share(k) * self.pieces[k].cdf(x)
    }
}
