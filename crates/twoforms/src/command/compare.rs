//! `twoforms compare`: the main job.

use std::time::SystemTime;

use anyhow::Result;
use twoforms_comparison::experiment::Experiment;
use twoforms_report::Document;

use crate::args::{CompareArgs, QuantityArg};
use crate::output::Destination;
use crate::{places, progress, run};

/// Measures, and prints.
pub fn run(args: &CompareArgs) -> Result<()> {
    let started = SystemTime::now();
    run::set_threads(&args.run)?;
    let world = run::load(&args.scene, &args.run)?;
    let places = places::places(&world, &args.receivers, &args.camera, args.quantity)?;
    let destination = Destination::new(args.format, args.output.as_deref(), args.out.as_deref())?;
    let experiment = Experiment {
        strategies: args.strategies.0.clone(),
        samplers: args.sampler.0.clone(),
        samples: args.samples.clone(),
        replicates: args.replicates,
        seed: args.run.seed,
    };
    let total = experiment.samples_per_receiver().saturating_mul(places.len() as u64);
    let bar = progress::bar(total, "samples", &args.run);
    let results = experiment.run(&world, &places, &|drawn| bar.inc(drawn))?;
    bar.finish_and_clear();
    let quantity = match args.quantity {
        QuantityArg::Irradiance => "irradiance",
        QuantityArg::Radiance => "radiance",
    };
    let provenance = run::provenance(&world.scene, &args.run, started)
        .with("replicates", u64::from(args.replicates))
        .with("quantity", quantity);
    destination.write(&Document::new(provenance, results)?)
}
