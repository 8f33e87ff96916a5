//! Exact light: the document, its table and its CSV.

use std::collections::BTreeMap;
use std::io::Write;

use ::csv::Writer;
use serde::Serialize;
use twoforms_comparison::exactly::{Bounded, ExactLight, ExactResult, ExactVariance};
use twoforms_comparison::swept::Swept;

use crate::error::ReportError;
use crate::finite;
use crate::layout::{layout, note, plain};
use crate::number::{NONE, count, short, significant};
use crate::provenance::Provenance;
use crate::sweep;

/// Name and version of the format.
pub const SCHEMA: &str = "twoforms.exact/1";

/// What `twoforms exact` says, in this order.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExactDocument {
    schema: &'static str,
    scene: String,
    provenance: Provenance,
    receivers: Vec<ExactResult>,
}

impl ExactDocument {
    /// A document of these results.
    ///
    /// # Errors
    /// [`ReportError::NotFinite`] where a number is NaN or infinite.
    pub fn new(provenance: Provenance, receivers: Vec<ExactResult>) -> Result<Self, ReportError> {
        finite::check("receivers", &receivers)?;
        Ok(Self { schema: SCHEMA, scene: provenance.scene.clone(), provenance, receivers })
    }

    /// Writes indented JSON with a final newline.
    ///
    /// # Errors
    /// [`ReportError::Stream`] where `out` takes no more.
    pub fn write_json(&self, mut out: impl Write) -> Result<(), ReportError> {
        serde_json::to_writer_pretty(&mut out, self).map_err(std::io::Error::from)?;
        Ok(out.write_all(b"\n")?)
    }

    /// Writes one line per receiver and strategy; along a sweep one for each of its steps, whose value stands in a last
    /// column of the parameter's name. A missing value is `NaN`.
    ///
    /// # Errors
    /// [`ReportError::Stream`] where `out` takes no more.
    pub fn write_csv(&self, out: impl Write) -> Result<(), ReportError> {
        let mut csv = Writer::from_writer(out);
        let swept = self.receivers.iter().find_map(|receiver| receiver.sweep.as_ref());
        let parameter = swept.map(|sweep| sweep.parameter.name());
        csv.write_record(COLUMNS.into_iter().chain(parameter)).map_err(std::io::Error::from)?;
        for receiver in &self.receivers {
            for (at, light) in lights(receiver) {
                for variance in &light.strategies {
                    let value = at.map(|at| number(Some(at)));
                    let record = record(receiver, light, variance).into_iter().chain(value);
                    csv.write_record(record).map_err(std::io::Error::from)?;
                }
            }
        }
        Ok(csv.flush()?)
    }

    /// Tables for people: a block per receiver. `samples for 1 %` is the N at which the standard deviation of an estimate
    /// is one percent of the value: V / (0.01 E)².
    pub fn text(&self) -> String {
        let swept = |receiver: &ExactResult| Some(sweep::text(receiver, receiver.sweep.as_ref()?));
        let sweeps: Vec<String> = self.receivers.iter().filter_map(swept).collect();
        let (blocks, note) =
            if sweeps.is_empty() { (self.blocks(), None) } else { (sweeps, Some(sweep::NOTE.to_owned())) };
        blocks.into_iter().chain(note).collect::<Vec<_>>().join("\n\n") + "\n"
    }

    /// A block per receiver, a line per strategy.
    fn blocks(&self) -> Vec<String> {
        let lines_of = |receiver: &ExactResult| -> Vec<Vec<String>> {
            receiver.light.strategies.iter().map(|v| cells(&receiver.light, v)).collect()
        };
        let lines = layout(&HEADER, self.receivers.iter().flat_map(lines_of), 1);
        let (header, mut rest) = lines.split_at(lines.len().min(2));
        let block = |receiver: &ExactResult| {
            let (rows, after) = rest.split_at(receiver.light.strategies.len());
            rest = after;
            let header = if rows.is_empty() { &[] } else { header };
            [&[heading(receiver)][..], header, rows, &reasons(&receiver.light)].concat().join("\n")
        };
        self.receivers.iter().map(block).collect()
    }
}

/// The light at each step of a sweep, with the parameter's value, or else at rest.
fn lights(receiver: &ExactResult) -> Vec<(Option<f64>, &ExactLight)> {
    match &receiver.sweep {
        None => vec![(None, &receiver.light)],
        Some(Swept { steps, .. }) => steps.iter().map(|step| (Some(step.at), &step.light)).collect(),
    }
}

const COLUMNS: [&str; 13] = [
    "receiver",
    "x",
    "y",
    "z",
    "irradiance",
    "irradiance_error_bound",
    "strategy",
    "variance_of_one",
    "variance_error_bound",
    "variance_r",
    "variance_g",
    "variance_b",
    "irradiance_unoccluded",
];

fn number(value: Option<f64>) -> String {
    format!("{:?}", value.unwrap_or(f64::NAN))
}

fn record(receiver: &ExactResult, light: &ExactLight, variance: &ExactVariance) -> Vec<String> {
    let (e, v) = (light.irradiance, variance.variance_of_one);
    let [x, y, z] = receiver.position.map(Some);
    let rgb = |c: usize| v.map(|v| v.rgb[c]);
    let open = light.irradiance_unoccluded.map(|open| open.luminance);
    let values = |values: &[Option<f64>]| values.iter().map(|&value| number(value)).collect::<Vec<_>>();
    let before = values(&[x, y, z, e.map(|e| e.luminance), e.map(|e| e.error_bound)]);
    let after = values(&[v.map(|v| v.luminance), v.map(|v| v.error_bound), rgb(0), rgb(1), rgb(2), open]);
    [vec![receiver.name.clone()], before, vec![variance.strategy.clone()], after].concat()
}

const HEADER: [&str; 5] = ["strategy", "variance of one", "error bound", "σ / E", "samples for 1 %"];

fn cells(light: &ExactLight, variance: &ExactVariance) -> Vec<String> {
    let e = light.irradiance.map_or(0.0, |e| e.luminance);
    let relative = |v: Bounded| (e > 0.0).then(|| v.luminance.max(0.0) / (e * e));
    let cell = |value: Option<f64>, shown: fn(f64) -> String| value.map_or(NONE.to_owned(), shown);
    let v = variance.variance_of_one;
    vec![
        variance.strategy.clone(),
        cell(v.map(|v| v.luminance), significant),
        cell(v.map(|v| v.error_bound), |bound| if bound == 0.0 { "0".to_owned() } else { format!("{bound:.0e}") }),
        cell(v.and_then(relative).map(f64::sqrt), significant),
        cell(v.and_then(relative).map(|r| (1e4 * r).ceil()), count),
    ]
}

/// A note for each reason why strategies have no variance.
fn reasons(light: &ExactLight) -> Vec<String> {
    let mut strategies: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for variance in &light.strategies {
        if let Some(why) = &variance.why {
            strategies.entry(why).or_default().push(&variance.strategy);
        }
    }
    strategies.into_iter().map(|(why, names)| note(&format!("{}: {why}", names.join(", ")))).collect()
}

fn heading(receiver: &ExactResult) -> String {
    let at = receiver.position.map(short).join(", ");
    let value = match (&receiver.light.irradiance, receiver.light.why.get("irradiance")) {
        (Some(Bounded { luminance, error_bound, .. }), _) => format!("E = {luminance:?} ± {error_bound:.0e}"),
        (None, why) => format!("no exact value: {}", why.map_or("", String::as_str)),
    };
    format!("{} · at ({at}) · {value}", plain(&receiver.name))
}
