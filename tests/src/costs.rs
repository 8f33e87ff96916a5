//! What estimates cost: CPU time of the work that `twoforms compare` does.

use std::error::Error;
use std::path::Path;

use cpu_time::ProcessTime;
use twoforms_comparison::experiment::Experiment;
use twoforms_comparison::place::Place;
use twoforms_comparison::verdict::Criteria;
use twoforms_comparison::world::World;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_scene::Scene;

/// Everything is measured so many times; the middle one counts.
const ROUNDS: usize = 5;

/// What is measured at each receiver.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The strategies.
    pub strategies: Vec<Strategy>,
    /// N: the sample counts.
    pub samples: Vec<u32>,
    /// Estimates of each.
    pub replicates: u32,
}

/// What an estimate by one strategy costs at one receiver.
#[derive(Clone, Debug)]
pub struct Cost {
    /// The receiver's name.
    pub receiver: String,
    /// The strategy's name.
    pub strategy: String,
    /// N.
    pub samples: u64,
    /// CPU seconds an estimate.
    pub seconds: f64,
}

/// What a scene costs before any sample is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Preparation {
    /// CPU seconds for reading, the hierarchy, views and exact values.
    pub seconds: f64,
    /// The most memory in bytes that this process has held so far, where the system tells.
    pub peak_memory: Option<u64>,
}

impl Asked {
    /// The cost of every estimate asked for, receiver by receiver.
    ///
    /// # Errors
    /// When a strategy has no sampler, or a sample is not finite.
    pub fn costs(&self, world: &World) -> Result<Vec<Cost>, Box<dyn Error>> {
        let rounds = (0..ROUNDS as u64).map(|seed| self.round(world, seed)).collect::<Result<Vec<_>, _>>()?;
        let mut costs = rounds[0].clone();
        for (k, cost) in costs.iter_mut().enumerate() {
            cost.seconds = median(rounds.iter().map(|round| round[k].seconds).collect());
        }
        Ok(costs)
    }

    fn round(&self, world: &World, seed: u64) -> Result<Vec<Cost>, Box<dyn Error>> {
        let experiment = Experiment {
            strategies: self.strategies.clone(),
            samplers: vec![Sampler::Independent],
            samples: self.samples.clone(),
            replicates: self.replicates,
            seed,
            criteria: Criteria::default(),
        };
        let places: Vec<Place> = world.scene.receivers.iter().map(Place::of_receiver).collect();
        let mut costs = Vec::new();
        for result in experiment.run(world, &places, &|_| ())? {
            costs.extend(result.rows.into_iter().map(|row| Cost {
                receiver: result.name.clone(),
                strategy: row.strategy,
                samples: row.samples,
                seconds: row.seconds,
            }));
        }
        Ok(costs)
    }
}

/// The scene of a file made ready, and what that costs with all that `asked` needs beside samples.
///
/// # Errors
/// When the scene cannot be read or measured.
pub fn prepared(path: &Path, asked: &Asked) -> Result<(World, Preparation), Box<dyn Error>> {
    let one = Asked { samples: vec![1], replicates: 1, ..asked.clone() };
    let (mut world, mut seconds) = (None, Vec::new());
    for seed in 0..ROUNDS as u64 {
        world = None;
        let start = ProcessTime::now();
        let ready = world.insert(World::new(Scene::load(path)?)?);
        one.round(ready, seed)?;
        seconds.push(start.elapsed().as_secs_f64());
    }
    let world = world.ok_or("nothing was measured")?;
    Ok((world, Preparation { seconds: median(seconds), peak_memory: peak_memory() }))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// What Linux calls the high-water mark of the resident set.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let kilobytes = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?.split_whitespace().next()?;
    Some(1024 * kilobytes.parse::<u64>().ok()?)
}
