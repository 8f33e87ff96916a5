//! Samples per second at fixed points: the view from each point is built once, then N samples are drawn.
//!
//! `cargo run --release -p twoforms-comparison --example sample_points -- SCENE POINTS.csv STRATEGY N [--repeat K]`
//! prints one JSON line. POINTS.csv has six numbers a line: position and normal.

mod support;

use std::error::Error;

use glam::DVec3;
use twoforms_comparison::world::World;
use twoforms_estimator::batch::Batch;
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::{Sampler, Stream};
use twoforms_estimator::secondary::secondary_in;
use twoforms_estimator::strategy::{Known, Prepared, Strategy};
use twoforms_estimator::xi::{Draws, Key};
use twoforms_geometry::frame::Frame;
use twoforms_geometry::view::{Effort, View};
use twoforms_scene::Scene;

use support::{arguments, seconds, whole};

const USAGE: &str = "usage: sample_points SCENE POINTS.csv STRATEGY N [--repeat K]";

fn main() -> Result<(), Box<dyn Error>> {
    let ([scene, points, strategy, n], [repeat]) = arguments(USAGE, ["--repeat"])?;
    let (strategy, n): (Strategy, u32) = (strategy.parse()?, whole(&n, "N")?);
    let world = World::new(Scene::load(scene.as_ref())?)?;
    let prepared = strategy.prepare(&world.lights);
    let frames = frames(&std::fs::read_to_string(points)?)?;
    let mut mean = 0.0;
    let seconds = seconds(repeat, |round| {
        mean = mean_irradiance(&world, &prepared, &frames, n, round)?;
        Ok::<_, Box<dyn Error>>(())
    })?;
    let rate = |seconds: f64| frames.len() as f64 * f64::from(n) / seconds / 1e6;
    println!(
        r#"{{"strategy":"{strategy}","points":{},"samples":{n},"million_samples_per_cpu_second":{:.1},"best":{:.1},"mean_irradiance":{mean}}}"#,
        frames.len(),
        rate(seconds.median),
        rate(seconds.best),
    );
    Ok(())
}

fn frames(text: &str) -> Result<Vec<Frame>, Box<dyn Error>> {
    let frame = |line: &str| {
        let numbers = line.split(',').map(|number| number.trim().parse()).collect::<Result<Vec<f64>, _>>()?;
        let [x, y, z, nx, ny, nz] = numbers[..] else { return Err(format!("six numbers are needed: {line}").into()) };
        Ok(Frame::new(DVec3::new(x, y, z), DVec3::new(nx, ny, nz).normalize()))
    };
    text.lines().map(frame).collect()
}

fn mean_irradiance(
    world: &World,
    prepared: &Prepared,
    frames: &[Frame],
    n: u32,
    round: u64,
) -> Result<f64, Box<dyn Error>> {
    let query = Query::irradiance(&world.lights);
    let (mut sum, mut batch) = (0.0, Batch::new(prepared.strategy().pairs()));
    for (frame, point) in frames.iter().zip(0..) {
        let view = View::new(&world.geometry, *frame, Effort::Gather);
        let draws = Draws { key: Key::new([round, point]), stream: [n, 0] };
        let stream = Stream { sampler: Sampler::Independent, draws, n };
        sum += secondary_in(&mut batch, &*prepared.at(&view, &query, &Known::default()), stream, 0..n)?.luminance.mean;
    }
    Ok(sum / frames.len() as f64)
}
