//! What figures show, before they are drawn.

use twoforms_comparison::sweep::{Parameter, Spacing};
use twoforms_integration::running_means;

use crate::lighting::Lighting;
use crate::schema::{Expected, Figure, Quantity};
use crate::toolkit::{Toolkit, versus};

/// Lines over one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// What stands along the horizontal and the vertical axis.
    pub axes: [String; 2],
    /// Whether each axis is divided by powers of ten.
    pub logarithmic: [bool; 2],
    /// The lines.
    pub lines: Vec<Line>,
}

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// What it is.
    pub name: String,
    /// Whether it is computed without chance.
    pub exact: bool,
    /// Its points from left to right.
    pub points: Vec<[f64; 2]>,
}

fn n_axis(up: &str) -> [String; 2] {
    ["N, samples".to_owned(), up.to_owned()]
}

/// The figure of a variable.
///
/// # Errors
/// What is missing.
pub fn of_variable(figure: Figure, title: &str, toolkit: &Toolkit, rows: &[Expected]) -> Result<Plot, String> {
    let title = title.to_owned();
    match figure {
        Figure::RunningMeans => {
            let n = toolkit.samples.last().copied().ok_or("it needs samples = [N]")?;
            let line = |k: u32| {
                let values =
                    toolkit.subject.variable.samples(&toolkit.source.stream(n, k)).map_err(|e| e.to_string())?;
                let means = (1_u32..).zip(running_means(values)).filter(|(n, _)| is_drawn(*n));
                let points = means.map(|(n, mean)| [f64::from(n), mean]).collect();
                Ok(Line { name: format!("stream {}", k + 1), exact: false, points })
            };
            let mut lines = (0..STREAMS).map(line).collect::<Result<Vec<Line>, String>>()?;
            let mean = toolkit.exact.mean;
            lines.push(Line {
                name: "expected value".into(),
                exact: true,
                points: vec![[1.0, mean], [f64::from(n), mean]],
            });
            Ok(Plot { title, axes: n_axis("mean of the first N samples"), logarithmic: [true, false], lines })
        }
        Figure::Errors => {
            let measured = |&n: &u32| {
                let replicates = toolkit.subject.variable.replicates(&toolkit.source, n, toolkit.replicates);
                let replicates = replicates.map_err(|error| error.to_string())?;
                Ok([f64::from(n), replicates.rms_error(toolkit.exact.mean)])
            };
            let measured = toolkit.samples.iter().map(measured).collect::<Result<Vec<_>, String>>()?;
            let exact = toolkit.samples.iter().map(|&n| [f64::from(n), toolkit.exact.of_mean(n).sigma()]).collect();
            let lines = vec![
                Line { name: "measured".into(), exact: false, points: measured },
                Line { name: "σ/√N".into(), exact: true, points: exact },
            ];
            Ok(Plot { title, axes: n_axis("root mean square error"), logarithmic: [true; 2], lines })
        }
        Figure::Dimensions => {
            let row = rows.iter().find(|row| *row.quantity.get_ref() == Quantity::CrossingDimension);
            let rows = versus(toolkit.growing, row.ok_or("it needs a row of crossing-dimension")?)?;
            let line = |name: &str, of: &dyn Fn(&twoforms_integration::Versus) -> f64| Line {
                name: name.into(),
                exact: true,
                points: rows.iter().map(|row| [row.dimension as f64, of(row)]).collect(),
            };
            let lines = vec![line("rule", &|row| row.rule), line("Monte Carlo, σ/√N", &|row| row.monte_carlo)];
            let axes = ["d, dimensions".to_owned(), "error".to_owned()];
            Ok(Plot { title, axes, logarithmic: [false, true], lines })
        }
        Figure::Variances | Figure::Sweep => Err("this figure is one of scenes".into()),
    }
}

/// Streams of running means.
const STREAMS: u32 = 5;

/// Some thirty numbers in each decade.
fn is_drawn(n: u32) -> bool {
    n < 32 || n.is_multiple_of(10_u32.pow((f64::from(n) / 3.2).log10() as u32))
}

/// The figure of the light in a scene, one for each receiver.
///
/// # Errors
/// What is missing.
pub fn of_light(figure: Figure, title: &str, lighting: &Lighting) -> Result<Vec<Plot>, String> {
    let titled = |place: &str| match lighting.places.len() {
        1 => title.to_owned(),
        _ => format!("{title}: {place}"),
    };
    match figure {
        Figure::Variances => Ok(lighting.measured.iter().map(|at| variances(titled(&at.name), at)).collect()),
        Figure::Sweep => {
            let swept = lighting.swept.iter().zip(&lighting.places);
            Ok(swept.map(|(swept, place)| sweep(titled(&place.name), swept)).collect())
        }
        _ => Err("this figure is one of variables and integrals".into()),
    }
}

fn variances(title: String, at: &twoforms_comparison::result::ReceiverResult) -> Plot {
    let mut lines: Vec<Line> = Vec::new();
    for row in &at.rows {
        let Some(variance) = row.variance_of_mean.filter(|&variance| variance > 0.0) else { continue };
        let name = format!("{}, {}", row.strategy, row.sampler);
        let point = [row.samples as f64, variance];
        match lines.iter_mut().find(|line| line.name == name) {
            Some(line) => line.points.push(point),
            None => lines.push(Line { name, exact: false, points: vec![point] }),
        }
    }
    Plot { title, axes: n_axis("variance of the mean"), logarithmic: [true; 2], lines }
}

fn sweep(title: String, swept: &twoforms_comparison::swept::Swept) -> Plot {
    let mut lines: Vec<Line> = Vec::new();
    for step in &swept.steps {
        for variance in &step.light.strategies {
            let Some(value) = variance.variance_of_one.filter(|value| value.luminance > 0.0) else { continue };
            let point = [step.at, value.luminance];
            match lines.iter_mut().find(|line| line.name == variance.strategy) {
                Some(line) => line.points.push(point),
                None => lines.push(Line { name: variance.strategy.clone(), exact: true, points: vec![point] }),
            }
        }
    }
    let unit = if swept.parameter == Parameter::LightScale { "factor" } else { "offset in metres" };
    let axes = [format!("{}, {unit}", swept.parameter.name()), "variance of one sample".to_owned()];
    Plot { title, axes, logarithmic: [swept.scale == Spacing::Log, true], lines }
}
