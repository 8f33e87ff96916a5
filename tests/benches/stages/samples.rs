//! What one sample costs at a receiver, of every strategy that can be sampled.

use criterion::{Criterion, Throughput};
use twoforms_estimator::density::Density;
use twoforms_estimator::estimator::{Estimate, Estimator};
use twoforms_estimator::formulation::Formulation;
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::{Sampler, Stream};
use twoforms_estimator::selection::Selection;
use twoforms_estimator::strategy::{Draw, Kernel, Strategy};
use twoforms_estimator::xi::{Draws, Key};
use twoforms_geometry::lanes::Instructions;
use twoforms_geometry::view::{Effort, View};
use twoforms_tests::worlds::{self, Case};

use crate::clock::CpuTime;
use crate::{SCENE, cases};

/// N: samples of one estimate.
const N: u32 = 1024;

/// One from each formulation, measured with all instructions that the machine has.
const BY_ALL: [Strategy; 2] = [Strategy::Area(Draw::Uniform, Selection::Together), Strategy::HemisphereCosine];

/// An estimate of N samples.
struct Secondary(Instructions);

impl Kernel for Secondary {
    type Output = Estimate;

    fn run<F: Formulation, D: Density<F::Measure>>(self, estimator: &Estimator<F, D>) -> Estimate {
        let draws = Draws { key: Key::new([0]), stream: [N, 0] };
        let stream = Stream { sampler: Sampler::Independent, draws };
        estimator.secondary_by(self.0, N, stream).expect("finite samples")
    }
}

/// Every strategy at each receiver; some by other instructions too.
pub fn benches(criterion: &mut Criterion<CpuTime>) {
    let stage = worlds::stage(SCENE);
    for case in cases(&stage) {
        for strategy in Strategy::all() {
            bench(criterion, &case, strategy, "", Instructions::best());
        }
    }
    let case = stage.case(crate::RECEIVERS[0]);
    for strategy in BY_ALL {
        for instructions in Instructions::all() {
            bench(criterion, &case, strategy, &format!(", {instructions:?}"), instructions);
        }
    }
}

fn bench(criterion: &mut Criterion<CpuTime>, case: &Case, strategy: Strategy, note: &str, instructions: Instructions) {
    let world = &case.stage.world;
    let view = View::new(&world.geometry, case.place.frame(), Effort::Gather);
    let query = Query::irradiance(&world.lights);
    let prepared = strategy.prepare(&world.lights).expect("a strategy that can be sampled");
    let mut group = criterion.benchmark_group(format!("samples/{}", case.place.name));
    group.throughput(Throughput::Elements(N.into()));
    group.bench_function(format!("{strategy}{note}"), |bencher| {
        bencher.iter(|| prepared.run(&view, &query, Secondary(instructions)));
    });
    group.finish();
}
