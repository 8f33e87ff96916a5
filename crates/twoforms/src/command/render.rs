//! `twoforms render`: an image by one strategy.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Instant, SystemTime};

use anyhow::{Context, Result, bail};
use twoforms_comparison::image::{Centre, Crop, Pixel, PixelFilter, Rendering};
use twoforms_report::exr::write_exr;
use twoforms_report::png::write_png;
use twoforms_report::{Channel, Image, file};

use crate::args::{FilterArg, ImageSize, QuantityArg, RenderArgs};
use crate::{places, progress, run};

/// Renders, and writes both files.
pub fn run(args: &RenderArgs) -> Result<()> {
    let started = SystemTime::now();
    run::set_threads(&args.run)?;
    let paths = Paths::new(args)?;
    let world = run::load(&args.scene, &args.run)?;
    let camera = places::camera(&world, &args.camera)?;
    let rendering = rendering(args, args.camera.size(camera.aspect))?;
    let Crop { x0, x1, y0, y1 } = rendering.crop;
    let bar = progress::bar(u64::from(x1 - x0) * u64::from(y1 - y0), "pixels", &args.run);
    let clock = Instant::now();
    let pixels = rendering.run(&world, &camera, &|done| bar.inc(done))?;
    let seconds = clock.elapsed().as_secs_f64();
    bar.finish_and_clear();

    let provenance = run::provenance(&world.scene, &args.run, started)
        .with("strategy", rendering.strategy.to_string().as_str())
        .with("sampler", rendering.sampler.to_string().as_str())
        .with("spp", u64::from(rendering.spp))
        .with("light_samples", u64::from(rendering.light_samples))
        .with("camera", camera.name.as_str());
    let image = Image {
        width: rendering.crop.width() as usize,
        height: rendering.crop.height() as usize,
        channels: channels(&pixels, &rendering.strategy.to_string()),
        samples_per_pixel: rendering.spp,
        render_seconds: Some(seconds),
        provenance,
    };
    write_exr(&paths.exr, &image)?;
    write_png(&paths.png, &image)?;
    if !args.run.quiet {
        let rays: u64 = pixels.iter().map(|pixel| pixel.rays).sum();
        eprintln!(
            "{} and {}: {seconds:.1} s, {:.1} million rays",
            paths.exr.display(),
            paths.png.display(),
            rays as f64 / 1e6
        );
    }
    Ok(())
}

/// The two files, tried before anything is computed.
struct Paths {
    exr: PathBuf,
    png: PathBuf,
}

impl Paths {
    fn new(args: &RenderArgs) -> Result<Self> {
        let exr = match &args.output {
            Some(path) => path.clone(),
            None => Path::new(args.scene.file_name().context("the scene has no file name")?).with_extension("exr"),
        };
        if exr.extension().is_none_or(|extension| extension != "exr") {
            bail!(
                "{} does not end in .exr, the one format that is written (a PNG preview goes beside it)",
                exr.display()
            );
        }
        let png = exr.with_extension("png");
        file::check(&exr)?;
        file::check(&png)?;
        Ok(Self { exr, png })
    }
}

fn rendering(args: &RenderArgs, [width, height]: ImageSize) -> Result<Rendering> {
    let window = args.crop.map_or([0.0, 1.0, 0.0, 1.0], |crop| crop.0);
    let [x0, x1, y0, y1] = [(window[0], width), (window[1], width), (window[2], height), (window[3], height)]
        .map(|(fraction, pixels)| (fraction * f64::from(pixels)).round() as u32);
    if x0 == x1 || y0 == y1 {
        bail!("--crop leaves no pixel of an image of {width} × {height}: widen it");
    }
    Ok(Rendering {
        strategy: args.strategy,
        sampler: args.sampler,
        width,
        height,
        crop: Crop { x0, x1, y0, y1 },
        spp: args.spp,
        light_samples: args.light_samples,
        filter: match args.pixel_filter {
            FilterArg::Box => PixelFilter::Box,
            FilterArg::Point => PixelFilter::Point,
        },
        cull: args.cull,
        radiance: args.quantity == QuantityArg::Radiance,
        seed: args.run.seed,
    })
}

/// R G B, the strategy's own layer with the variance of one camera sample, and what lies at each pixel's centre.
fn channels(pixels: &[Pixel], strategy: &str) -> Vec<Channel> {
    let mut planes: BTreeMap<String, Vec<f32>> = BTreeMap::new();
    for pixel in pixels {
        for (name, value) in values(pixel, strategy) {
            planes.entry(name).or_default().push(value);
        }
    }
    planes.into_iter().map(|(name, samples)| Channel { name, samples }).collect()
}

fn values(pixel: &Pixel, strategy: &str) -> Vec<(String, f32)> {
    let centre = pixel.centre.unwrap_or(Centre { position: [0.0; 3], normal: [0.0; 3], depth: 0.0, albedo: [0.0; 3] });
    let triples = [
        (String::new(), "RGB", pixel.mean),
        (format!("{strategy}."), "RGB", pixel.mean),
        (format!("{strategy}.Variance."), "RGB", pixel.variance),
        ("Albedo.".to_owned(), "RGB", centre.albedo.map(f64::from)),
        ("P.".to_owned(), "XYZ", centre.position),
        ("N.".to_owned(), "XYZ", centre.normal),
    ];
    let named = triples.into_iter().flat_map(|(prefix, letters, values)| {
        letters.chars().zip(values).map(move |(letter, value)| (format!("{prefix}{letter}"), value as f32))
    });
    named.chain([("depth.Z".to_owned(), centre.depth as f32)]).collect()
}
