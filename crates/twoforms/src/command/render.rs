//! `twoforms render`: an image by one strategy.

use std::path::{Path, PathBuf};
use std::time::{Instant, SystemTime};

use anyhow::{Context, Result, bail};
use indicatif::HumanCount;
use twoforms_comparison::image::{Centre, Crop, Pixel, PixelFilter, Rendering, Shown};
use twoforms_comparison::places;
use twoforms_comparison::request::Asked;
use twoforms_report::exr::write_exr;
use twoforms_report::png::write_png;
use twoforms_report::{Channel, Image, file};

use crate::args::{FilterArg, QuantityArg, RenderArgs};
use crate::{progress, run};

/// Renders, and writes both files.
pub fn run(args: &RenderArgs) -> Result<()> {
    let started = SystemTime::now();
    run::set_threads(&args.run)?;
    let paths = Paths::new(args)?;
    let world = run::load(&args.scene, &args.run)?;
    let choice = args.camera.choice();
    let camera = places::camera(&world, &choice)?;
    let rendering = rendering(args, choice.size(camera.aspect))?;
    let Crop { x0, x1, y0, y1 } = rendering.crop;
    let count = u64::from(x1 - x0) * u64::from(y1 - y0);
    if count > MOST_PIXELS {
        bail!("{count} pixels are more than can be held at once: ask for at most {MOST_PIXELS}, or a --crop of them");
    }
    let bar = progress::bar(count, "pixels", &args.run);
    let clock = Instant::now();
    let pixels = rendering.run(&world, &camera, &|done| bar.inc(done))?;
    let seconds = clock.elapsed().as_secs_f64();
    bar.finish_and_clear();

    let provenance = run::provenance(&world.scene, args.run.seed(), started)
        .with("strategy", rendering.strategy.to_string().as_str())
        .with("sampler", rendering.sampler.to_string().as_str())
        .with("spp", u64::from(rendering.spp))
        .with("light_samples", u64::from(rendering.light_samples))
        .with("camera", camera.name.as_str())
        .with("quantity", Asked::from(args.quantity).name());
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
    report(args, &paths, &pixels, seconds);
    Ok(())
}

/// Pixels that are kept until the files are written, at some 250 bytes each: 16 GB.
const MOST_PIXELS: u64 = 1 << 26;

/// Says what was done, and that there is nothing to see where all is black.
fn report(args: &RenderArgs, paths: &Paths, pixels: &[Pixel], seconds: f64) {
    let rays = HumanCount(pixels.iter().map(|pixel| pixel.rays).sum());
    let (exr, png) = (paths.exr.display(), paths.png.display());
    run::note(&args.run, &format!("{exr} and {png}: {seconds:.2} s, {rays} rays"));
    if pixels.iter().all(|pixel| pixel.mean == [0.0; 3]) {
        run::note(
            &args.run,
            "note: the image is black: no light reaches what the camera sees; `inspect` lists lights and warnings",
        );
    }
}

/// The two files, tried before anything is computed.
struct Paths {
    exr: PathBuf,
    png: PathBuf,
}

impl Paths {
    fn new(args: &RenderArgs) -> Result<Self> {
        let exr = args.output.clone().map_or_else(|| beside_us(&args.scene), Ok)?;
        let png = exr.with_extension("png");
        file::check(&exr)?;
        file::check(&png)?;
        Ok(Self { exr, png })
    }
}

/// The scene's name with .exr, in the current folder.
fn beside_us(scene: &Path) -> Result<PathBuf> {
    let name =
        scene.file_name().with_context(|| format!("{} is a folder: name a .gltf or .glb file", scene.display()))?;
    Ok(Path::new(name).with_extension("exr"))
}

fn rendering(args: &RenderArgs, [width, height]: [u32; 2]) -> Result<Rendering> {
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
        quantity: match args.quantity {
            QuantityArg::Irradiance => Shown::Irradiance,
            QuantityArg::Radiance if args.lambert => Shown::Diffuse,
            QuantityArg::Radiance => Shown::Radiance,
        },
        seed: args.run.seed(),
    })
}

/// R G B, the strategy's own layer with the variance of one camera sample, and what lies at each pixel's centre.
fn channels(pixels: &[Pixel], strategy: &str) -> Vec<Channel> {
    let centre = |pixel: &Pixel, of: fn(&Centre) -> [f32; 3]| pixel.centre.as_ref().map_or([0.0; 3], of);
    let depth = pixels.iter().map(|pixel| pixel.centre.map_or(0.0, |centre| centre.depth));
    let layers = [
        layer(pixels, "", "RGB", |pixel| rounded(pixel.mean)),
        layer(pixels, &format!("{strategy}."), "RGB", |pixel| rounded(pixel.mean)),
        layer(pixels, &format!("{strategy}.Variance."), "RGB", |pixel| rounded(pixel.variance)),
        layer(pixels, "Albedo.", "RGB", |pixel| centre(pixel, |centre| centre.albedo)),
        layer(pixels, "P.", "XYZ", |pixel| centre(pixel, |centre| centre.position)),
        layer(pixels, "N.", "XYZ", |pixel| centre(pixel, |centre| centre.normal)),
        vec![Channel { name: "depth.Z".to_owned(), samples: depth.collect() }],
    ];
    layers.concat()
}

fn rounded(values: [f64; 3]) -> [f32; 3] {
    values.map(|value| value as f32)
}

/// Three channels of one layer.
fn layer(pixels: &[Pixel], name: &str, letters: &str, values: impl Fn(&Pixel) -> [f32; 3]) -> Vec<Channel> {
    let channel = |(c, letter): (usize, char)| Channel {
        name: format!("{name}{letter}"),
        samples: pixels.iter().map(|pixel| values(pixel)[c]).collect(),
    };
    letters.chars().enumerate().map(channel).collect()
}
