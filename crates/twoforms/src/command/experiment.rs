//! `twoforms compare FILE.toml`: an experiment in a file, as the options that it stands for.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use glam::DVec3;
use twoforms_estimator::sampler::Sampler;
use twoforms_report::file;
use twoforms_reproduction::schema::Experiment;
use twoforms_reproduction::{Text, stage};

use super::compare::Found;
use crate::args::{At, CompareArgs, PlacesArgs, PrintArgs, ReceiverArgs, RunArgs, SamplerList, StrategyList};

/// The text of a file of experiments, with fields set from outside.
pub fn text(path: &Path, settings: &[String]) -> Result<Text> {
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path).with_context(|| format!("{name} cannot be read"))?;
    let folder = path.parent().map(Path::to_path_buf);
    Ok(Text { name, folder, text }.with(settings)?)
}

/// Runs the file's only experiment by `compare`, and writes the file with all that was set beside the results. How to run and to
/// print is said on the command line.
pub fn run(args: &CompareArgs, compare: impl FnOnce(&CompareArgs) -> Result<Found>) -> Result<Found> {
    let (options, text) = read(args)?;
    let resolved = args.out.as_ref().map(|folder| folder.join("experiment.toml"));
    if let Some(path) = &resolved {
        file::make_folder(path.parent().unwrap_or(path))?;
        file::check(path)?;
    }
    let found = compare(&options)?;
    if let Some(path) = &resolved {
        file::save(path, |out| Ok(out.write_all(text.text.as_bytes())?))?;
    }
    Ok(found)
}

/// The options of `compare` that the file's only experiment stands for, and the file.
fn read(args: &CompareArgs) -> Result<(CompareArgs, Text)> {
    refuse_options(args)?;
    let text = text(&args.scene, &args.set)?;
    let file = text.parse()?;
    let [spanned] = &file.experiment[..] else {
        bail!(
            "{} has {} experiments, and compare runs one: use reproduce for several, or none",
            text.name,
            file.experiment.len()
        );
    };
    let experiment = spanned.get_ref();
    let Some(scene) = &experiment.scene else {
        return Err(text
            .error(spanned.span(), "compare needs a scene; variables and integrals are for reproduce")
            .into());
    };
    let path = text.folder.clone().unwrap_or_default().join(scene.get_ref());
    if !path.exists() {
        let message = format!("there is no scene {} (paths are relative to the file)", path.display());
        return Err(text.error(scene.span(), &message).into());
    }
    let options = options(experiment, &text, path, args)?;
    let seed = if args.run.seed == 0 { file.seed } else { args.run.seed };
    Ok((CompareArgs { run: RunArgs { seed, ..args.run.clone() }, ..options }, text))
}

/// What the file says cannot be said on the command line as well.
fn refuse_options(args: &CompareArgs) -> Result<()> {
    let said = [
        ("strategies", args.strategies != StrategyList::default()),
        ("samplers", args.sampler != SamplerList(vec![Sampler::Independent])),
        ("samples", args.samples != DEFAULT_SAMPLES),
        ("replicates", args.replicates != DEFAULT_REPLICATES),
        ("receivers", args.places.receivers != ReceiverArgs::default()),
    ];
    match said.into_iter().find(|(_, said)| *said) {
        Some((key, _)) => bail!("{} says its {key}: set them with -D {key}=…", args.scene.display()),
        None => Ok(()),
    }
}

/// N where nothing is said.
const DEFAULT_SAMPLES: [u32; 6] = [1, 4, 16, 64, 256, 1024];
/// R where nothing is said.
const DEFAULT_REPLICATES: u32 = 1000;

fn options(experiment: &Experiment, text: &Text, scene: PathBuf, args: &CompareArgs) -> Result<CompareArgs> {
    let strategies = match &experiment.strategies {
        None => StrategyList::default(),
        Some(names) => StrategyList(names.iter().map(|name| stage::strategy(name, text)).collect::<Result<_, _>>()?),
    };
    let at = experiment.at.iter().flatten().map(|&[x, y, z, nx, ny, nz]| {
        let normal = DVec3::new(nx, ny, nz).try_normalize().context("a normal under at has no length")?;
        Ok(At::Point(DVec3::new(x, y, z), normal))
    });
    let named = experiment.receivers.iter().flatten().map(|name| name.get_ref().clone());
    let receivers =
        ReceiverArgs { at: at.collect::<Result<_>>()?, receiver: named.collect(), ..ReceiverArgs::default() };
    let places = PlacesArgs { receivers, ..args.places.clone() };
    Ok(CompareArgs {
        scene,
        set: Vec::new(),
        strategies,
        sampler: SamplerList(stage::samplers(experiment, text)?),
        samples: experiment.samples.clone().unwrap_or_else(|| DEFAULT_SAMPLES.into()),
        replicates: experiment.replicates.as_ref().map_or(DEFAULT_REPLICATES, |replicates| *replicates.get_ref()),
        places,
        criteria: args.criteria.clone(),
        run: args.run.clone(),
        print: PrintArgs { format: args.print.format, output: args.print.output.clone() },
        out: args.out.clone(),
    })
}
