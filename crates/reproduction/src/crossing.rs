//! Where two integrals' estimators have equal variance, as a constant in them moves.

use toml::Spanned;

use crate::outcome::Finding;
use crate::reading::{Error, Text};
use crate::schema::{Expected, Experiment};
use crate::variable::Subject;

/// Halvings of the range: to the last digits of binary64.
const HALVINGS: u32 = 52;
/// How far the root may be off, relatively: exact variances are good to some 10⁻¹⁰.
const ACCURACY: f64 = 1e-8;

/// The value of the row's parameter between its ends at which the exact variances of the experiment's integral and of the row's
/// other one are equal.
///
/// # Errors
/// Where the row does not say against what, or the variances do not cross between the ends.
pub fn find(experiment: &Experiment, row: &Expected, text: &Text, at: &Spanned<Experiment>) -> Result<Finding, Error> {
    let wrong = |message: &str| text.error(row.quantity.span(), message);
    let against = row.against.as_ref().ok_or_else(|| wrong("it needs against = { integrand = \"…\" }"))?;
    let parameter = row.parameter.as_ref().ok_or_else(|| wrong("it needs parameter = { name, from, to }"))?;
    let other = Experiment {
        integrand: Some(against.integrand.clone()),
        density: against.density.clone(),
        ..experiment.clone()
    };
    let variance = |of: &Experiment, value: f64| {
        let mut moved = of.clone();
        moved.constants.insert(parameter.name.clone(), value);
        let subject = Subject::new(&moved, text, at.span())?.ok_or_else(|| wrong("integrals cross"))?;
        subject.exact().map(|exact| exact.variance).map_err(|error| wrong(&error.to_string()))
    };
    let difference = |value: f64| Ok::<f64, Error>(variance(experiment, value)? - variance(&other, value)?);
    let (mut low, mut high) = (parameter.from, parameter.to);
    let rising = difference(low)? < 0.0;
    if rising == (difference(high)? < 0.0) {
        return Err(wrong("the variances do not cross between from and to"));
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if rising == (difference(middle)? < 0.0) { low = middle } else { high = middle }
    }
    Ok(Finding { exact: Some([low, ACCURACY * low.abs()]), ..Finding::default() })
}
