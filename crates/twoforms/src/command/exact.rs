//! `twoforms exact`: irradiance and variances without chance.

use std::time::SystemTime;

use anyhow::Result;
use twoforms_comparison::exactly::exactly;
use twoforms_estimator::strategy::Strategy;
use twoforms_report::{ExactDocument, ReportError, file};

use crate::args::{ExactArgs, Format};
use crate::{output, places, progress, run};

/// Works out, and prints.
pub fn run(args: &ExactArgs) -> Result<()> {
    let started = SystemTime::now();
    run::set_threads(&args.run)?;
    let world = run::load(&args.scene, &args.run)?;
    let places = places::places(&world, &args.places, &args.run)?;
    if let Some(path) = &args.output {
        file::check(path)?;
    }
    let strategies = args.strategies.as_ref().map_or_else(Strategy::with_exact_variance, |list| list.0.clone());
    let bar = progress::bar(places.len() as u64, "receivers", &args.run);
    let results = exactly(&world, &places, &strategies, &|done| bar.inc(done));
    bar.finish_and_clear();
    let quantity = args.places.quantity.name();
    let provenance = run::provenance(&world.scene, &args.run, started).with("quantity", quantity);
    let document = ExactDocument::new(provenance, results)?;
    Ok(output::write_to(args.output.as_deref(), |out| print(&document, args.format, out))?)
}

fn print(document: &ExactDocument, format: Format, out: &mut dyn std::io::Write) -> Result<(), ReportError> {
    match format {
        Format::Json => document.write_json(out),
        Format::Csv => document.write_csv(out),
        Format::Table => Ok(out.write_all(document.text().as_bytes())?),
    }
}
