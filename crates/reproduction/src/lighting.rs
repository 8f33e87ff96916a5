//! Quantities of the light in a scene.

use twoforms_comparison::exactly::{self, ExactResult};
use twoforms_comparison::experiment::Experiment as Comparison;
use twoforms_comparison::place::{self, Place};
use twoforms_comparison::result::{ReceiverResult, Row};
use twoforms_comparison::statistics::student_quantile;
use twoforms_comparison::sweep::Sweep;
use twoforms_comparison::swept::{Crossing, Swept, swept};
use twoforms_comparison::verdict::Criteria;
use twoforms_comparison::world::World;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;

use crate::nested;
use crate::outcome::{Finding, Measured};
use crate::reading::{Error, Text};
use crate::reproduction::Hears;
use crate::schema::{Expected, Experiment, Quantity};
use crate::stage;
use crate::toolkit::{widened, word, z};

/// The light of one experiment: all that its rows ask about, worked out once.
pub struct Lighting {
    /// The scene.
    pub world: World,
    /// Its receivers.
    pub places: Vec<Place>,
    /// What was measured at each; nothing where no row asks for it.
    pub measured: Vec<ReceiverResult>,
    /// What is known without chance at each.
    pub exact: Vec<ExactResult>,
    /// The exact variances along the sweep, receiver by receiver.
    pub swept: Vec<Swept>,
    /// Nested samples, where they are asked for, and the seed.
    pub nested: Option<[u32; 2]>,
    /// The seed.
    pub seed: u64,
    /// R.
    pub replicates: u32,
    /// The chance that one row's interval misses the truth.
    pub level: f64,
}

/// What is compared when an experiment says little.
const SAMPLES: [u32; 2] = [16, 64];

impl Lighting {
    /// Works out all that the rows of an experiment ask about.
    ///
    /// # Errors
    /// Where a name is unknown, or what is asked is impossible.
    pub fn new(experiment: &Experiment, text: &Text, run: Run, hears: Hears) -> Result<Option<Self>, Error> {
        let Some(scene) = &experiment.scene else { return Ok(None) };
        let world = stage::world(scene, text, hears.note, hears.detail)?;
        let places = stage::places(experiment, &world, text, hears.note)?;
        let strategies = strategies(experiment, text)?;
        let exact = exactly::exactly(&world, &places, &strategies, &|_| ());
        let comparison = Comparison {
            strategies: measured_strategies(experiment, text)?,
            samplers: stage::samplers(experiment, text)?,
            samples: experiment.samples.clone().unwrap_or_else(|| SAMPLES.to_vec()),
            replicates: run.replicates,
            seed: run.seed,
            criteria: Criteria::default(),
        };
        let wrong = |message: String| text.error(scene.span(), &message);
        let measured = comparison.run(&world, &places, &|_| ()).map_err(|error| wrong(error.to_string()))?;
        let swept = match &experiment.sweep {
            None => Vec::new(),
            Some(sweep) => {
                let parsed = sweep.get_ref().parse::<Sweep>();
                let parsed = parsed.map_err(|error| text.error(sweep.span(), &error.to_string()))?;
                swept(&world, &places, &strategies, &parsed, &|_| ())
                    .into_iter()
                    .filter_map(|result| result.sweep)
                    .collect()
            }
        };
        let Run { seed, replicates, level } = run;
        let nested = experiment.nested;
        Ok(Some(Self { world, places, measured, exact, swept, nested, seed, replicates, level }))
    }

    /// What is found about a row's quantity.
    ///
    /// # Errors
    /// What is missing, or why there is no such quantity.
    pub fn find(&self, row: &Expected, text: &Text) -> Result<Finding, Error> {
        let wrong = |message: String| text.error(row.quantity.span(), &message);
        let at = self.receiver(row, text)?;
        let named = |name: &Option<toml::Spanned<String>>, key: &str| match name {
            Some(name) => stage::strategy(name, text),
            None => Err(wrong(format!("it needs {key} = \"…\""))),
        };
        let sampler = row.sampler.as_ref().map_or(Ok(Sampler::Independent), |name| stage::sampler(name, text))?;
        match *row.quantity.get_ref() {
            Quantity::Irradiance | Quantity::Radiance => {
                let asked = self.asked();
                if *row.quantity.get_ref() != asked {
                    return Err(wrong(format!("the experiment asks for {0}: its quantity is {0}", word(asked))));
                }
                let strategy = row.strategy.as_ref().map(|name| stage::strategy(name, text)).transpose()?;
                Ok(self.irradiance(at, strategy, sampler))
            }
            Quantity::Variance => self.variance(at, named(&row.strategy, "strategy")?, sampler).map_err(wrong),
            Quantity::Ratio => {
                let of = [named(&row.strategy, "strategy")?, named(&row.to, "to")?];
                self.ratio(at, of, sampler).map_err(wrong)
            }
            Quantity::Rate => self.rate(at, named(&row.strategy, "strategy")?, sampler).map_err(wrong),
            Quantity::Crossing => {
                let of = [named(&row.strategy, "strategy")?, named(&row.to, "to")?];
                self.crossing(at, of, row.which.unwrap_or(1) as usize).map_err(wrong)
            }
            Quantity::Crossings => {
                let of = [named(&row.strategy, "strategy")?, named(&row.to, "to")?];
                let count = self.crossings(at, of).map_err(wrong)?.count();
                Ok(Finding { exact: Some([count as f64, 0.0]), ..Finding::default() })
            }
            Quantity::SolidAngle => Ok(nested::solid_angle(self, at)),
            Quantity::Emitted => Ok(nested::emitted(self, at)),
            Quantity::Direct => nested::direct(self, at).map_err(wrong),
            Quantity::Nested => nested::twice(self, at).map_err(wrong),
            other => Err(wrong(format!("{} is a quantity of variables and integrals", word(other)))),
        }
    }

    fn receiver(&self, row: &Expected, text: &Text) -> Result<usize, Error> {
        match (&row.receiver, &self.places[..]) {
            (None, [_]) => Ok(0),
            (None, _) => Err(text.error(row.quantity.span(), "the experiment has several receivers: say which")),
            (Some(name), places) => {
                let found = places.iter().position(|place| place.name == *name.get_ref());
                found.ok_or_else(|| text.error(name.span(), "the experiment has no such receiver"))
            }
        }
    }

    /// The row of most samples.
    fn row(&self, at: usize, strategy: Strategy, sampler: Sampler) -> Option<&Row> {
        let (strategy, sampler) = (strategy.to_string(), sampler.to_string());
        let rows = self.measured[at].rows.iter();
        rows.filter(|row| row.strategy == strategy && row.sampler == sampler).max_by_key(|row| row.samples)
    }

    fn irradiance(&self, at: usize, strategy: Option<Strategy>, sampler: Sampler) -> Finding {
        let exact = self.exact[at].light.irradiance.map(|value| [value.luminance, value.error_bound]);
        let row = strategy.and_then(|strategy| self.row(at, strategy, sampler));
        let measured = row.and_then(|row| {
            let deviation = (row.variance_of_mean? / row.replicates as f64).sqrt();
            let quantile = student_quantile(z(self.level), row.replicates as f64 - 1.0);
            let arithmetic = ARITHMETIC * row.mean.luminance.abs();
            Some(Measured::around(row.mean.luminance, quantile * deviation + arithmetic))
        });
        Finding { exact, measured, ..Finding::default() }
    }

    fn exact_variance(&self, at: usize, strategy: Strategy) -> Option<[f64; 2]> {
        let name = strategy.to_string();
        let found = self.exact[at].light.strategies.iter().find(|variance| variance.strategy == name)?;
        found.variance_of_one.map(|value| [value.luminance, value.error_bound])
    }

    fn variance(&self, at: usize, strategy: Strategy, sampler: Sampler) -> Result<Finding, String> {
        let exact = self.exact_variance(at, strategy).filter(|_| sampler == Sampler::Independent);
        let mut finding = Finding { exact, ..Finding::default() };
        let Some(row) = self.row(at, strategy, sampler) else { return Ok(finding) };
        let n = row.samples as f64;
        if let (Some(variance), Some(interval)) = (row.variance_of_mean, row.variance_interval) {
            finding.measured = Some(on_logs(variance * n, interval.map(|end| end * n), self.level));
        }
        // Where nothing varies there is only what binary32 arithmetic leaves: no interval holds that against zero.
        if exact.is_some_and(|[value, error]| value.abs() <= error) {
            let mean = row.mean.luminance;
            let most = exact.map_or(0.0, |[value, error]| (value.abs() + error) / (mean * mean)).max(NO_VARIANCE);
            let share = row.variance_of_mean.unwrap_or(f64::NAN) * n / (mean * mean);
            if share > most {
                return Err(format!(
                    "the measured variance is {share:.1e} of the squared mean, where there should be none"
                ));
            }
            finding.measured = None;
            finding.note = Some(format!("measured: {share:.1e} of the squared mean, which is rounding"));
        }
        Ok(finding)
    }

    fn ratio(&self, at: usize, [of, to]: [Strategy; 2], sampler: Sampler) -> Result<Finding, String> {
        let exact = self.exact_variance(at, of).zip(self.exact_variance(at, to)).map(|([a, da], [b, db])| {
            let ratio = a / b;
            [ratio, ratio * (da / a + db / b)]
        });
        let exact = exact.filter(|_| sampler == Sampler::Independent);
        let measured = |strategy| self.variance(at, strategy, sampler).map(|finding| finding.measured);
        let (Some(a), Some(b)) = (measured(of)?, measured(to)?) else {
            return Ok(Finding { exact, ..Finding::default() });
        };
        let half = |m: &Measured| 0.5 * (m.interval[1] / m.interval[0]).ln();
        let (value, half) = (a.value / b.value, half(&a).hypot(half(&b)));
        let measured = Measured { value, interval: [value * (-half).exp(), value * half.exp()] };
        Ok(Finding { exact, measured: Some(measured), ..Finding::default() })
    }

    fn rate(&self, at: usize, strategy: Strategy, sampler: Sampler) -> Result<Finding, String> {
        let (strategy, sampler) = (strategy.to_string(), sampler.to_string());
        let mut rates = self.measured[at].rates.iter();
        let rate = rates.find(|rate| rate.strategy == strategy && rate.sampler == sampler);
        let found = rate.and_then(|rate| Some((rate.slope?, rate.interval?)));
        let (slope, interval) = found.ok_or("no rate could be fitted: give more sample counts")?;
        Ok(Finding { measured: Some(widened(slope, interval, self.level)), ..Finding::default() })
    }

    fn crossing(&self, at: usize, of: [Strategy; 2], which: usize) -> Result<Finding, String> {
        let found = self.crossings(at, of)?.nth(which - 1).ok_or("their variances do not cross there so often")?;
        Ok(Finding { exact: Some([found.at, found.error_bound.max(1e-9 * found.at.abs())]), ..Finding::default() })
    }

    /// Where two strategies have equal variance along the sweep.
    fn crossings(&self, at: usize, of: [Strategy; 2]) -> Result<impl Iterator<Item = &Crossing>, String> {
        let swept = self.swept.get(at).ok_or("it needs a sweep")?;
        let names = of.map(|strategy| strategy.to_string());
        Ok(swept.crossings.iter().filter(move |crossing| names.iter().all(|name| crossing.strategies.contains(name))))
    }

    /// What is asked at the receivers.
    fn asked(&self) -> Quantity {
        match self.places[0].quantity {
            place::Quantity::Irradiance => Quantity::Irradiance,
            place::Quantity::Radiance { .. } => Quantity::Radiance,
        }
    }
}

/// How an experiment is run.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// The seed.
    pub seed: u64,
    /// R.
    pub replicates: u32,
    /// The chance that one row's interval misses the truth.
    pub level: f64,
}

/// What binary32 arithmetic may add to a mean, as a share of it.
pub const ARITHMETIC: f64 = 3e-6;
/// A variance that is all rounding, as a share of the squared mean.
const NO_VARIANCE: f64 = 1e-12;

/// Every strategy that the experiment or one of its rows names.
fn strategies(experiment: &Experiment, text: &Text) -> Result<Vec<Strategy>, Error> {
    let listed = experiment.strategies.iter().flatten();
    let in_rows = experiment.row.iter().flat_map(|row| row.strategy.iter().chain(&row.to));
    let mut strategies = Vec::new();
    for name in listed.chain(in_rows) {
        let strategy = stage::strategy(name, text)?;
        if !strategies.contains(&strategy) {
            strategies.push(strategy);
        }
    }
    Ok(strategies)
}

/// Those whose samples a row needs.
fn measured_strategies(experiment: &Experiment, text: &Text) -> Result<Vec<Strategy>, Error> {
    if experiment.chance == Some(false) {
        return Ok(Vec::new());
    }
    let needs_none = |row: &Expected| matches!(row.quantity.get_ref(), Quantity::Crossing | Quantity::Crossings);
    let row = experiment.row.iter().filter(|row| !needs_none(row)).cloned().collect();
    let drawn = experiment.figure == Some(crate::schema::Figure::Variances);
    let listed = experiment.strategies.clone().filter(|_| drawn);
    strategies(&Experiment { strategies: listed, row, ..Experiment::default() }, text)
}

/// A 95 % interval of a variance made as wide as a level asks, on the scale of logarithms.
fn on_logs(value: f64, interval: [f64; 2], level: f64) -> Measured {
    let logs = widened(value.ln(), interval.map(f64::ln), level);
    Measured { value, interval: logs.interval.map(f64::exp) }
}
