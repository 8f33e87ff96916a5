//! Receivers: the points at which a scene asks for the light, and the answers that it knows.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;
use serde_json::Value;

use crate::document::Document;
use crate::error::{Problem, malformed};
use crate::hierarchy::Placed;
use crate::transform::carry_normal;
use crate::warnings::Warnings;

/// A named point x with its normal.
#[derive(Clone, Debug, PartialEq)]
pub struct Receiver {
    /// Name of the node.
    pub name: String,
    /// World position in metres: the node's origin.
    pub position: DVec3,
    /// World unit normal: the node's +Y axis, carried by the inverse transpose.
    pub normal: DVec3,
    /// The answer that the scene carries.
    pub known: Option<KnownAnswer>,
}

/// An answer from outside: a closed form or a cited value.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownAnswer {
    /// Irradiance (linear RGB), in the unit of radiance times steradian.
    pub irradiance: [f64; 3],
    /// Variance of one sample (linear RGB, each channel by itself), by strategy name.
    pub variance: BTreeMap<String, [f64; 3]>,
    /// Where the values come from; empty where the scene does not say.
    pub derivation: String,
}

/// The receivers in scene order: nodes whose extras say `"receiver": true` or whose name begins with "receiver".
pub(crate) fn read(
    document: &Document<'_>,
    placed: &[Placed],
    warnings: &mut Warnings,
) -> Result<Vec<Receiver>, Problem> {
    let (mut receivers, mut names) = (Vec::new(), BTreeSet::new());
    for placed in placed {
        let name = document.node_name(placed.node);
        let extras = extras(document, placed.node, &name)?;
        if !is_receiver(&extras, &name)? {
            continue;
        }
        if !names.insert(name.clone()) {
            warnings.at("several receivers have one name", &name);
        }
        receivers.push(place(name, placed, &extras)?);
    }
    Ok(receivers)
}

fn extras(document: &Document<'_>, node: usize, name: &str) -> Result<Value, Problem> {
    match &document.root.nodes[node].extras {
        Some(extras) => {
            serde_json::from_str(extras.get()).map_err(|error| fault(name, &format!("cannot be read ({error})")))
        }
        None => Ok(Value::Null),
    }
}

fn is_receiver(extras: &Value, name: &str) -> Result<bool, Problem> {
    match extras.get("receiver") {
        None => Ok(name.starts_with("receiver")),
        Some(Value::Bool(receiver)) => Ok(*receiver || name.starts_with("receiver")),
        Some(_) => Err(fault(name, "have a \"receiver\" that is neither true nor false")),
    }
}

fn place(name: String, placed: &Placed, extras: &Value) -> Result<Receiver, Problem> {
    let known = known(extras).map_err(|what| fault(&name, what))?;
    let normal = carry_normal(&placed.world.matrix3, DVec3::Y)
        .ok_or_else(|| malformed(format!("receiver {name:?}"), "has a transform that leaves it no normal"))?;
    Ok(Receiver { name, position: placed.world.translation, normal, known })
}

/// The answer in the extras of a receiver, or what is wrong with it.
fn known(extras: &Value) -> Result<Option<KnownAnswer>, &'static str> {
    let variance = variance(extras.get("variance"))?;
    let derivation = match extras.get("derivation") {
        None => "",
        Some(text) => text.as_str().ok_or("have a \"derivation\" that is no text")?,
    };
    match extras.get("irradiance") {
        None if variance.is_empty() => Ok(None),
        None => Err("have a \"variance\" but no \"irradiance\""),
        Some(value) => {
            let irradiance = rgb(value).ok_or("have an \"irradiance\" that is not three numbers >= 0")?;
            Ok(Some(KnownAnswer { irradiance, variance, derivation: derivation.into() }))
        }
    }
}

fn variance(value: Option<&Value>) -> Result<BTreeMap<String, [f64; 3]>, &'static str> {
    let fault = "have a \"variance\" that does not give strategies three numbers >= 0 each";
    let Some(value) = value else {
        return Ok(BTreeMap::new());
    };
    let rows = value.as_object().ok_or(fault)?.iter();
    rows.map(|(strategy, value)| Ok((strategy.clone(), rgb(value).ok_or(fault)?))).collect()
}

fn rgb(value: &Value) -> Option<[f64; 3]> {
    let numbers: Vec<f64> = value.as_array()?.iter().map(Value::as_f64).collect::<Option<_>>()?;
    numbers.try_into().ok().filter(|rgb: &[f64; 3]| rgb.iter().all(|&channel| channel >= 0.0))
}

fn fault(name: &str, fault: &str) -> Problem {
    malformed(format!("node {name:?}"), format!("has extras that {fault}"))
}
