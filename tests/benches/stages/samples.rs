//! What one sample costs at a receiver, of every strategy that can be sampled.

use criterion::{BenchmarkGroup, Criterion, Throughput};
use twoforms_estimator::estimate::Estimate;
use twoforms_estimator::estimator::Estimator;
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::{Sampler, Stream};
use twoforms_estimator::secondary::secondary_by;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::{Kind, Technique};
use twoforms_estimator::xi::{Draws, Key};
use twoforms_geometry::lanes::Instructions;
use twoforms_geometry::view::{Effort, View};
use twoforms_tests::worlds::{self, Case};

use crate::clock::CpuTime;
use crate::{SCENE, cases};

/// N: samples of one estimate.
const N: u32 = 1024;

/// One from each formulation, measured with all instructions that the machine has.
const BY_ALL: [Technique; 2] = [Technique::of(Kind::AreaUniform), Technique::of(Kind::HemisphereCosine)];

/// An estimate of N samples.
fn estimate(estimator: &dyn Estimator, instructions: Instructions) -> Estimate {
    let draws = Draws { key: Key::new([0]), stream: [N, 0] };
    let stream = Stream { sampler: Sampler::Independent, draws, n: N };
    secondary_by(estimator, instructions, stream, 0..N).expect("finite samples")
}

/// Every strategy at each receiver; some by other instructions too.
pub fn benches(criterion: &mut Criterion<CpuTime>) {
    let stage = worlds::stage(SCENE);
    for case in cases(&stage) {
        let mut group = group(criterion, &format!("samples/{}", case.place.name));
        for strategy in Strategy::all() {
            bench(&mut group, &strategy.to_string(), &case, strategy, Instructions::best());
        }
        group.finish();
    }
    let case = stage.case(crate::RECEIVERS[0]);
    for strategy in BY_ALL {
        let mut group = group(criterion, &format!("instructions/{strategy}"));
        for instructions in Instructions::all() {
            bench(&mut group, &instructions.to_string(), &case, strategy.into(), instructions);
        }
        group.finish();
    }
}

/// Measurements of N samples each.
fn group<'c>(criterion: &'c mut Criterion<CpuTime>, name: &str) -> Group<'c> {
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(N.into()));
    group
}

type Group<'c> = BenchmarkGroup<'c, CpuTime>;

fn bench(group: &mut Group, name: &str, case: &Case, strategy: Strategy, instructions: Instructions) {
    let world = &case.stage.world;
    let view = View::new(&world.geometry, case.place.frame(), Effort::Gather);
    let query = Query::irradiance(&world.lights);
    let known = twoforms_tests::samples::known(case, strategy);
    let prepared = strategy.prepare(&world.lights);
    let estimator = prepared.at(&view, &query, &known);
    group.bench_function(name, |bencher| bencher.iter(|| estimate(&*estimator, instructions)));
}
