//! Random variables.

use twoforms_estimator::moments::Moments;
use twoforms_estimator::sampler::Stream;

use crate::cubature::integrate;
use crate::error::Error;
use crate::exact::Exact;
use crate::replicates::Replicates;
use crate::rule::Rule;
use crate::source::{Source, for_each};

/// A random variable: a function of random numbers ξ, each uniform on (0, 1).
///
/// ```
/// use twoforms_integration::{Discrete, Source, Variable, running_means};
///
/// // The strong law of large numbers: means of more and more throws of a die come to 3.5.
/// let die = Discrete::equally_likely([2.0, 3.0, 3.0, 4.0, 4.0, 5.0])?;
/// let throws = die.samples(&Source::independent(0).stream(10_000, 0))?;
/// let means: Vec<f64> = running_means(throws).collect();
/// assert!((means[9_999] - 3.5).abs() < 0.05);
/// # Ok::<(), twoforms_integration::Error>(())
/// ```
pub trait Variable {
    /// Random numbers that it takes.
    fn dimension(&self) -> usize;

    /// Its value for these ξ, as many as [`dimension`](Self::dimension) says.
    fn at(&self, xi: &[f64]) -> f64;

    /// Expected value ∫ w(ξ) dξ and variance `∫ (w(ξ) − E[w])² dξ` without chance, by adaptive cubature over the unit cube.
    /// `tolerance` is the error that may be left: of the expected value relative to |w|, of the variance relative to itself or to
    /// 10⁻¹² |w|², whichever is larger. A variable that does not vary has the variance 0.
    ///
    /// # Errors
    /// [`Error::NotConverged`] where the variable varies too much, has edges in several dimensions, or no finite variance;
    /// [`Error::TooManyDimensions`] from ten on.
    fn exact(&self, tolerance: f64) -> Result<Exact, Error> {
        let (d, middle) = (self.dimension(), self.at(&vec![0.5; self.dimension()]));
        // Deviations from one of its values lose nothing to rounding where all are alike.
        let centre = if middle.is_finite() { middle } else { 0.0 };
        let offset = integrate(d, |xi| self.at(xi) - centre, tolerance, tolerance * centre.abs())?;
        let (mean, size) = (centre + offset.value, centre.abs() + offset.absolute);
        let squared = |xi: &[f64]| (self.at(xi) - mean) * (self.at(xi) - mean);
        let spread = integrate(d, squared, tolerance, tolerance * 1e-12 * size * size)?;
        Ok(Exact { mean, variance: spread.value, mean_error: offset.error, variance_error: spread.error })
    }

    /// Its values for the N samples of a stream, in order.
    ///
    /// # Errors
    /// [`Error::NotFinite`] at the first value that is not finite, [`Error::NoSamples`], [`Error::Sampler`].
    fn samples(&self, stream: &Stream) -> Result<Vec<f64>, Error> {
        let mut values = Vec::with_capacity(stream.n as usize);
        for_each(stream, self.dimension(), |index, xi, weight| {
            values.push(finite(index, weight * self.at(xi), xi)?);
            Ok(())
        })?;
        Ok(values)
    }

    /// The mean of N samples, with the other moments of the single ones.
    ///
    /// # Errors
    /// As [`samples`](Self::samples).
    fn average(&self, stream: &Stream) -> Result<Moments, Error> {
        let (mut moments, mut part) = (Moments::default(), Vec::with_capacity(PART));
        for_each(stream, self.dimension(), |index, xi, weight| {
            part.push(finite(index, weight * self.at(xi), xi)?);
            if part.len() == PART {
                moments = moments + Moments::of(&part);
                part.clear();
            }
            Ok(())
        })?;
        Ok(moments + Moments::of(&part))
    }

    /// R independent means of N samples, N rounded up to what the sampler can spread.
    ///
    /// # Errors
    /// As [`samples`](Self::samples).
    fn replicates(&self, source: &Source, n: u32, r: u32) -> Result<Replicates, Error> {
        let mut replicates = Replicates::default();
        for replicate in 0..r {
            replicates.add(self.average(&source.stream(n, replicate))?);
        }
        Ok(replicates)
    }

    /// Its expected value by a product rule with m nodes along each axis of the unit cube, m to the power of
    /// [`dimension`](Self::dimension) in all. With a uniform density that is the rule on the domain itself.
    fn by_rule(&self, rule: Rule, m: u32) -> f64 {
        rule.integrate(self.dimension(), m, |xi| self.at(xi))
    }
}

/// Samples whose moments are found together.
const PART: usize = 1024;

fn finite(index: u32, value: f64, xi: &[f64]) -> Result<f64, Error> {
    if value.is_finite() { Ok(value) } else { Err(Error::NotFinite { index, value, xi: xi.to_vec() }) }
}

impl<V: Variable + ?Sized> Variable for &V {
    fn dimension(&self) -> usize {
        (**self).dimension()
    }

    fn at(&self, xi: &[f64]) -> f64 {
        (**self).at(xi)
    }
}
