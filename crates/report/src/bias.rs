//! Verdicts on bias, one line per strategy over all receivers, with what could have been found.

use std::collections::BTreeMap;

use twoforms_comparison::result::{ReceiverResult, Verdict};

use crate::layout::{layout, note, plain};
use crate::number::{NONE, percent, significant};
use crate::ranking::{estimators, full_name};

const HEADER: [&str; 6] = ["strategy", "unbiased", "undecided", "biased", "detectable, of E", "samples needed"];

/// One estimator's verdicts with their receivers.
struct Judged<'a> {
    name: String,
    verdicts: Vec<(&'a ReceiverResult, &'a Verdict)>,
}

/// How many receivers found each strategy unbiased, undecided or biased, then each bias by name, and why the undecided are so;
/// nothing where there is no verdict.
///
/// `detectable` is the smallest and the largest bias that would be found 80 times in 100, as a share of E; `samples needed`
/// are those after which all of the undecided would be decided.
pub(crate) fn section(receivers: &[ReceiverResult]) -> String {
    let judged = judged(receivers);
    let Some((_, first)) = judged.iter().find_map(|judged| judged.verdicts.first()) else {
        return String::new();
    };
    let title =
        format!("Bias: at familywise level {}, against a margin of {} of E", first.level, percent(first.margin));
    let table = layout(&HEADER, judged.iter().map(row), 1);
    let biases = judged.iter().flat_map(biases);
    [title].into_iter().chain(table).chain(biases).chain(reasons(&judged)).collect::<Vec<_>>().join("\n")
}

fn judged(receivers: &[ReceiverResult]) -> Vec<Judged<'_>> {
    let estimators = estimators(receivers);
    let of = |&(strategy, sampler): &(&str, &str)| {
        let all =
            receivers.iter().flat_map(|receiver| receiver.verdicts.iter().map(move |verdict| (receiver, verdict)));
        let verdicts = all.filter(|(_, verdict)| verdict.strategy == strategy && verdict.sampler == sampler).collect();
        Judged { name: full_name(&estimators, (strategy, sampler)), verdicts }
    };
    estimators.iter().map(of).filter(|judged| !judged.verdicts.is_empty()).collect()
}

fn row(judged: &Judged) -> Vec<String> {
    let count = |name: &str| judged.verdicts.iter().filter(|(_, verdict)| verdict.verdict == name).count().to_string();
    let needed = judged.verdicts.iter().filter_map(|(_, verdict)| verdict.samples_needed).reduce(f64::max);
    vec![
        judged.name.clone(),
        count("unbiased"),
        count("undecided"),
        count("biased"),
        detectable(&judged.verdicts),
        needed.map_or(NONE.into(), significant),
    ]
}

/// `0.12 % to 3.4 %`, over receivers with light.
fn detectable(verdicts: &[(&ReceiverResult, &Verdict)]) -> String {
    let share = |(_, verdict): &(_, &Verdict)| {
        Some(verdict.detectable.filter(|_| verdict.reference > 0.0)? / verdict.reference)
    };
    let (least, most) = verdicts
        .iter()
        .filter_map(share)
        .fold((f64::INFINITY, 0.0_f64), |(lo, hi), share| (lo.min(share), hi.max(share)));
    match (percent(least), percent(most)) {
        _ if least > most => NONE.into(),
        (least, most) if least == most => least,
        (least, most) => format!("{least} to {most}"),
    }
}

/// A line for each bias: where, how large, what of it.
fn biases<'a>(judged: &'a Judged) -> impl Iterator<Item = String> + 'a {
    judged.verdicts.iter().filter(|(_, verdict)| verdict.verdict == "biased").map(|(receiver, verdict)| {
        let [lo, hi] = verdict.interval.unwrap_or([verdict.difference; 2]).map(significant);
        let (name, at, e) = (&judged.name, plain(&receiver.name), significant(verdict.reference));
        format!("  biased: {name} at {at}, by {lo} to {hi} where E = {e}: {}", verdict.note)
    })
}

/// A sentence for each reason why receivers are undecided: which strategies, and where.
fn reasons(judged: &[Judged]) -> Vec<String> {
    let mut places: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for judged in judged {
        let mut receivers: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for (receiver, verdict) in judged.verdicts.iter().filter(|(_, verdict)| verdict.verdict == "undecided") {
            receivers.entry(&verdict.note).or_default().push(&receiver.name);
        }
        for (note, receivers) in receivers {
            places.entry(note).or_default().push(format!("{} at {}", judged.name, named(&receivers)));
        }
    }
    let line = |(why, at): (&str, Vec<String>)| note(&format!("undecided, {why}: {}", at.join(", ")));
    places.into_iter().map(line).collect()
}

/// One by its name, several by their number.
fn named(receivers: &[&str]) -> String {
    match receivers {
        [one] => plain(one),
        _ => format!("{} receivers", receivers.len()),
    }
}
