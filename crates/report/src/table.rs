//! Tables for people, some 100 columns wide, that end with the sentence to remember.

use twoforms_comparison::result::{ReceiverResult, Row};

use crate::cells::{HEADER, named_once};
use crate::document::Document;
use crate::layout::{fitting, layout, plain, wrapped};
use crate::number::{short, significant};
use crate::{bias, rates, summary};

/// Up to so many receivers, [`Detail::for_receivers`] shows every row.
pub const RECEIVERS_IN_FULL: usize = 12;

const LEGEND: &str = "\
mean, variance: luminance of an N-sample estimate · exact: its variance without chance, or the scene's own answer
ratio: variance over exact with its 95 % interval; ± that of the variance itself, where there is no exact one
outside: replicates beyond Chebyshev's σ/√δ, at most δ of all · rays, CPU time: per estimate";

/// How much a table shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// For every receiver a block with its own header, a line for every strategy, sampler and N.
    EveryRow,
    /// One table, a line for every receiver, strategy and sampler, at its largest N.
    LargestCount,
}

impl Detail {
    /// Every row for up to [`RECEIVERS_IN_FULL`] receivers, else the largest N alone.
    pub fn for_receivers(count: usize) -> Self {
        if count <= RECEIVERS_IN_FULL { Self::EveryRow } else { Self::LargestCount }
    }
}

/// The tables of `document`, then the rates of convergence, the verdicts, and [`summary::sentence`]; lines end with `\n`.
///
/// Four significant digits; `exact` is the variance without chance, or the scene's own answer; `ratio` the measured one
/// over it with its 95 % interval, and where there is no exact one the longer arm of the variance's own interval, as a
/// share of the variance (`± 4.0 %`); `–` stands for no value.
pub fn text(document: &Document, detail: Detail) -> String {
    let receivers = document.receivers();
    let tables = tables(receivers, detail);
    let sentence = wrapped(&summary::sentence(document));
    let sections = [title(document), tables, rates_section(receivers), bias::section(receivers), sentence];
    sections.into_iter().filter(|section| !section.is_empty()).collect::<Vec<_>>().join("\n\n") + "\n"
}

/// Scene, receivers, replicates and seed, then what the columns mean.
fn title(document: &Document) -> String {
    let (provenance, receivers) = (document.provenance(), document.receivers());
    let mut replicates: Vec<u64> = receivers.iter().flat_map(|r| &r.rows).map(|row| row.replicates).collect();
    replicates.dedup();
    let replicates = match replicates[..] {
        [1] => " · 1 replicate".to_owned(),
        [many] => format!(" · {many} replicates"),
        _ => String::new(),
    };
    let plural = if receivers.len() == 1 { "" } else { "s" };
    let (scene, seed) = (plain(&provenance.scene), &provenance.seed);
    format!("{scene} · {} receiver{plural}{replicates} · seed {seed}\n{LEGEND}", receivers.len())
}

/// A block of rows for each receiver. One table lays out all of them, so that the blocks' columns line up.
fn tables(receivers: &[ReceiverResult], detail: Detail) -> String {
    let shown = receivers.iter().map(|receiver| (receiver, shown_rows(receiver, detail)));
    let shown: Vec<(&ReceiverResult, Vec<&Row>)> = shown.collect();
    let cells = |longest| shown.iter().flat_map(move |(receiver, rows)| named_once(receiver, rows, longest));
    let names = receivers.iter().flat_map(|receiver| &receiver.rows).map(|row| row.strategy.chars().count());
    let lines = fitting(names.max().unwrap_or(0), |longest| layout(&HEADER, cells(longest), 2));
    let (header, mut rest) = lines.split_at(lines.len().min(2));
    let header = header.join("\n");
    let blocks = shown.iter().map(|(receiver, rows)| {
        let (rows, after) = rest.split_at(rows.len());
        rest = after;
        match detail {
            Detail::EveryRow => format!("{}\n{header}\n{}", heading(receiver), rows.join("\n")),
            Detail::LargestCount => format!("{}\n{}", plain(&receiver.name), rows.join("\n")),
        }
    });
    let blocks: Vec<String> = blocks.collect();
    match detail {
        Detail::EveryRow => blocks.join("\n\n"),
        Detail::LargestCount => format!("{header}\n{}", blocks.join("\n")),
    }
}

fn shown_rows(receiver: &ReceiverResult, detail: Detail) -> Vec<&Row> {
    match detail {
        Detail::EveryRow => receiver.rows.iter().collect(),
        Detail::LargestCount => at_largest_count(receiver),
    }
}

fn rates_section(receivers: &[ReceiverResult]) -> String {
    let rows = rates::rows(receivers);
    if rows.is_empty() {
        return String::new();
    }
    let lines = layout(&rates::HEADER, rows.into_iter().map(Vec::from), 1);
    format!("Rates: slope of log variance against log N (-1 for independent samples)\n{}", lines.join("\n"))
}

/// Name, place and the values that are known without sampling.
fn heading(receiver: &ReceiverResult) -> String {
    let triple = |values: [f64; 3]| format!("({})", values.map(short).join(", "));
    let known = receiver.known.as_ref().map(|known| format!(" · known {}", significant(known.irradiance.luminance)));
    let exact = receiver
        .exact
        .map(|exact| format!(" · exact {} ± {:.0e}", significant(exact.irradiance.luminance), exact.error_bound));
    let (name, at, normal) = (plain(&receiver.name), triple(receiver.position), triple(receiver.normal));
    format!("{name} · at {at} · normal {normal}{}{}", known.unwrap_or_default(), exact.unwrap_or_default())
}

/// Each strategy's and sampler's row with the largest N.
fn at_largest_count(receiver: &ReceiverResult) -> Vec<&Row> {
    let is_largest = |row: &&Row| {
        let same = |other: &&Row| other.strategy == row.strategy && other.sampler == row.sampler;
        receiver.rows.iter().filter(same).all(|other| other.samples <= row.samples)
    };
    receiver.rows.iter().filter(is_largest).collect()
}
