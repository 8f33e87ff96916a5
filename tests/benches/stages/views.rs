//! The View from x, gathered and not.

use criterion::Criterion;
use twoforms_geometry::view::{Effort, View};
use twoforms_tests::worlds;

use crate::clock::CpuTime;
use crate::{SCENE, cases};

/// `View::new` at each receiver.
pub fn benches(criterion: &mut Criterion<CpuTime>) {
    let stage = worlds::stage(SCENE);
    let geometry = &stage.world.geometry;
    let mut group = criterion.benchmark_group("view");
    for case in cases(&stage) {
        let (name, frame) = (&case.place.name, case.place.frame());
        for (how, effort) in [("gather", Effort::Gather), ("cast", Effort::Cast)] {
            let id = format!("{how}, {name}");
            group.bench_function(id, |bencher| bencher.iter(|| View::new(geometry, frame, effort)));
        }
    }
    group.finish();
}
