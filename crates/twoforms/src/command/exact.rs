//! `twoforms exact`: irradiance and variances without chance.

use std::time::SystemTime;

use anyhow::Result;
use twoforms_comparison::exactly::exactly;
use twoforms_comparison::exactly::with_formula;
use twoforms_comparison::places::Stay;
use twoforms_comparison::request::Asked;
use twoforms_comparison::swept::{default_strategies, swept};
use twoforms_report::ExactDocument;

use crate::args::ExactArgs;
use crate::output::Destination;
use crate::{progress, run};

/// Works out, and prints.
pub fn run(args: &ExactArgs) -> Result<()> {
    let started = SystemTime::now();
    run::set_threads(&args.run)?;
    let world = run::load(&args.scene, &args.run)?;
    let stay = if args.sweep.is_some() { Stay::Moving } else { Stay::Put };
    let places = run::places(&world, &args.places, &args.run, stay)?;
    let destination = Destination::new(args.print.format, args.print.output.as_deref(), args.out.as_deref(), None)?;
    let strategies = args.strategies.as_ref().map(|list| list.0.clone());
    let steps = args.sweep.map_or(1, |sweep| sweep.steps());
    let bar = progress::bar(places.len() as u64 * u64::from(steps), "receivers", &args.run);
    let progress = |done| bar.inc(done);
    let results = match &args.sweep {
        None => exactly(&world, &places, &strategies.unwrap_or_else(with_formula), &progress),
        Some(sweep) => swept(&world, &places, &strategies.unwrap_or_else(default_strategies), sweep, &progress),
    };
    bar.finish_and_clear();
    let quantity = Asked::from(args.places.quantity).name();
    let provenance = run::provenance(&world.scene, args.run.seed(), started).with("quantity", quantity);
    Ok(destination.write(&ExactDocument::new(provenance, results)?)?)
}
