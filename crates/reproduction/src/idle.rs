//! Keys that a file may have, where they mean nothing: refused, so that nobody takes them for heard.

use toml::de::DeTable;

use crate::reading::{Error, Text};
use crate::schema::{Expected, Experiment, File, Quantity};
use crate::toolkit::word;

/// Keys of an experiment that an integrand alone has a use for.
const OF_INTEGRANDS: [&str; 4] = ["axes", "domain", "density", "dimensions"];
/// Those that a scene alone has a use for.
const OF_SCENES: [&str; 18] = [
    "receivers",
    "at",
    "pixels",
    "grid",
    "quantity",
    "albedo",
    "lambert",
    "camera",
    "view",
    "width",
    "height",
    "strategies",
    "sweep",
    "nested",
    "level",
    "margin",
    "check",
    "chance",
];
/// Keys of a row that a scene alone has a use for.
const OF_ROWS_IN_SCENES: [&str; 5] = ["receiver", "strategy", "to", "sampler", "which"];
/// Keys of a row that an integrand alone has a use for.
const OF_ROWS_ELSEWHERE: [&str; 2] = ["against", "parameter"];
/// Keys of a row, and the quantities that depend on them.
const OF_QUANTITIES: [(&str, &[Quantity]); 9] = [
    ("samples", &[Quantity::VarianceOfMean, Quantity::DeviationOfMean, Quantity::Outside]),
    ("delta", &[Quantity::Outside]),
    ("interval", &[Quantity::Probability, Quantity::Drawn]),
    ("points", &[Quantity::RunningMean]),
    ("rule", &[Quantity::Rule, Quantity::CrossingDimension]),
    ("nodes", &[Quantity::Rule, Quantity::CrossingDimension]),
    ("to", &[Quantity::Ratio, Quantity::Crossing, Quantity::Crossings]),
    ("which", &[Quantity::Crossing]),
    ("parameter", &[Quantity::Crossing]),
];

/// Refuses the first key that means nothing beside the rest of its experiment or row.
///
/// # Errors
/// Where there is one, with the reason.
pub fn refuse(file: &File, text: &Text) -> Result<(), Error> {
    // What is no TOML at all has been told when the file was read.
    let Ok(whole) = DeTable::parse(&text.text) else { return Ok(()) };
    let experiments = file.experiment.iter().zip(tables(whole.get_ref(), "experiment"));
    experiments.into_iter().try_for_each(|(experiment, table)| of_experiment(experiment.get_ref(), table, text))
}

fn of_experiment(experiment: &Experiment, table: &DeTable, text: &Text) -> Result<(), Error> {
    if experiment.integrand.is_none() {
        none_of(&OF_INTEGRANDS, table, text, "is for an integrand, and the experiment has none")?;
    }
    if experiment.scene.is_none() {
        none_of(&OF_SCENES, table, text, NO_SCENE)?;
    }
    let mut rows = experiment.row.iter().zip(tables(table, "row"));
    rows.try_for_each(|(row, table)| of_row(row, experiment, table, text))
}

const NO_SCENE: &str = "is for a scene, and the experiment has none";

fn of_row(row: &Expected, experiment: &Experiment, table: &DeTable, text: &Text) -> Result<(), Error> {
    match experiment.scene {
        None => none_of(&OF_ROWS_IN_SCENES, table, text, NO_SCENE)?,
        Some(_) => none_of(&OF_ROWS_ELSEWHERE, table, text, "is for an integrand, and the experiment has a scene")?,
    }
    let quantity = *row.quantity.get_ref();
    for (key, _) in OF_QUANTITIES.iter().filter(|(_, of)| !of.contains(&quantity)) {
        none_of(&[key], table, text, &format!("means nothing to the quantity \"{}\"", word(quantity)))?;
    }
    if row.published.is_none() {
        none_of(&["truncated", "published-error"], table, text, "is of a published number, and the row has none")?;
    }
    if row.derived.is_none() {
        none_of(&["derived-error"], table, text, "is of a derived number, and the row has none")?;
    }
    Ok(())
}

/// An error at a key of the table that is one of these.
fn none_of(keys: &[&str], table: &DeTable, text: &Text, why: &str) -> Result<(), Error> {
    match table.keys().find(|key| keys.contains(&key.get_ref().as_ref())) {
        None => Ok(()),
        Some(key) => Err(text.error(key.span(), &format!("\"{}\" {why}", key.get_ref()))),
    }
}

/// The tables of an array, in order.
fn tables<'t, 'i>(table: &'t DeTable<'i>, name: &str) -> impl Iterator<Item = &'t DeTable<'i>> {
    let named = table.iter().find(|(key, _)| key.get_ref() == name);
    let array = named.and_then(|(_, value)| value.get_ref().as_array());
    array.into_iter().flat_map(|array| array.iter()).filter_map(|value| value.get_ref().as_table())
}
