//! A file worked out: its experiments one after the other.

use toml::Spanned;
use twoforms_estimator::sampler::Sampler;
use twoforms_integration::Source;

use crate::crossing;
use crate::formula::Formula;
use crate::idle;
use crate::lighting::{Lighting, Run};
use crate::outcome::{Finding, Row, Verdict};
use crate::plot::{self, Plot};
use crate::printed::Printed;
use crate::reading::{Error, Text};
use crate::schema::{Expected, Experiment, File, Quantity};
use crate::stage;
use crate::toolkit::{Toolkit, word};
use crate::variable::Subject;

/// How a file is run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Settings {
    /// A tenth of the replicates, and rows that notice only three times as large a change.
    pub quick: bool,
}

/// A reproduction's results.
#[derive(Clone, Debug, PartialEq)]
pub struct Reproduction {
    /// Its name.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// Where the published numbers come from.
    pub source: String,
    /// How the derived numbers come about.
    pub derivation: String,
    /// The seed that it ran with.
    pub seed: u64,
    /// Its experiments.
    pub sections: Vec<Section>,
}

/// An experiment's results.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// What it is about.
    pub title: String,
    /// The formula that it tries.
    pub formula: Option<String>,
    /// The file in which the formula is code.
    pub code: Option<String>,
    /// Its rows.
    pub rows: Vec<Row>,
    /// Its figures.
    pub plots: Vec<Plot>,
}

impl Reproduction {
    /// All rows.
    pub fn rows(&self) -> impl Iterator<Item = &Row> {
        self.sections.iter().flat_map(|section| &section.rows)
    }

    /// Whether no row differs and none is undecided.
    pub fn passed(&self) -> bool {
        self.rows().all(|row| matches!(row.verdict, Verdict::Agrees | Verdict::Exact))
    }
}

/// The chance that any interval of a file misses the truth.
const LEVEL: f64 = 1e-3;
/// R unless said.
const REPLICATES: u32 = 1000;
/// A tenth of the replicates, √10 times as wide intervals.
const QUICK: [f64; 2] = [0.1, 3.17];

/// Who is told what goes on.
#[derive(Clone, Copy)]
pub struct Hears<'a> {
    /// The title of each experiment that is done.
    pub progress: &'a dyn Fn(&str),
    /// What a scene has otherwise than its file means it, and receivers that are left out.
    pub note: &'a dyn Fn(&str),
    /// How much there is of each scene.
    pub detail: &'a dyn Fn(&str),
}

impl Hears<'static> {
    /// Nobody.
    pub const NOBODY: Self = Self { progress: &|_| (), note: &|_| (), detail: &|_| () };
}

/// Works out all experiments of a file.
///
/// # Errors
/// Where the file is wrong, or an experiment asks for what cannot be.
pub fn run(name: &str, text: &Text, settings: Settings, hears: Hears) -> Result<Reproduction, Error> {
    let file = text.parse()?;
    idle::refuse(&file, text)?;
    let seed = file.seed;
    let rows = file.experiment.iter().map(|experiment| experiment.get_ref().row.len()).sum::<usize>();
    let bench = Bench { text, file: &file, settings, hears, seed, level: LEVEL / rows.max(1) as f64 };
    let mut sections = Vec::new();
    for experiment in &file.experiment {
        sections.push(bench.section(experiment)?);
        (hears.progress)(experiment.get_ref().title.as_deref().unwrap_or(name));
    }
    let said = |text: &Option<String>| text.clone().unwrap_or_default();
    Ok(Reproduction {
        name: name.to_owned(),
        title: said(&file.title),
        source: said(&file.source),
        derivation: said(&file.derivation),
        seed,
        sections,
    })
}

/// What all experiments of a file share.
struct Bench<'a> {
    text: &'a Text,
    file: &'a File,
    settings: Settings,
    hears: Hears<'a>,
    seed: u64,
    level: f64,
}

impl Bench<'_> {
    fn section(&self, spanned: &Spanned<Experiment>) -> Result<Section, Error> {
        let experiment = spanned.get_ref();
        let replicates = self.quickly(experiment.replicates.unwrap_or(REPLICATES));
        let run = Run { seed: self.seed, replicates, level: self.level };
        let (findings, plots) = match Lighting::new(experiment, self.text, run, self.hears)? {
            Some(lighting) => self.of_light(experiment, spanned, &lighting)?,
            None => self.of_variable(experiment, spanned, run)?,
        };
        let rows = experiment.row.iter().zip(findings).map(|(row, finding)| self.row(experiment, row, finding));
        Ok(Section {
            title: experiment.title.clone().unwrap_or_default(),
            formula: experiment.formula.clone(),
            code: experiment.code.clone(),
            rows: rows.collect::<Result<_, Error>>()?,
            plots,
        })
    }

    fn quickly(&self, replicates: u32) -> u32 {
        if self.settings.quick {
            ((f64::from(replicates) * QUICK[0]) as u32).max(100).min(replicates)
        } else {
            replicates
        }
    }

    fn of_light(
        &self,
        experiment: &Experiment,
        at: &Spanned<Experiment>,
        lighting: &Lighting,
    ) -> Result<(Vec<Finding>, Vec<Plot>), Error> {
        let findings = experiment.row.iter().map(|row| lighting.find(row, self.text)).collect::<Result<_, Error>>()?;
        let title = experiment.title.as_deref().unwrap_or_default();
        let plots = experiment.figure.map_or(Ok(Vec::new()), |figure| plot::of_light(figure, title, lighting));
        Ok((findings, plots.map_err(|message| self.text.error(at.span(), &message))?))
    }

    fn of_variable(
        &self,
        experiment: &Experiment,
        at: &Spanned<Experiment>,
        run: Run,
    ) -> Result<(Vec<Finding>, Vec<Plot>), Error> {
        let wrong = |message: String| self.text.error(at.span(), &message);
        let growing = growing(experiment, self.text, at)?;
        let subject =
            Subject::new(experiment, self.text, at.span())?.ok_or_else(|| wrong("it has no subject".into()))?;
        let samplers = stage::samplers(experiment, self.text)?;
        if let Some(second) = experiment.samplers.as_ref().and_then(|names| names.get(1)) {
            return Err(self.text.error(second.span(), "an experiment without a scene has one sampler"));
        }
        let toolkit = Toolkit {
            exact: subject.exact().map_err(|error| wrong(error.to_string()))?,
            source: Source { sampler: samplers.first().copied().unwrap_or(Sampler::Independent), seed: run.seed },
            replicates: run.replicates,
            samples: experiment.samples.as_deref().unwrap_or_default(),
            level: run.level,
            subject: &subject,
            growing: &growing,
        };
        let find = |row: &Expected| match *row.quantity.get_ref() {
            Quantity::Crossing => crossing::find(experiment, row, self.text, at),
            _ => toolkit.find(row).map_err(|message| self.text.error(row.quantity.span(), &message)),
        };
        let findings = experiment.row.iter().map(find).collect::<Result<Vec<_>, Error>>()?;
        let title = experiment.title.as_deref().unwrap_or_default();
        let plot = experiment.figure.map(|figure| plot::of_variable(figure, title, &toolkit, &experiment.row));
        Ok((findings, plot.transpose().map_err(wrong)?.into_iter().collect()))
    }

    /// A number as a source prints it.
    fn printed(&self, number: &Spanned<String>, truncated: bool) -> Result<Printed, Error> {
        let none = || format!("\"{}\" is not a number, such as \"0.916\"", number.get_ref());
        Printed::read(number.get_ref(), truncated).ok_or_else(|| self.text.error(number.span(), &none()))
    }

    /// A number with as many decimals as are known, or a formula of the experiment's constants.
    fn derived(&self, number: &Spanned<String>, experiment: &Experiment) -> Result<Printed, Error> {
        if let Some(printed) = Printed::read(number.get_ref(), false).filter(|_| number.get_ref().contains('.')) {
            return Ok(printed);
        }
        let wrong = |message: String| self.text.error(number.span(), &message);
        let value = Formula::new(number.get_ref(), &[], &experiment.constants).map_err(wrong)?.at(&[]);
        if value.is_finite() { Ok(Printed::computed(value)) } else { Err(wrong("it has no finite value".into())) }
    }

    fn row(&self, experiment: &Experiment, row: &Expected, mut finding: Finding) -> Result<Row, Error> {
        let published = row.published.as_ref().map(|number| self.printed(number, row.truncated)).transpose()?;
        let derived = row.derived.as_ref().map(|number| self.derived(number, experiment)).transpose()?;
        let within = |printed: Option<Printed>, error: Option<f64>| match (printed, error) {
            (Some(printed), Some(error)) => Some(printed.within(error)),
            _ => printed,
        };
        let expected = [within(published, row.published_error), within(derived, row.derived_error)];
        if let Some(note) = &row.note {
            finding.note = Some(finding.note.map_or_else(|| note.clone(), |found| format!("{note}; {found}")));
        }
        let detects = row.detects.or(experiment.detects).unwrap_or(self.file.detects);
        let detects = if self.settings.quick { detects * QUICK[1] } else { detects };
        let names = [experiment.title.clone().unwrap_or_default(), described(row)];
        Ok(Row::new(names, expected, finding, detects))
    }
}

/// The integral over 1, 2, 3, … axes, where a row asks where Monte Carlo wins.
fn growing(experiment: &Experiment, text: &Text, at: &Spanned<Experiment>) -> Result<Vec<Subject>, Error> {
    let asked = experiment.row.iter().any(|row| *row.quantity.get_ref() == Quantity::CrossingDimension);
    let Some(most) = experiment.dimensions.filter(|_| asked) else { return Ok(Vec::new()) };
    let of = |d: usize| Subject::new(&Experiment { dimensions: Some(d), ..experiment.clone() }, text, at.span());
    (1..=most).filter_map(|d| of(d).transpose()).collect()
}

/// The quantity with what it depends on: `variance of area/uniform at floor-lit, N = 16`.
fn described(row: &Expected) -> String {
    let mut words = word(*row.quantity.get_ref()).replace('-', " ");
    let mut add = |before: &str, what: Option<String>| {
        if let Some(what) = what {
            words += before;
            words += &what;
        }
    };
    let name = |name: &Option<Spanned<String>>| name.as_ref().map(|name| name.get_ref().clone());
    add(" of ", name(&row.strategy));
    add(" to ", name(&row.to));
    add(", ", name(&row.sampler));
    add(" at ", name(&row.receiver));
    add(", N = ", row.samples.map(|n| n.to_string()));
    add(", δ = ", row.delta.map(|delta| delta.to_string()));
    add(" in ", row.interval.map(|[a, b]| format!("[{a}, {b}]")));
    add(" of f/p at ", row.points.as_ref().map(|x| x.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")));
    add(", m = ", row.nodes.map(|m| m.to_string()));
    add(", number ", row.which.map(|which| which.to_string()));
    words
}
