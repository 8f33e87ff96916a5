//! Exact light along a sweep, for people.

use twoforms_comparison::exactly::ExactResult;
use twoforms_comparison::sweep::Spacing;
use twoforms_comparison::swept::{Crossing, Step, Swept};

use crate::layout::{layout, plain, wrapped};
use crate::number::{NONE, rounded, short, significant};

/// Most strategies whose variances stand side by side.
const MOST_COLUMNS: usize = 8;

/// A block for one receiver: E and each strategy's variance of one sample at every step, then the crossings. Where there are
/// too many strategies for columns, the crossings alone.
pub(crate) fn text(receiver: &ExactResult, sweep: &Swept) -> String {
    let strategies = names(sweep);
    let steps = if strategies.len() <= MOST_COLUMNS {
        table(sweep, &strategies)
    } else {
        let many = strategies.len();
        vec![wrapped(&format!("  The variances of {many} strategies are too many columns: see --format csv or json."))]
    };
    let missing = missing(sweep).map(|note| wrapped(&format!("  {note}")));
    let gap = vec![String::new()];
    [vec![heading(receiver, sweep)], steps, missing.into_iter().collect(), gap, crossings(sweep)].concat().join("\n")
}

fn heading(receiver: &ExactResult, sweep: &Swept) -> String {
    let at = receiver.position.map(short).join(", ");
    let Swept { from, to, steps, scale, .. } = sweep;
    let spacing = if *scale == Spacing::Log { " of equal ratio" } else { "" };
    let count = steps.len();
    format!(
        "{} · at ({at}) · {} from {from} to {to} in {count} steps{spacing}",
        plain(&receiver.name),
        sweep.parameter.name()
    )
}

/// The strategies, as the first step with a value names them.
fn names(sweep: &Swept) -> Vec<&str> {
    let named = sweep.steps.iter().find(|step| !step.light.strategies.is_empty());
    named.map_or(Vec::new(), |step| step.light.strategies.iter().map(|v| v.strategy.as_str()).collect())
}

fn table(sweep: &Swept, strategies: &[&str]) -> Vec<String> {
    let broken = strategies.iter().map(|name| name.replacen('/', "/\n", 1));
    let header: Vec<String> = [sweep.parameter.name(), "E"].map(str::to_owned).into_iter().chain(broken).collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    layout(&header, sweep.steps.iter().map(|step| cells(step, strategies.len())), 0)
}

fn cells(step: &Step, strategies: usize) -> Vec<String> {
    let cell = |value: Option<f64>| value.map_or(NONE.to_owned(), significant);
    let variance = |k: usize| step.light.strategies.get(k)?.variance_of_one.map(|v| v.luminance);
    let figures = (0..strategies).map(variance).map(cell);
    let first = [rounded(step.at, 6), cell(step.light.irradiance.map(|e| e.luminance))];
    first.into_iter().chain(figures).collect()
}

/// How many steps have no value, and why the first has none.
fn missing(sweep: &Swept) -> Option<String> {
    let mut reasons = sweep.steps.iter().filter_map(|step| Some((step.at, step.light.why.get("irradiance")?)));
    let (at, why) = reasons.next()?;
    let count = 1 + reasons.count();
    let steps = sweep.steps.len();
    Some(format!("{count} of {steps} steps have no exact value, first at {}: {why}.", rounded(at, 6)))
}

fn crossings(sweep: &Swept) -> Vec<String> {
    if sweep.crossings.is_empty() {
        return vec!["  no crossings: between these steps no two variances become equal".to_owned()];
    }
    let cells = |crossing: &Crossing| {
        let [a, b] = &crossing.strategies;
        vec![format!("{a} = {b}"), rounded(crossing.at, 10), format!("± {:.0e}", crossing.error_bound)]
    };
    layout(&["equal variances", sweep.parameter.name(), "at most"], sweep.crossings.iter().map(cells), 1)
}

/// What the crossings of every sweep leave open.
pub(crate) const NOTE: &str = "Of crossings that lie closer together than the steps, some may be missed.";
