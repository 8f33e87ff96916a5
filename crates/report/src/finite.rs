//! No NaN, no infinity: JSON has no word for them and would write `null`.

use ciborium::Value;
use serde::Serialize;

use crate::error::ReportError;

/// Checks every number that `record` serialises.
///
/// # Errors
/// [`ReportError::NotFinite`] with the path of the first number that is not finite, below `name`.
pub(crate) fn check(name: &str, record: &impl Serialize) -> Result<(), ReportError> {
    // CBOR keeps what JSON would lose: NaN and missing stay two things.
    let tree = Value::serialized(record)
        .map_err(|cause| ReportError::Stream { cause: std::io::Error::new(std::io::ErrorKind::InvalidData, cause) })?;
    match first_not_finite(&tree) {
        Some((path, value)) => Err(ReportError::NotFinite { place: format!("{name}{path}"), value }),
        None => Ok(()),
    }
}

/// The first number in `tree` that is not finite, with its path below `tree`.
fn first_not_finite(tree: &Value) -> Option<(String, f64)> {
    match tree {
        Value::Float(value) if !value.is_finite() => Some((String::new(), *value)),
        Value::Array(items) => items.iter().enumerate().find_map(|(i, item)| below(&format!("[{i}]"), item)),
        Value::Map(fields) => fields.iter().find_map(|(key, field)| below(&format!(".{}", key.as_text()?), field)),
        _ => None,
    }
}

fn below(step: &str, tree: &Value) -> Option<(String, f64)> {
    first_not_finite(tree).map(|(path, value)| (format!("{step}{path}"), value))
}
