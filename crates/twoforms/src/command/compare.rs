//! `twoforms compare`: the main job.

use std::time::SystemTime;

use anyhow::{Result, bail};
use twoforms_comparison::experiment::Experiment;
use twoforms_comparison::place::Place;
use twoforms_comparison::places::Stay;
use twoforms_comparison::request::Asked;
use twoforms_comparison::result::{ReceiverResult, Verdict};
use twoforms_comparison::verdict::Criteria;
use twoforms_comparison::world::World;
use twoforms_report::Document;
use twoforms_reproduction::Text;
use twoforms_reproduction::stage::once;

use crate::args::CompareArgs;
use crate::command::experiment;
use crate::output::{self, Destination};
use crate::{progress, run};

/// What is measured where.
pub struct Job {
    /// The scene.
    pub world: World,
    /// Where.
    pub places: Vec<Place>,
    /// How.
    pub experiment: Experiment,
    /// What is asked.
    pub asked: Asked,
    /// Whether a bias is a fault.
    pub check: bool,
    /// The file that says so, with all that was set.
    pub file: Option<Text>,
}

/// Measures, and prints; `said` are the options that the command line names. `Found::Fault` where a check was asked for and an
/// estimator is biased.
pub fn run(args: &CompareArgs, said: &[String]) -> Result<Found> {
    let started = SystemTime::now();
    run::set_threads(&args.run)?;
    let job = if args.is_file() { experiment::job(args, said)? } else { by_options(args)? };
    let Job { world, places, experiment: measured, asked, check, file } = job;
    if let (Some(text), Some(folder)) = (&file, &args.out) {
        experiment::spare(text, &folder.join(output::EXPERIMENT))?;
    }
    let destination =
        Destination::new(args.print.format, args.print.output.as_deref(), args.out.as_deref(), file.as_ref())?;
    check_size(&measured, places.len())?;
    for (sampler, [n, rounded]) in measured.rounded() {
        run::note(&args.run, &format!("{sampler}: N = {n} becomes {rounded}"));
    }
    let total = measured.samples_per_receiver().saturating_mul(places.len() as u64);
    let bar = progress::bar(total, "samples", &args.run);
    let results = measured.run(&world, &places, &|drawn| bar.inc(drawn))?;
    bar.finish_and_clear();
    let provenance = run::provenance(&world.scene, measured.seed, started)
        .with("replicates", u64::from(measured.replicates))
        .with("quantity", asked.name());
    let biases = if check { biases(&results) } else { Vec::new() };
    destination.write(&Document::new(provenance, results)?)?;
    for bias in &biases {
        output::say(bias);
    }
    Ok(if biases.is_empty() { Found::Nothing } else { Found::Fault })
}

/// The job that the command line's options describe.
fn by_options(args: &CompareArgs) -> Result<Job> {
    if let Some(setting) = args.set.first() {
        bail!("-D {setting} sets a field of an experiment's file, and {} is none", args.scene.display());
    }
    let world = run::load(&args.scene, &args.run)?;
    let places = run::places(&world, &args.places, &args.run, Stay::Put)?;
    let experiment = Experiment {
        strategies: args.strategies.0.clone(),
        samplers: args.sampler.0.clone(),
        samples: once(&args.samples),
        replicates: args.replicates,
        seed: args.run.seed(),
        criteria: Criteria { level: args.criteria.level, margin: args.criteria.margin },
    };
    let asked = args.places.quantity.into();
    Ok(Job { world, places, experiment, asked, check: args.criteria.check, file: None })
}

/// A line for every estimator that is found to be biased.
fn biases(results: &[ReceiverResult]) -> Vec<String> {
    let of_receiver = |receiver: &ReceiverResult| {
        let biased = receiver.verdicts.iter().filter(|verdict| verdict.verdict == "biased");
        let line = |v: &Verdict| {
            format!("biased: {} ({}) at {} by {:.3e}: {}", v.strategy, v.sampler, receiver.name, v.difference, v.note)
        };
        biased.map(line).collect::<Vec<_>>()
    };
    results.iter().flat_map(of_receiver).collect()
}

/// What a check found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// No check was asked for, or nothing is wrong.
    Nothing,
    /// An estimator is biased, or a result differs from what it should be.
    Fault,
}

/// Estimates that are kept until their variance is known, at eight bytes each: 4 GB.
const MOST_ESTIMATES: u64 = 500_000_000;

/// Refuses what memory would not hold, before it is begun.
fn check_size(experiment: &Experiment, places: usize) -> Result<()> {
    let rows = experiment.strategies.len() * experiment.samplers.len() * experiment.samples.len();
    let kept = (rows * places) as u64;
    let most = MOST_ESTIMATES / kept;
    if u64::from(experiment.replicates) > most {
        bail!(
            "{} replicates of {kept} estimates are more than can be held at once: ask for at most {most} replicates",
            experiment.replicates
        );
    }
    Ok(())
}
