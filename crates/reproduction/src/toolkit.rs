//! Quantities of random variables and integrals.

use twoforms_comparison::statistics::{LogVariance, clopper_pearson, fit_rate, student_quantile};
use twoforms_integration::{
    Exact, Moments, Replicates, Rule, Sampler, Source, Variable, Versus, crossing, running_means,
};

use crate::outcome::{Finding, Measured};
use crate::schema::{Expected, Quantity, RuleName};
use crate::variable::Subject;

/// A variable with all that its quantities are measured by.
pub struct Toolkit<'a> {
    /// The variable.
    pub subject: &'a Subject,
    /// Its expected value and variance.
    pub exact: Exact,
    /// Where random numbers come from.
    pub source: Source,
    /// R.
    pub replicates: u32,
    /// N of what needs several.
    pub samples: &'a [u32],
    /// The chance that one row's interval misses the truth.
    pub level: f64,
    /// The integral over 1, 2, 3, … axes, where dimensions grow.
    pub growing: &'a [Subject],
}

/// How far values may lie apart, relatively, that do not vary.
const ROUNDING: f64 = 1e-9;

type Found = Result<Finding, String>;

impl Toolkit<'_> {
    /// What is found about a quantity.
    ///
    /// # Errors
    /// What is missing, or why there is no such quantity.
    pub fn find(&self, row: &Expected) -> Found {
        let exact = |value: f64, error: f64| Some([value, error]);
        let Exact { mean, variance, mean_error, variance_error } = self.exact;
        let sigma_error = 0.5 * variance_error / variance.sqrt().max(f64::MIN_POSITIVE);
        match *row.quantity.get_ref() {
            Quantity::Mean => self.mean(exact(mean, mean_error)),
            Quantity::Variance => self.variance(exact(variance, variance_error), |v| v),
            Quantity::Deviation => self.variance(exact(variance.sqrt(), sigma_error), f64::sqrt),
            Quantity::SecondMoment => self.second_moment(),
            Quantity::Identity => {
                let second = self.second_moment_exactly()?;
                self.variance(exact(second.mean - mean * mean, second.mean_error), |v| v)
            }
            Quantity::VarianceOfMean => self.of_mean(row, |v| v),
            Quantity::DeviationOfMean => self.of_mean(row, f64::sqrt),
            Quantity::Probability => self.probability(row),
            Quantity::Drawn => self.drawn(row),
            Quantity::RunningMean => self.running_mean(row),
            Quantity::Outside => self.outside(row),
            Quantity::ErrorRate => self.error_rate(),
            Quantity::Rule => self.rule(row),
            Quantity::CrossingDimension => self.crossing(row),
            other => Err(format!("{} is a quantity of scenes", word(other))),
        }
    }

    fn values(&self) -> Result<Vec<f64>, String> {
        self.subject.variable.samples(&self.source.stream(self.replicates, 0)).map_err(|error| error.to_string())
    }

    fn replicates_of(&self, n: u32) -> Result<Replicates, String> {
        self.subject.variable.replicates(&self.source, n, self.replicates).map_err(|error| error.to_string())
    }

    fn mean(&self, exact: Option<[f64; 2]>) -> Found {
        let measured = self.mean_of(&self.values()?);
        Ok(Finding { exact, measured: Some(measured), ..Finding::default() })
    }

    fn mean_of(&self, values: &[f64]) -> Measured {
        let moments = Moments::of(values);
        let deviation = (moments.variance().unwrap_or(0.0) / values.len() as f64).sqrt();
        Measured::around(moments.mean, student_quantile(z(self.level), values.len() as f64 - 1.0) * deviation)
    }

    fn variance(&self, exact: Option<[f64; 2]>, of: impl Fn(f64) -> f64) -> Found {
        let values = self.values()?;
        if self.exact.variance <= (ROUNDING * self.exact.mean).powi(2) {
            let farthest = values.iter().map(|value| (value - self.exact.mean).abs()).fold(0.0, f64::max);
            if farthest > ROUNDING * self.exact.mean.abs() {
                return Err(format!("a sample lies {farthest:.1e} from the expected value, where none should vary"));
            }
            let which = if farthest == 0.0 { "differs" } else { "lies farther than some rounding" };
            let note = Some(format!("no sample of {} {which} from the expected value", values.len()));
            return Ok(Finding { exact, note, ..Finding::default() });
        }
        let measured = spread(&values, self.level)?;
        Ok(Finding { exact, measured: Some(carried(measured, of)), ..Finding::default() })
    }

    fn second_moment_exactly(&self) -> Result<Exact, String> {
        Squared(&*self.subject.variable).exact(1e-10).map_err(|error| error.to_string())
    }

    fn second_moment(&self) -> Found {
        let exact = self.second_moment_exactly()?;
        let squares: Vec<f64> = self.values()?.iter().map(|value| value * value).collect();
        let measured = Some(self.mean_of(&squares));
        Ok(Finding { exact: Some([exact.mean, exact.mean_error]), measured, ..Finding::default() })
    }

    fn of_mean(&self, row: &Expected, of: impl Fn(f64) -> f64) -> Found {
        let n = row.samples.ok_or("it needs samples = N")?;
        let exact = self.exact.of_mean(n);
        let measured = carried(spread(&self.replicates_of(n)?.estimates, self.level)?, &of);
        let exact = Some([of(exact.variance), exact.variance_error]);
        Ok(Finding { exact, measured: Some(measured), ..Finding::default() })
    }

    fn share(&self, such: impl Iterator<Item = bool>) -> Measured {
        let (hits, all) = such.fold((0_u64, 0_u64), |(hits, all), such| (hits + u64::from(such), all + 1));
        Measured { value: hits as f64 / all as f64, interval: clopper_pearson(hits, all, self.level) }
    }

    fn probability(&self, row: &Expected) -> Found {
        let [a, b] = row.interval.ok_or("it needs interval = [a', b']")?;
        let inside = |w: f64| a <= w && w <= b;
        let exact =
            Inside(&*self.subject.variable, [a, b]).exact(1e-9).ok().map(|share| [share.mean, share.mean_error]);
        let measured = Some(self.share(self.values()?.into_iter().map(inside)));
        Ok(Finding { exact, measured, ..Finding::default() })
    }

    fn drawn(&self, row: &Expected) -> Found {
        let [a, b] = row.interval.ok_or("it needs interval = [a', b']")?;
        let axis = self.subject.axes.first().ok_or("it needs a density")?;
        let exact = Some([axis.probability(a, b), 1e-12]);
        let points = Drawn(self.subject).samples(&self.source.stream(self.replicates, 0)).map_err(|e| e.to_string())?;
        let measured = Some(self.share(points.into_iter().map(|x| a <= x && x <= b)));
        Ok(Finding { exact, measured, ..Finding::default() })
    }

    /// f/p at given points of one axis, averaged: no chance in it.
    fn running_mean(&self, row: &Expected) -> Found {
        let points = row.points.as_ref().ok_or("it needs points = [x, …]")?;
        let axis = self.subject.axes.first().ok_or("it needs an integrand")?;
        let worth = points.iter().map(|&x| self.subject.variable.at(&[axis.cdf(x)]));
        let mean = running_means(worth).last().ok_or("it needs a point")?;
        Ok(Finding { exact: Some([mean, 1e-12 * mean.abs()]), ..Finding::default() })
    }

    fn outside(&self, row: &Expected) -> Found {
        let (n, delta) = (row.samples.ok_or("it needs samples = N")?, row.delta.ok_or("it needs delta = δ")?);
        let bound = self.exact.of_mean(n).sigma() / delta.sqrt();
        let estimates = self.replicates_of(n)?.estimates;
        let measured = self.share(estimates.into_iter().map(|mean| (mean - self.exact.mean).abs() >= bound));
        let note = Some(format!("at most δ = {delta} of all lie {bound:.4} or more away"));
        Ok(Finding { exact: None, measured: Some(measured), at_most: Some(delta), note })
    }

    /// Root mean square error of means ∝ N^slope: half the slope of their variance.
    fn error_rate(&self) -> Found {
        let point = |&n: &u32| {
            let estimates = self.replicates_of(n)?.estimates;
            LogVariance::from_replicates(&estimates).map(|v| (u64::from(n), v)).map_err(|reason| reason.to_string())
        };
        let points = self.samples.iter().map(point).collect::<Result<Vec<_>, String>>()?;
        let fit = fit_rate(&points).map_err(|reason| reason.to_string())?;
        let measured = widened(fit.slope, fit.interval, self.level);
        let half = Measured { value: 0.5 * measured.value, interval: measured.interval.map(|end| 0.5 * end) };
        let exact = (self.source.sampler == Sampler::Independent).then_some([-0.5, 0.0]);
        Ok(Finding { exact, measured: Some(half), ..Finding::default() })
    }

    fn rule(&self, row: &Expected) -> Found {
        let (rule, m) = (rule(row)?, row.nodes.ok_or("it needs nodes = m")?);
        let value = self.subject.variable.by_rule(rule, m);
        let note = Some(format!("the integral less this is {:.3e}", self.exact.mean - value));
        Ok(Finding { exact: Some([value, 1e-12 * value.abs()]), note, ..Finding::default() })
    }

    fn crossing(&self, row: &Expected) -> Found {
        let rows = versus(self.growing, row)?;
        let d = crossing(&rows).ok_or("the rule's error stays the smaller one: let dimensions grow further")?;
        Ok(Finding { exact: Some([d as f64, 0.0]), ..Finding::default() })
    }
}

/// The rule and Monte Carlo over 1, 2, 3, … axes.
///
/// # Errors
/// What is missing, or why there is no such comparison.
pub fn versus(growing: &[Subject], row: &Expected) -> Result<Vec<Versus>, String> {
    let (rule, budget) = (rule(row)?, row.nodes.ok_or("it needs nodes = the most evaluations")?);
    let one = |subject: &Subject| {
        let exact = subject.exact().map_err(|error| error.to_string())?;
        Versus::new(&&*subject.variable, exact, rule, budget).map_err(|error| error.to_string())
    };
    growing.iter().map(one).collect()
}

fn rule(row: &Expected) -> Result<Rule, String> {
    match row.rule.ok_or("it needs rule = \"midpoint\" or \"gauss\"")? {
        RuleName::Midpoint => Ok(Rule::Midpoint),
        RuleName::Gauss => Ok(Rule::GaussLegendre),
    }
}

/// w².
struct Squared<'a>(&'a dyn Variable);

impl Variable for Squared<'_> {
    fn dimension(&self) -> usize {
        self.0.dimension()
    }

    fn at(&self, xi: &[f64]) -> f64 {
        self.0.at(xi).powi(2)
    }
}

/// 1 where a' <= w <= b', else 0.
struct Inside<'a>(&'a dyn Variable, [f64; 2]);

impl Variable for Inside<'_> {
    fn dimension(&self) -> usize {
        self.0.dimension()
    }

    fn at(&self, xi: &[f64]) -> f64 {
        let w = self.0.at(xi);
        if self.1[0] <= w && w <= self.1[1] { 1.0 } else { 0.0 }
    }
}

/// The sampled point along the first axis.
struct Drawn<'a>(&'a Subject);

impl Variable for Drawn<'_> {
    fn dimension(&self) -> usize {
        self.0.variable.dimension()
    }

    fn at(&self, xi: &[f64]) -> f64 {
        self.0.drawn(xi)
    }
}

/// The quantity's word.
pub fn word(quantity: Quantity) -> String {
    let text = toml::Value::try_from(quantity).ok();
    text.and_then(|value| value.as_str().map(str::to_owned)).unwrap_or_default()
}

/// The standard normal's quantile for a two-sided level.
pub fn z(level: f64) -> f64 {
    twoforms_comparison::statistics::normal_quantile(0.5 * level)
}

/// The variance of values with its interval.
///
/// # Errors
/// Why the values do not say.
pub fn spread(values: &[f64], level: f64) -> Result<Measured, String> {
    let measured = LogVariance::from_replicates(values).map_err(|reason| reason.to_string())?;
    let half = student_quantile(z(level), measured.freedom()) * measured.standard_error();
    let value = measured.variance();
    Ok(Measured { value, interval: [value * (-half).exp(), value * half.exp()] })
}

fn carried(measured: Measured, of: impl Fn(f64) -> f64) -> Measured {
    Measured { value: of(measured.value), interval: measured.interval.map(of) }
}

/// A 95 % interval made as wide as a level asks, around its value.
pub fn widened(value: f64, interval: [f64; 2], level: f64) -> Measured {
    let factor = z(level) / z(0.05);
    Measured { value, interval: interval.map(|end| value + factor * (end - value)) }
}
