//! The experiment: strategies × samplers × sample counts × replicates at each receiver.

use rayon::prelude::*;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::{Known, Prepared, Strategy};
use twoforms_estimator::xi::Key;
use twoforms_geometry::view::{Effort, View};

use crate::answer::Answer;
use crate::clock;
use crate::error::{Broken, ComparisonError};
use crate::measurement::Measurement;
use crate::place::Place;
use crate::plan::{Plan, Task};
use crate::result::ReceiverResult;
use crate::rows::Report;
use crate::verdict::Criteria;
use crate::world::World;

/// What is compared, and how often.
#[derive(Clone, Debug, PartialEq)]
pub struct Experiment {
    /// The strategies.
    pub strategies: Vec<Strategy>,
    /// The samplers.
    pub samplers: Vec<Sampler>,
    /// N: the sample counts.
    pub samples: Vec<u32>,
    /// R: independent replicates of each.
    pub replicates: u32,
    /// The seed: equal seeds give equal results.
    pub seed: u64,
    /// When a bias is found.
    pub criteria: Criteria,
}

/// N where nothing is said.
pub const DEFAULT_SAMPLES: [u32; 6] = [1, 4, 16, 64, 256, 1024];
/// R where nothing is said.
pub const DEFAULT_REPLICATES: u32 = 1000;

/// Receivers that are measured before any of them is reported.
const RECEIVERS_AT_ONCE: usize = 64;
/// Samples that one task draws, at least: enough to make a task's overhead vanish.
const SAMPLES_PER_TASK: u64 = 1 << 15;

impl Experiment {
    /// Number of samples at each receiver, for progress bars.
    pub fn samples_per_receiver(&self) -> u64 {
        let each: u64 = self.samples.iter().map(|&n| u64::from(n)).sum();
        each * u64::from(self.replicates) * (self.strategies.len() * self.samplers.len()) as u64
    }

    /// Measures every receiver, in parallel on rayon's threads. The results do not depend on how many there are.
    ///
    /// `progress` is told of samples drawn, from any thread.
    ///
    /// # Errors
    /// When a strategy is impossible, or a sample is not finite.
    pub fn run(
        &self,
        world: &World,
        places: &[Place],
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<Vec<ReceiverResult>, ComparisonError> {
        self.admit()?;
        let prepared: Vec<Prepared> = self.strategies.iter().map(|s| s.prepare(&world.lights)).collect();
        let plans = self.plans(&prepared);
        let mut report = Report::default();
        for group in places.chunks(RECEIVERS_AT_ONCE) {
            let ready = Ready::all(world, group, &self.strategies);
            self.group(world, group, &ready, &plans, progress, &mut report)?;
        }
        Ok(report.judged(self.criteria))
    }

    /// The same experiment for many seeds: what is known without chance is worked out once, and kept for all receivers.
    pub fn repeatable<'w>(self, world: &'w World, places: &'w [Place]) -> Repeatable<'w> {
        let ready = Ready::all(world, places, &self.strategies);
        Repeatable { experiment: self, world, places, ready }
    }

    /// Makes sure that every sampler can spread the numbers of every strategy.
    fn admit(&self) -> Result<(), ComparisonError> {
        for strategy in &self.strategies {
            for sampler in &self.samplers {
                let refused = |why| ComparisonError::Impossible(format!("\"{strategy}\": {why}"));
                sampler.admit(strategy.pairs()).map_err(refused)?;
            }
        }
        Ok(())
    }

    /// The N that a sampler takes where another one is asked for: all that are rounded up, with what they become.
    pub fn rounded(&self) -> Vec<(Sampler, [u32; 2])> {
        let of = |&sampler: &Sampler| self.samples.iter().map(move |&n| (sampler, [n, sampler.rounded(n)]));
        self.samplers.iter().flat_map(of).filter(|(_, [n, rounded])| n != rounded).collect()
    }

    fn plans<'a>(&self, prepared: &'a [Prepared]) -> Vec<Plan<'a>> {
        let mut plans = Vec::new();
        for prepared in prepared {
            for &sampler in &self.samplers {
                let mut samples: Vec<u32> = self.samples.iter().map(|&samples| sampler.rounded(samples)).collect();
                samples.dedup();
                plans.extend(samples.into_iter().map(|samples| Plan { prepared, sampler, samples }));
            }
        }
        plans
    }

    fn group(
        &self,
        world: &World,
        places: &[Place],
        ready: &[Ready],
        plans: &[Plan],
        progress: &(dyn Fn(u64) + Sync),
        report: &mut Report,
    ) -> Result<(), ComparisonError> {
        self.check_known(places, ready)?;
        let tasks: Vec<Task> =
            (0..places.len()).flat_map(|p| (0..plans.len()).flat_map(move |r| self.tasks(p, r, &plans[r]))).collect();
        let measured: Vec<Result<Measurement, Broken>> = tasks
            .par_iter()
            .map(|task| {
                let (place, plan) = (&places[task.place], &plans[task.plan]);
                let part = self.measure(world, place, &ready[task.place], plan, task)?;
                progress(u64::from(plan.samples) * task.replicates.len() as u64);
                Ok(part)
            })
            .collect();
        let parts = measured.into_iter().collect::<Result<Vec<Measurement>, Broken>>()?;
        let mut parts = tasks.iter().zip(parts).peekable();
        for (p, (place, ready)) in places.iter().zip(ready).enumerate() {
            let row = |(r, plan)| {
                let mut measurement = Measurement::default();
                while let Some((_, part)) = parts.next_if(|(task, _)| (task.place, task.plan) == (p, r)) {
                    measurement.add(part);
                }
                (plan, measurement)
            };
            let rows: Vec<(&Plan, Measurement)> = plans.iter().enumerate().map(row).collect();
            report.add(place, ready.setup_seconds, &rows, &ready.answer);
        }
        Ok(())
    }

    /// Makes sure that what strategies must know beforehand is known everywhere.
    fn check_known(&self, places: &[Place], ready: &[Ready]) -> Result<(), ComparisonError> {
        self.check_unoccluded(places, ready)?;
        for strategy in &self.strategies {
            let Some(team) = strategy.needs_alpha() else { continue };
            let unknown = |(_, ready): &(&Place, &Ready)| ready.answer.known().alpha(team).is_none();
            if let Some((place, ready)) = places.iter().zip(ready).find(unknown) {
                let why = ready.answer.variance_of_one(*strategy).err();
                return Err(ComparisonError::Impossible(format!(
                    "\"{strategy}\" needs α, which is not known at receiver \"{}\": {}; leave the strategy or the receiver out, \
                     or take mis/optimal-pilot/64",
                    place.name,
                    why.as_deref().unwrap_or("its integrals do not converge there"),
                )));
            }
        }
        Ok(())
    }

    fn check_unoccluded(&self, places: &[Place], ready: &[Ready]) -> Result<(), ComparisonError> {
        let Some(strategy) = self.strategies.iter().find(|strategy| strategy.needs_unoccluded()) else { return Ok(()) };
        let lacks = |place: &Place, ready: &Ready| place.is_glossy() && ready.answer.known().unoccluded.is_none();
        if let Some((place, ready)) = places.iter().zip(ready).find(|(place, ready)| lacks(place, ready)) {
            return Err(ComparisonError::Impossible(format!(
                "\"{strategy}\" needs the unhidden radiance, which is not known at receiver \"{}\": {}; leave the strategy \
                 or the receiver out",
                place.name,
                ready.answer.irradiance().err().unwrap_or("its integrals do not converge there"),
            )));
        }
        Ok(())
    }

    /// Cuts one row's replicates into tasks, by N and R alone.
    fn tasks(&self, place: usize, plan: usize, row: &Plan) -> impl Iterator<Item = Task> + use<> {
        let replicates = if row.sampler.is_random() { self.replicates } else { 1 };
        let size = (SAMPLES_PER_TASK / u64::from(row.samples)).clamp(1, u64::from(replicates)) as u32;
        let starts = (0..replicates).step_by(size as usize);
        starts.map(move |start| Task { place, plan, replicates: start..replicates.min(start.saturating_add(size)) })
    }

    fn measure(
        &self,
        world: &World,
        place: &Place,
        ready: &Ready,
        plan: &Plan,
        task: &Task,
    ) -> Result<Measurement, Broken> {
        let strategy = plan.prepared.strategy();
        let key = self.key(place, strategy, plan.sampler);
        let (query, known) = (place.query(&world.lights), Known { key, ..ready.answer.known() });
        Measurement::of(plan, &ready.view, &query, &known, place.emission(), key, task).map_err(
            |(replicate, source)| Broken {
                receiver: place.name.clone(),
                strategy,
                samples: plan.samples,
                replicate,
                source,
            },
        )
    }

    fn key(&self, place: &Place, strategy: Strategy, sampler: Sampler) -> Key {
        let names = format!("{}\n{sampler}", strategy.density_name());
        let words = [self.seed].into_iter().chain(place.bits());
        Key::new(words.chain(Key::words_of(&names)).collect::<Vec<u64>>())
    }
}

/// An experiment with all that is known without chance where it measures, to be run again and again.
pub struct Repeatable<'w> {
    experiment: Experiment,
    world: &'w World,
    places: &'w [Place],
    ready: Vec<Ready<'w>>,
}

impl Repeatable<'_> {
    /// What [`Experiment::run`] gives with this seed, but for the times.
    ///
    /// # Errors
    /// As [`Experiment::run`].
    pub fn run(&self, seed: u64) -> Result<Vec<ReceiverResult>, ComparisonError> {
        let experiment = Experiment { seed, ..self.experiment.clone() };
        experiment.admit()?;
        let prepared: Vec<Prepared> = experiment.strategies.iter().map(|s| s.prepare(&self.world.lights)).collect();
        let mut report = Report::default();
        experiment.group(self.world, self.places, &self.ready, &experiment.plans(&prepared), &|_| (), &mut report)?;
        Ok(report.judged(experiment.criteria))
    }
}

/// A receiver with all that is worked out once before its rows.
struct Ready<'g> {
    view: View<'g>,
    setup_seconds: f64,
    answer: Answer,
}

impl<'g> Ready<'g> {
    fn all(world: &'g World, places: &[Place], strategies: &[Strategy]) -> Vec<Self> {
        places.par_iter().map(|place| Self::new(world, place, strategies)).collect()
    }

    fn new(world: &'g World, place: &Place, strategies: &[Strategy]) -> Self {
        let (view, setup_seconds) = clock::timed(|| View::new(&world.geometry, place.frame(), Effort::Gather));
        Self { view, setup_seconds, answer: Answer::new(world, place, strategies) }
    }
}
