//! A file worked out: its experiments one after the other.

use toml::Spanned;
use twoforms_estimator::sampler::Sampler;
use twoforms_integration::Source;

use crate::crossing;
use crate::lighting::{Lighting, Run};
use crate::outcome::{Finding, Row, Verdict};
use crate::plot::{self, Plot};
use crate::printed::Printed;
use crate::reading::{Error, Text};
use crate::schema::{Expected, Experiment, File, Quantity};
use crate::stage;
use crate::toolkit::{Toolkit, word};
use crate::variable::Subject;

/// What a run may change of a file.
#[derive(Clone, Copy, Debug, Default)]
pub struct Settings {
    /// The seed; the file's unless said.
    pub seed: Option<u64>,
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

/// Works out all experiments of a file; `progress` is told of each that is done.
///
/// # Errors
/// Where the file is wrong, or an experiment asks for what cannot be.
pub fn run(name: &str, text: &Text, settings: Settings, progress: &dyn Fn(&str)) -> Result<Reproduction, Error> {
    let file = text.parse()?;
    let seed = settings.seed.unwrap_or(file.seed);
    let rows = file.experiment.iter().map(|experiment| experiment.get_ref().row.len()).sum::<usize>();
    let bench = Bench { text, file: &file, settings, seed, level: LEVEL / rows.max(1) as f64 };
    let mut sections = Vec::new();
    for experiment in &file.experiment {
        sections.push(bench.section(experiment)?);
        progress(experiment.get_ref().title.as_deref().unwrap_or(name));
    }
    let said = |text: &Option<String>| text.clone().unwrap_or_default();
    Ok(Reproduction { name: name.to_owned(), title: said(&file.title), source: said(&file.source), seed, sections })
}

/// What all experiments of a file share.
struct Bench<'a> {
    text: &'a Text,
    file: &'a File,
    settings: Settings,
    seed: u64,
    level: f64,
}

impl Bench<'_> {
    fn section(&self, spanned: &Spanned<Experiment>) -> Result<Section, Error> {
        let experiment = spanned.get_ref();
        let replicates = self.replicates(experiment)?;
        let run = Run { seed: self.seed, replicates, level: self.level };
        let (findings, plots) = match Lighting::new(experiment, self.text, run)? {
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

    fn replicates(&self, experiment: &Experiment) -> Result<u32, Error> {
        let Some(replicates) = &experiment.replicates else { return Ok(self.quickly(REPLICATES)) };
        let most = 100_000_000;
        if !(2..=most).contains(replicates.get_ref()) {
            return Err(self.text.error(replicates.span(), &format!("replicates are 2 to {most}")));
        }
        Ok(self.quickly(*replicates.get_ref()))
    }

    fn quickly(&self, replicates: u32) -> u32 {
        if self.settings.quick { ((f64::from(replicates) * QUICK[0]) as u32).max(100) } else { replicates }
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

    fn row(&self, experiment: &Experiment, row: &Expected, mut finding: Finding) -> Result<Row, Error> {
        let printed = |text: &Option<Spanned<String>>, truncated: bool| match text {
            None => Ok(None),
            Some(number) => Printed::read(number.get_ref(), truncated).map(Some).ok_or_else(|| {
                self.text.error(number.span(), &format!("\"{}\" is not a number, such as \"0.916\"", number.get_ref()))
            }),
        };
        let mut expected = [printed(&row.published, row.truncated)?, printed(&row.derived, false)?];
        if let (Some(published), Some(error)) = (&mut expected[0], row.published_error) {
            published.slack = published.slack.map(|slack| slack.max(error));
        }
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
