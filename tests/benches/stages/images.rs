//! A tile of an image, per light sample.

use criterion::{Criterion, Throughput};
use twoforms_comparison::image::{Crop, PixelFilter, Rendering, Shown};
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::Kind;
use twoforms_tests::worlds;

use crate::SCENE;
use crate::clock::CpuTime;

/// Side of the image, in pixels.
const SIDE: u32 = 512;

/// Tiles of 32 × 32 pixels on the lit floor and at the edge of a block's shadow.
const TILES: [(&str, [u32; 2]); 2] = [("floor", [224, 448]), ("shadow", [160, 416])];

/// Many camera samples with one light sample each, and few with many.
pub fn benches(criterion: &mut Criterion<CpuTime>) {
    let world = worlds::stage(SCENE).world;
    let strategies = [Strategy::from(Kind::AreaUniform), Strategy::from(Kind::HemisphereCosine)];
    let mut group = criterion.benchmark_group("image");
    for strategy in strategies {
        for (name, corner) in TILES {
            for (spp, light_samples) in [(64, 1), (4, 16)] {
                let rendering = rendering(strategy, corner, spp, light_samples);
                let pixels = rendering.crop.width() * rendering.crop.height();
                group.throughput(Throughput::Elements(u64::from(pixels * spp * light_samples)));
                group.bench_function(format!("{strategy}, {name}, {spp} x {light_samples}"), |bencher| {
                    bencher.iter(|| rendering.run(&world, &world.scene.cameras[0], &|_| ()).expect("finite samples"));
                });
            }
        }
    }
    group.finish();
}

fn rendering(strategy: Strategy, [x0, y0]: [u32; 2], spp: u32, light_samples: u32) -> Rendering {
    Rendering {
        strategy,
        sampler: Sampler::Independent,
        width: SIDE,
        height: SIDE,
        crop: Crop { x0, x1: x0 + 32, y0, y1: y0 + 32 },
        spp,
        light_samples,
        filter: PixelFilter::Box,
        cull: false,
        quantity: Shown::Radiance,
        seed: 0,
    }
}
