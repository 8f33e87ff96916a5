//! Light samples per second in an image: the rendering alone, without reading the scene and without writing a file.
//!
//! `cargo run --release -p twoforms-comparison --example render_rate -- SCENE STRATEGY[+SAMPLER] WIDTH HEIGHT SPP LIGHT_SAMPLES
//! [--threads N] [--repeat K]` prints one JSON line. The view is that of the scene's first camera. Samples are counted as
//! asked for: WIDTH × HEIGHT × SPP camera samples, LIGHT_SAMPLES for each, whatever they meet.

mod support;

use std::error::Error;

use twoforms_comparison::image::{Crop, PixelFilter, Rendering, Shown};
use twoforms_comparison::world::World;
use twoforms_estimator::sampler::Sampler;
use twoforms_scene::Scene;

use support::{arguments, seconds, whole};

const USAGE: &str =
    "usage: render_rate SCENE STRATEGY[+SAMPLER] WIDTH HEIGHT SPP LIGHT_SAMPLES [--threads N] [--repeat K]";

fn main() -> Result<(), Box<dyn Error>> {
    let (words, [threads, repeat]) = arguments::<6, 2>(USAGE, ["--threads", "--repeat"])?;
    let rendering = rendering(&words)?;
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    let world = World::new(Scene::load(words[0].as_ref())?)?;
    let camera = world.scene.cameras.first().ok_or(format!("{} has no camera", words[0]))?;
    let seconds = seconds(repeat, |round| {
        let rendering = Rendering { seed: round, ..rendering.clone() };
        rendering.run(&world, camera, &|_| ()).map(|pixels| drop(std::hint::black_box(pixels)))
    })?;
    let Rendering { strategy, sampler, width, height, spp, light_samples, .. } = rendering;
    let camera_samples = u64::from(width) * u64::from(height) * u64::from(spp);
    let all = camera_samples * u64::from(light_samples);
    let rate = |seconds: f64| all as f64 / seconds / 1e6;
    println!(
        r#"{{"strategy":"{strategy}","sampler":"{sampler}","width":{width},"height":{height},"spp":{spp},"light_samples_each":{light_samples},"threads":{threads},"camera_samples":{camera_samples},"light_samples":{all},"cpu_seconds":{:.4},"best_cpu_seconds":{:.4},"million_light_samples_per_cpu_second":{:.2},"best":{:.2}}}"#,
        seconds.median,
        seconds.best,
        rate(seconds.median),
        rate(seconds.best),
    );
    Ok(())
}

/// The whole image, as `twoforms render` makes it.
fn rendering([_, strategy, width, height, spp, light_samples]: &[String; 6]) -> Result<Rendering, Box<dyn Error>> {
    let (width, height) = (whole(width, "WIDTH")?, whole(height, "HEIGHT")?);
    let (strategy, sampler) = strategy.split_once('+').unwrap_or((strategy, Sampler::Independent.name()));
    Ok(Rendering {
        strategy: strategy.parse()?,
        sampler: sampler.parse()?,
        width,
        height,
        crop: Crop { x0: 0, x1: width, y0: 0, y1: height },
        spp: whole(spp, "SPP")?,
        light_samples: whole(light_samples, "LIGHT_SAMPLES")?,
        filter: PixelFilter::Box,
        cull: false,
        quantity: Shown::Radiance,
        seed: 0,
    })
}
