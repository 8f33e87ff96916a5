//! Benchmarks of every stage, in CPU time: `cargo bench -p twoforms-tests [-- FILTER]`.

mod clock;
mod exact;
mod images;
mod loading;
mod rays;
mod samples;
mod views;

use std::time::Duration;

use criterion::Criterion;
use twoforms_tests::worlds::{Case, Stage};

use crate::clock::CpuTime;

/// The scene that stages are measured in, unless they say otherwise.
const SCENE: &str = "cornell-box";
/// Its receiver before which nothing stands, and the one that sees part of the light.
const RECEIVERS: [&str; 2] = ["floor-lit", "behind-tall-block"];

/// The two receivers.
fn cases(stage: &Stage) -> impl Iterator<Item = Case<'_>> {
    RECEIVERS.into_iter().map(|name| stage.case(name))
}

fn main() {
    // One thread, so that CPU time is that of the work alone and not of threads that wait for more of it.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("no threads were started yet");
    let mut criterion = Criterion::default()
        .with_measurement(CpuTime)
        .without_plots()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .configure_from_args();
    loading::benches(&mut criterion);
    rays::benches(&mut criterion);
    views::benches(&mut criterion);
    samples::benches(&mut criterion);
    exact::benches(&mut criterion);
    images::benches(&mut criterion);
    criterion.final_summary();
}
