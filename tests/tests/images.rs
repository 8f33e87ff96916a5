//! Images: what each pixel must be on average, and how far it may scatter.

use std::f64::consts::PI;

use rayon::prelude::*;
use twoforms_comparison::image::{Crop, Pixel, PixelFilter, Rendering, Shown};
use twoforms_comparison::viewpoint;
use twoforms_estimator::moments::Moments;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::Kind;
use twoforms_scene::Camera;
use twoforms_tests::samples::{moments, samples};
use twoforms_tests::statistics::{Family, Outcome, ZTest};
use twoforms_tests::worlds::{self, Case, Stage};

const SEED: u64 = 20_260_805;
const LEVEL: f64 = 1e-3;
/// What binary32 arithmetic may add, as a share of the value.
const BUDGET: f64 = 3e-6;
/// Fewer samples that are not zero say too little.
const LEAST_HITS: f64 = 100.0;

fn rendering(strategy: Strategy, [width, height]: [u32; 2], spp: u32) -> Rendering {
    Rendering {
        strategy,
        sampler: Sampler::Independent,
        width,
        height,
        crop: Crop { x0: 0, x1: width, y0: 0, y1: height },
        spp,
        light_samples: 1,
        filter: PixelFilter::Box,
        cull: false,
        quantity: Shown::Radiance,
        seed: SEED,
    }
}

fn render(rendering: &Rendering, stage: &Stage, camera: &Camera) -> Vec<Pixel> {
    rendering.run(&stage.world, camera, &|_| ()).expect("finite samples")
}

/// Mean of a channel over some pixels, and the variance of that mean.
fn pooled<'a>(pixels: impl Iterator<Item = &'a Pixel>, spp: u32, channel: usize) -> [f64; 2] {
    let (mut mean, mut variance, mut n) = (0.0, 0.0, 0.0);
    for pixel in pixels {
        mean += pixel.mean[channel];
        variance += pixel.variance[channel] / f64::from(spp);
        n += 1.0;
    }
    [mean / n, variance / (n * n)]
}

/// The strategies that images can be made by, without those that are biased by design.
fn unbiased() -> Vec<Strategy> {
    Strategy::all_in_images().into_iter().filter(|strategy| !strategy.is_biased()).collect()
}

/// In a closed box of radiance 1 and albedo ρ every pixel is L_e + ρE/π = 1 + ρ, by any strategy.
#[test]
fn a_furnace_is_one_plus_its_albedo_everywhere() {
    let stage = worlds::stage("furnace");
    let albedo = f64::from(stage.world.scene.albedo(0)[0]);
    let camera = &stage.world.scene.cameras[0];
    let outcome = |strategy: Strategy| {
        let spp = 64;
        let pixels = render(&rendering(strategy, [32, 24], spp), &stage, camera);
        let [mean, variance] = pooled(pixels.iter(), spp, 0);
        let test = ZTest { found: mean, expected: 1.0 + albedo, sigma: variance.sqrt(), budget: BUDGET };
        Outcome::Tested { p: test.p(), evidence: format!("{strategy}: {test}") }
    };
    let outcomes = unbiased().into_iter().map(outcome).collect();
    Family::new("means of furnace images", LEVEL, SEED, outcomes).assert_holds(0.0);

    for pixel in render(&rendering(Strategy::from(Kind::HemisphereCosine), [32, 24], 4), &stage, camera) {
        let off = pixel.mean.map(|c| (c - 1.0 - albedo).abs());
        assert!(off.iter().all(|&off| off <= BUDGET), "{pixel:?}");
    }
}

/// A camera right above a receiver that lies on a surface, and that surface's albedo and emission.
fn close_up(case: &Case) -> Option<(Camera, [f32; 3], [f32; 3])> {
    let (world, place) = (&case.stage.world, &case.place);
    let seen = world.surface_at(place.position, place.normal)?;
    let eye = place.position + place.normal / 64.0;
    let camera = viewpoint::look_at("close-up", eye, place.position, 0.5)?;
    Some((camera, world.scene.albedo(seen.triangle), world.emission(&seen)))
}

/// A pixel at a receiver, by one strategy and n light samples per camera sample.
struct CloseUp<'a> {
    name: String,
    case: &'a Case<'a>,
    pixel: Pixel,
    /// n.
    light_samples: f64,
    /// L_e.
    emission: [f32; 3],
    /// ρ/π.
    f_r: [f64; 3],
    /// V: the cited variance of one sample of irradiance.
    cited: [f64; 3],
    /// Fourth central moment of one sample of irradiance over V², measured; 0 without variance.
    kurtosis: [f64; 3],
}

/// Camera samples of a close-up.
const SPP: u32 = 1000;

impl<'a> CloseUp<'a> {
    /// `None` where the receiver lies on no surface.
    fn new(case: &'a Case, strategy: Strategy, light_samples: u32) -> Option<Self> {
        let (camera, albedo, emission) = close_up(case)?;
        let one = Rendering { light_samples, filter: PixelFilter::Point, ..rendering(strategy, [1, 1], SPP) };
        let pixel = render(&one, case.stage, &camera)[0];
        let drawn = samples(case, strategy, Sampler::Independent, 20_000, SEED);
        let kurtosis = |c| {
            let Moments { n, m2, m4, .. } = moments(&drawn, c);
            if m2 > 0.0 { n * m4 / (m2 * m2) } else { 0.0 }
        };
        Some(Self {
            name: format!("{case} {strategy}, {light_samples} light samples"),
            case,
            pixel,
            light_samples: f64::from(light_samples),
            emission,
            f_r: albedo.map(|rho| f64::from(rho) / PI),
            cited: case.variance(strategy)?,
            kurtosis: [0, 1, 2].map(kurtosis),
        })
    }

    /// A lower bound of the light samples that are expected not to be zero, or infinite where E = 0.
    fn hits(&self, c: usize) -> f64 {
        let e = self.case.known.irradiance[c];
        let share = e * e / (self.cited[c] + e * e);
        if e > 0.0 { f64::from(SPP) * self.light_samples * share } else { f64::INFINITY }
    }

    /// (ρ/π)² V/n.
    fn variance(&self, c: usize) -> f64 {
        self.f_r[c] * self.f_r[c] * self.cited[c] / self.light_samples
    }

    /// The mean is L_e + ρE/π.
    fn mean_test(&self, c: usize) -> Outcome {
        let expected = f64::from(self.emission[c]) + self.f_r[c] * self.case.known.irradiance[c];
        let sigma = (self.variance(c) / f64::from(SPP)).sqrt();
        self.outcome(c, "mean", ZTest { found: self.pixel.mean[c], expected, sigma, budget: BUDGET * expected })
    }

    /// The variance of camera samples is (ρ/π)² V/n; Var(s²) = σ⁴ (2/(m − 1) + (κ − 3)/(n m)) for m of them.
    fn variance_test(&self, c: usize) -> Outcome {
        let (expected, m) = (self.variance(c), f64::from(SPP));
        let relative = 2.0 / (m - 1.0) + (self.kurtosis[c] - 3.0) / (self.light_samples * m);
        let delta = BUDGET * self.pixel.mean[c];
        let budget = (2.0 * expected.sqrt() + delta) * delta;
        let sigma = expected * relative.max(0.0).sqrt();
        self.outcome(c, "variance", ZTest { found: self.pixel.variance[c], expected, sigma, budget })
    }

    fn outcome(&self, c: usize, of: &str, test: ZTest) -> Outcome {
        let name = format!("{of} of {} channel {c}", self.name);
        match self.hits(c) {
            hits if hits < LEAST_HITS => {
                Outcome::Skipped { why: format!("{name}: {hits:.2} samples are expected not to be zero") }
            }
            _ => Outcome::Tested { p: test.p(), evidence: format!("{name}: {test}") },
        }
    }
}

/// With one light sample the program casts rays, with 32 it gathers what stands between.
#[test]
fn pixels_at_receivers_have_their_known_radiance_and_variance() {
    let stages = worlds::all();
    let of_case = |case: Case| {
        let mut outcomes = Vec::new();
        for strategy in unbiased() {
            for light_samples in [1, 32] {
                let Some(close_up) = CloseUp::new(&case, strategy, light_samples) else { continue };
                outcomes.extend((0..3).flat_map(|c| [close_up.mean_test(c), close_up.variance_test(c)]));
            }
        }
        outcomes
    };
    let outcomes: Vec<Outcome> = worlds::cases(&stages).into_par_iter().flat_map_iter(of_case).collect();
    Family::new("pixels at receivers", LEVEL, SEED, outcomes).assert_holds(0.25);
}

/// Irradiance images of the Cornell box: every strategy agrees with `area/uniform` at every block of 8×8 pixels.
#[test]
fn strategies_agree_at_every_block_of_an_image() {
    const SIZE: u32 = 32;
    const BLOCK: u32 = 8;
    const SPP: u32 = 128;
    const LIGHT_SAMPLES: u32 = 8;
    let stage = worlds::stage("cornell-box");
    let camera = &stage.world.scene.cameras[0];
    let image = |strategy| {
        let irradiance = Rendering {
            quantity: Shown::Irradiance,
            light_samples: LIGHT_SAMPLES,
            ..rendering(strategy, [SIZE, SIZE], SPP)
        };
        render(&irradiance, &stage, camera)
    };
    let area = Strategy::from(Kind::AreaUniform);
    let reference = image(area);
    let brightest = PI * f64::from(stage.world.lights.radiance(0)[0]);
    let mut outcomes = Vec::new();
    for strategy in Strategy::defaults().into_iter().filter(|&strategy| strategy != area) {
        let other = image(strategy);
        for block in 0..(SIZE / BLOCK) * (SIZE / BLOCK) {
            let (x0, y0) = (block % (SIZE / BLOCK) * BLOCK, block / (SIZE / BLOCK) * BLOCK);
            let inside = |k: u32| (x0..x0 + BLOCK).contains(&(k % SIZE)) && (y0..y0 + BLOCK).contains(&(k / SIZE));
            let of = |pixels: &[Pixel]| {
                let pixels = (0..).zip(pixels).filter(|(k, _)| inside(*k)).map(|(_, pixel)| pixel);
                pooled(pixels, SPP, 0)
            };
            let ([expected, v], [found, w]) = (of(&reference), of(&other));
            let name = format!("{strategy} at block {x0},{y0}");
            let hits = f64::from(BLOCK * BLOCK * SPP * LIGHT_SAMPLES) * expected / brightest;
            let test = ZTest { found, expected, sigma: (v + w).sqrt(), budget: BUDGET * expected };
            outcomes.push(if expected > 0.0 && hits < LEAST_HITS {
                Outcome::Skipped { why: format!("{name}: {hits:.1} hits of cosine-weighted directions are expected") }
            } else {
                Outcome::Tested { p: test.p(), evidence: format!("{name}: {test}") }
            });
        }
    }
    Family::new("blocks of images", LEVEL, SEED, outcomes).assert_holds(0.2);
}
