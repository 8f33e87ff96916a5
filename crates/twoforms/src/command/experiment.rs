//! `twoforms compare FILE.toml`: an experiment in a file, and the options of how to run it.

use std::path::Path;

use anyhow::{Context, Result, bail};
use twoforms_comparison::experiment::{DEFAULT_REPLICATES, DEFAULT_SAMPLES, Experiment as Comparison};
use twoforms_comparison::verdict::Criteria;
use twoforms_estimator::strategy::Strategy;
use twoforms_reproduction::schema::{Experiment, File};
use twoforms_reproduction::{Text, idle, stage};

use super::compare::Job;
use crate::args::{CompareArgs, RunArgs};
use crate::run;

/// The text of a file of experiments.
pub fn text(path: &Path) -> Result<Text> {
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path).with_context(|| format!("{name} cannot be read"))?;
    let folder = path.parent().map(Path::to_path_buf);
    Ok(Text { name, folder, text })
}

/// Refuses to write over the very file that was read: what is written has fields set that it has not.
pub fn spare(text: &Text, path: &Path) -> Result<()> {
    let [written, read] = [path, Path::new(&text.name)].map(|path| path.canonicalize().ok());
    if text.folder.is_some() && written.is_some() && written == read {
        bail!("--out would write over {}, with what was set: choose another folder", text.name);
    }
    Ok(())
}

/// The text with fields set, the seed of the command line among them.
pub fn with_settings(text: &Text, set: &[String], run: &RunArgs) -> Result<Text> {
    if let Some(seed) = run.seed.filter(|&seed| i64::try_from(seed).is_err()) {
        bail!("--seed {seed} is more than a file of experiments can hold: take at most {}", i64::MAX);
    }
    let seed = run.seed.map(|seed| format!("seed={seed}"));
    Ok(text.with(&[set, seed.as_slice()].concat())?)
}

/// The only experiment of the file, ready to be measured.
pub fn job(args: &CompareArgs, said: &[String]) -> Result<Job> {
    let text = with_settings(&text(&args.scene)?, &args.set, &args.run)?;
    refuse_options(said, &text)?;
    let file = text.parse()?;
    idle::refuse(&file, &text)?;
    let [spanned] = &file.experiment[..] else {
        let count = file.experiment.len();
        bail!("{} has {count} experiments, and compare runs one: use reproduce for several, or none", text.name);
    };
    let experiment = spanned.get_ref();
    let Some(scene) = &experiment.scene else {
        let message = "compare needs a scene; variables and integrals are for reproduce";
        return Err(text.error(spanned.span(), message).into());
    };
    let note = |line: &str| run::note(&args.run, line);
    if let Some(keys) = left_aside(experiment) {
        note(&format!("note: {keys} of {} are for reproduce, and left aside", text.name));
    }
    let detail = |line: &str| run::detail(&args.run, line);
    let world = stage::world(scene, &text, &note, &detail)?;
    let places = stage::places(experiment, &world, &text, &note)?;
    let check = args.criteria.check || experiment.check;
    let asked = experiment.quantity.as_ref().map(|asked| *asked.get_ref()).unwrap_or_default();
    Ok(Job { world, places, experiment: comparison(experiment, &file, &text)?, asked, check, file: Some(text) })
}

/// What the file says cannot be said on the command line as well; how to run and to print is said there.
fn refuse_options(said: &[String], text: &Text) -> Result<()> {
    const HOW: [&str; 10] = ["scene", "set", "seed", "threads", "quiet", "verbose", "check", "format", "output", "out"];
    let Some(option) = said.iter().find(|option| !HOW.contains(&option.as_str())) else { return Ok(()) };
    let key = match option.as_str() {
        "sampler" => "samplers",
        "receiver" => "receivers",
        "pixel" => "pixels",
        other => other,
    };
    bail!("--{option} belongs into {}: set its key {key} there, or with -D {key}=…", text.name)
}

/// Keys that compare has no use for.
fn left_aside(experiment: &Experiment) -> Option<String> {
    let keys = [
        ("rows", !experiment.row.is_empty()),
        ("sweep", experiment.sweep.is_some()),
        ("nested", experiment.nested.is_some()),
        ("figure", experiment.figure.is_some()),
        ("chance", experiment.chance.is_some()),
    ];
    let said: Vec<&str> = keys.into_iter().filter(|(_, said)| *said).map(|(key, _)| key).collect();
    (!said.is_empty()).then(|| said.join(", "))
}

fn comparison(experiment: &Experiment, file: &File, text: &Text) -> Result<Comparison> {
    let Criteria { level, margin } = Criteria::default();
    Ok(Comparison {
        strategies: stage::listed(experiment, text)?.unwrap_or_else(Strategy::defaults),
        samplers: stage::samplers(experiment, text)?,
        samples: stage::once(experiment.samples.as_deref().unwrap_or(&DEFAULT_SAMPLES)),
        replicates: experiment.replicates.unwrap_or(DEFAULT_REPLICATES),
        seed: file.seed,
        criteria: Criteria { level: experiment.level.unwrap_or(level), margin: experiment.margin.unwrap_or(margin) },
    })
}
