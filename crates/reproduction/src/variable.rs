//! From what a file says to the random variable that it means.

use twoforms_integration::density::Density as _;
use twoforms_integration::{Discrete, Estimator, Exact, Given, Interval, Line, Uniform, Variable};

use crate::either::Density;
use crate::formula::Formula;
use crate::reading::{Error, Text};
use crate::schema::Experiment;

/// A density along an axis, whichever it is.
pub type Axis = Box<dyn Line<Domain = Interval>>;

/// A variable, and what may be known of it beside its values.
pub struct Subject {
    /// The variable: a die, or a primary estimator f/p.
    pub variable: Box<dyn Variable>,
    /// The densities along the axes of an integral.
    pub axes: Vec<Axis>,
    /// Expected value and variance where they are sums.
    pub known: Option<Exact>,
}

/// The primary estimator f(x)/p(x) of an integral over a box.
struct Primary<F> {
    f: F,
    p: Vec<Axis>,
}

impl<F: Fn(&[f64]) -> f64> Variable for Primary<F> {
    fn dimension(&self) -> usize {
        self.p.len()
    }

    fn at(&self, xi: &[f64]) -> f64 {
        Estimator::new(|x: Vec<f64>| (self.f)(&x), &self.p).at(xi)
    }
}

impl Subject {
    /// The variable of an experiment about one; `None` where it is about a scene.
    ///
    /// # Errors
    /// Where it says several subjects, or none that can be.
    pub fn new(experiment: &Experiment, text: &Text, at: std::ops::Range<usize>) -> Result<Option<Self>, Error> {
        let subjects = [experiment.values.is_some(), experiment.integrand.is_some(), experiment.scene.is_some()];
        if subjects.into_iter().filter(|&said| said).count() != 1 {
            return Err(text.error(at, "an experiment has one subject: give it values, an integrand or a scene"));
        }
        if let Some(values) = &experiment.values {
            let die = Discrete::equally_likely(values.iter().copied()).map_err(|e| text.error(at, &e.to_string()))?;
            let known = Some(Exact::known(die.mean(), die.variance()));
            return Ok(Some(Self { variable: Box::new(die), axes: Vec::new(), known }));
        }
        match experiment.dimensions {
            None => Self::integral(experiment, text, at).map(Some),
            Some(d) => Self::sum(experiment, text, at, d).map(Some),
        }
    }

    fn integral(experiment: &Experiment, text: &Text, at: std::ops::Range<usize>) -> Result<Self, Error> {
        let Some(integrand) = &experiment.integrand else { return Err(text.error(at, "there is no integrand")) };
        let domain = experiment.domain.clone().unwrap_or_else(|| vec![[0.0, 1.0]]);
        let names = experiment.axes.clone().unwrap_or_else(|| ["x", "y", "z"].map(str::to_owned).into());
        if domain.is_empty() || domain.len() > names.len() {
            let message = format!("{} intervals need as many names under axes", domain.len());
            return Err(text.error(integrand.span(), &message));
        }
        let names = &names[..domain.len()];
        let formula = Formula::new(integrand.get_ref(), names, &experiment.constants)
            .map_err(|message| text.error(integrand.span(), &message))?;
        let p = densities(experiment, &domain, names, text, at.clone())?;
        let axes = densities(experiment, &domain, names, text, at)?;
        Ok(Self { variable: Box::new(Primary { f: move |x: &[f64]| formula.at(x), p }), axes, known: None })
    }

    /// f(x₁) + … + f(x_d): expected value and variance are d times those of f(x).
    fn sum(experiment: &Experiment, text: &Text, at: std::ops::Range<usize>, d: usize) -> Result<Self, Error> {
        let one = Self::integral(&Experiment { dimensions: None, ..experiment.clone() }, text, at.clone())?;
        let Some(integrand) = &experiment.integrand else { return Err(text.error(at, "there is no integrand")) };
        let domain = experiment.domain.as_ref().map_or([0.0, 1.0], |domain| domain[0]);
        let unit = Interval::new(domain[0], domain[1]).map_err(|error| text.error(at.clone(), &error.to_string()))?;
        if one.axes.len() != 1 || experiment.density.is_some() || !(1..=9).contains(&d) {
            return Err(text.error(at, "dimensions need 1 to 9 axes like one, and a uniform density"));
        }
        let names = experiment.axes.clone().unwrap_or_else(|| vec!["x".to_owned()]);
        let term = Formula::new(integrand.get_ref(), &names, &experiment.constants)
            .map_err(|message| text.error(integrand.span(), &message))?;
        let exact = one.variable.exact(TOLERANCE).map_err(|error| text.error(at, &error.to_string()))?;
        let per_axis = unit.length().powi(d as i32 - 1);
        let scaled = Exact {
            mean: exact.mean * per_axis,
            variance: exact.variance * per_axis * per_axis,
            mean_error: exact.mean_error * per_axis,
            variance_error: exact.variance_error * per_axis * per_axis,
        };
        let known = (1..d).fold(scaled, |sum, _| sum + scaled);
        let f = move |x: &[f64]| x.iter().map(|&x| term.at(&[x])).sum();
        let p: Vec<Axis> = (0..d).map(|_| Box::new(Uniform(unit)) as Axis).collect();
        Ok(Self { variable: Box::new(Primary { f, p }), axes: Vec::new(), known: Some(known) })
    }

    /// Expected value and variance without chance. Where they are no sums, the cubature is asked for a tenth of the error that is
    /// given here: what it says of its own error is an estimate, and small by luck at some jumps.
    ///
    /// # Errors
    /// Where the cubature does not converge.
    pub fn exact(&self) -> Result<Exact, twoforms_integration::Error> {
        if let Some(known) = self.known {
            return Ok(known);
        }
        let exact = self.variable.exact(0.1 * TOLERANCE)?;
        let error = |estimate: f64, value: f64| (10.0 * estimate).max(TOLERANCE * value.abs());
        let (mean_error, variance_error) =
            (error(exact.mean_error, exact.mean), error(exact.variance_error, exact.variance));
        Ok(Exact { mean_error, variance_error, ..exact })
    }

    /// The point along the first axis for these random numbers.
    pub fn drawn(&self, xi: &[f64]) -> f64 {
        self.axes.first().map_or(f64::NAN, |axis| axis.sample(&xi[..1]))
    }
}

/// Relative error of what is exact.
const TOLERANCE: f64 = 1e-10;

fn densities(
    experiment: &Experiment,
    domain: &[[f64; 2]],
    names: &[String],
    text: &Text,
    at: std::ops::Range<usize>,
) -> Result<Vec<Axis>, Error> {
    let given = experiment.density.as_deref().unwrap_or_default();
    if !given.is_empty() && given.len() != domain.len() {
        let message = format!("{} densities stand for {} axes: give one for each", given.len(), domain.len());
        return Err(text.error(given[0].span(), &message));
    }
    let axis = |k: usize| {
        let interval = Interval::new(domain[k][0], domain[k][1]).map_err(|e| text.error(at.clone(), &e.to_string()))?;
        match given.get(k) {
            None => Ok(Box::new(Uniform(interval)) as Axis),
            Some(density) => of_text(density.get_ref(), interval, &names[k], experiment)
                .map_err(|message| text.error(density.span(), &message)),
        }
    };
    (0..domain.len()).map(axis).collect()
}

fn of_text(density: &Density, interval: Interval, name: &str, in_: &Experiment) -> Result<Axis, String> {
    let given = match density {
        Density::Named(word) if word == "uniform" => return Ok(Box::new(Uniform(interval))),
        Density::Named(word) => {
            return Err(format!("\"{word}\" is no density: there are \"uniform\" and {{ cdf = \"…\" }}"));
        }
        Density::Given(given) => given,
    };
    let axes = [name.to_owned()];
    let formula = |text: &str, axes: &[String]| Formula::new(text, axes, &in_.constants);
    let cdf = formula(&given.cdf, &axes)?;
    let pdf = match &given.pdf {
        Some(pdf) => formula(pdf, &axes)?,
        None => cdf.derivative(name, &axes, &in_.constants)?,
    };
    let p = move |x: f64| pdf.at(&[x]);
    let f = move |x: f64| cdf.at(&[x]);
    let refused = |error: twoforms_integration::Error| error.to_string();
    match &given.inverse {
        None => Ok(Box::new(Given::numeric(interval, p, f).map_err(refused)?)),
        Some(inverse) => {
            let inverse = formula(inverse, &["xi".to_owned()])?;
            Ok(Box::new(Given::closed(interval, p, f, move |xi: f64| inverse.at(&[xi])).map_err(refused)?))
        }
    }
}
