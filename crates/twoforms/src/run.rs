//! What commands that compute have in common: the scene, threads, and the record of where results come from.

use std::path::Path;
use std::time::SystemTime;

use anyhow::{Context, Result};
use twoforms_comparison::place::Place;
use twoforms_comparison::places::{self, Stay};
use twoforms_comparison::world::World;
use twoforms_report::Provenance;
use twoforms_report::provenance::{platform, rfc3339_utc};
use twoforms_scene::Scene;

use crate::args::{PlacesArgs, RunArgs};
use crate::output;

/// Loads a scene with at least one light, and says on standard error what was read otherwise than the file means it.
pub fn load(path: &Path, run: &RunArgs) -> Result<World> {
    let scene = Scene::load(path)?;
    for warning in &scene.warnings {
        note(run, &format!("warning: {warning}"));
    }
    let world = World::new(scene)?;
    detail(run, &format!("{}: {}", path.display(), world.summary()));
    Ok(world)
}

/// The places that the command line asks for, never none.
pub fn places(world: &World, args: &PlacesArgs, run: &RunArgs, stay: Stay) -> Result<Vec<Place>> {
    let request = args.request().map_err(anyhow::Error::msg)?;
    Ok(places::places(world, &request, stay, &|line| note(run, line))?)
}

/// Says a line on standard error, unless that is to be quiet.
pub fn note(run: &RunArgs, line: &str) {
    if !run.quiet {
        output::say(line);
    }
}

/// Says a line on standard error, where more is to be said.
pub fn detail(run: &RunArgs, line: &str) {
    if run.verbose > 0 {
        output::say(line);
    }
}

/// Sets the number of threads, once, before anything runs on them.
pub fn set_threads(run: &RunArgs) -> Result<()> {
    let threads = run.threads.map_or(0, usize::from);
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().context("the threads could not be started")
}

/// Where the results of this run come from.
pub fn provenance(scene: &Scene, seed: u64, started: SystemTime) -> Provenance {
    Provenance {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        command: std::env::args_os().map(|word| quoted(&word.to_string_lossy())).collect::<Vec<_>>().join(" "),
        seed: seed.to_string(),
        scene: scene.path.display().to_string(),
        scene_sha256: scene.sha256.clone(),
        threads: rayon::current_num_threads(),
        started: rfc3339_utc(started),
        platform: platform(),
        settings: std::collections::BTreeMap::default(),
    }
}

/// A word as a shell would need it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./,:=@+%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}
