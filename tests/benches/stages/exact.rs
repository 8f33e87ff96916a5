//! One receiver without chance, as `twoforms exact` works it out.

use criterion::Criterion;
use twoforms_comparison::exactly;
use twoforms_comparison::exactly::with_formula;
use twoforms_estimator::strategy::{Strategy, Team, Weighting};
use twoforms_tests::worlds;

use crate::clock::CpuTime;
use crate::{SCENE, cases};

/// The irradiance alone, the variances of all techniques, and that of a team.
pub fn benches(criterion: &mut Criterion<CpuTime>) {
    let stage = worlds::stage(SCENE);
    let all = with_formula();
    let techniques: Vec<Strategy> =
        all.into_iter().filter(|s| !matches!(s, Strategy::Mis(..) | Strategy::Mixture(..))).collect();
    let balance = [Strategy::Mis(Weighting::Balance, Team::default())];
    let works: [(&str, &[Strategy]); 3] =
        [("irradiance", &[]), ("and the variances of all techniques", &techniques), ("and mis/balance", &balance)];
    let mut group = criterion.benchmark_group("exact");
    for case in cases(&stage) {
        for (what, strategies) in works {
            let id = format!("{what}, {}", case.place.name);
            group.bench_function(id, |bencher| bencher.iter(|| exactly::at(&stage.world, &case.place, strategies)));
        }
    }
    group.finish();
}
