//! A comparison, whole: its results, where they come from, and the hash that tells two of them apart.

use serde::Serialize;
use serde_json::Value;
use twoforms_comparison::result::ReceiverResult;

use crate::error::ReportError;
use crate::finite;
use crate::provenance::{Provenance, sha256_hex};

/// Name and version of the format; a breaking change raises the number.
pub const SCHEMA: &str = "twoforms.compare/1";

/// Keys whose values are timings, which differ from run to run.
const TIMINGS: [&str; 3] = ["setup_seconds", "seconds", "efficiency"];

/// The result of one comparison, in the format [`SCHEMA`]. All its numbers are finite.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Document {
    schema: &'static str,
    results_sha256: String,
    provenance: Provenance,
    receivers: Vec<ReceiverResult>,
}

impl Document {
    /// Joins results and provenance.
    ///
    /// # Errors
    /// [`ReportError::NotFinite`] where a number is NaN or infinite.
    pub fn new(provenance: Provenance, receivers: Vec<ReceiverResult>) -> Result<Self, ReportError> {
        finite::check("receivers", &receivers)?;
        let results_sha256 = results_sha256(&receivers)?;
        Ok(Self { schema: SCHEMA, results_sha256, provenance, receivers })
    }

    /// SHA-256, in hexadecimal, of all results but timings and provenance: equal results give equal hashes.
    ///
    /// What is hashed is the compact JSON text of `receivers`, in the order of its fields, without the keys
    /// `setup_seconds`, `seconds` and `efficiency` at any depth, and without a `why` that is empty after that.
    pub fn results_sha256(&self) -> &str {
        &self.results_sha256
    }

    /// Where the results come from.
    pub fn provenance(&self) -> &Provenance {
        &self.provenance
    }

    /// One record per receiver.
    pub fn receivers(&self) -> &[ReceiverResult] {
        &self.receivers
    }
}

fn results_sha256(receivers: &[ReceiverResult]) -> Result<String, ReportError> {
    let mut results = serde_json::to_value(receivers).map_err(std::io::Error::from)?;
    drop_timings(&mut results);
    Ok(sha256_hex(results.to_string().as_bytes()))
}

fn drop_timings(value: &mut Value) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(drop_timings),
        Value::Object(fields) => {
            fields.values_mut().for_each(drop_timings);
            fields.retain(|key, field| !TIMINGS.contains(&key.as_str()) && (key != "why" || !is_empty(field)));
        }
        _ => {}
    }
}

fn is_empty(value: &Value) -> bool {
    value.as_object().is_some_and(serde_json::Map::is_empty)
}
