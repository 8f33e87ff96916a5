//! Equal seeds give equal bits on any number of threads; other seeds give others.

use rayon::ThreadPoolBuilder;
use twoforms_comparison::experiment::Experiment;
use twoforms_comparison::image::{Crop, Pixel, PixelFilter, Rendering, Shown};
use twoforms_comparison::place::Place;
use twoforms_comparison::verdict::Criteria;
use twoforms_estimator::estimate::Estimate;
use twoforms_estimator::estimator::Estimator;
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::{Sampler, Stream};
use twoforms_estimator::secondary::secondary_by;
use twoforms_estimator::strategy::Strategy;
use twoforms_estimator::technique::Kind;
use twoforms_estimator::xi::{Draws, Key};
use twoforms_geometry::lanes::Instructions;
use twoforms_geometry::view::{Effort, View};
use twoforms_report::{Document, Provenance};
use twoforms_tests::samples;
use twoforms_tests::worlds::{self, Stage};

const THREADS: [usize; 3] = [1, 2, 7];

fn on_threads<T: Send>(threads: usize, job: impl FnOnce() -> T + Send) -> T {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
    pool.install(job)
}

/// The hash of a comparison of everything at all receivers, on so many threads.
fn results_sha256(stage: &Stage, seed: u64, threads: usize) -> String {
    let experiment = Experiment {
        strategies: Strategy::all(),
        samplers: vec![Sampler::Independent, Sampler::Sobol],
        samples: vec![1, 5, 1000],
        replicates: 70,
        seed,
        criteria: Criteria::default(),
    };
    let places: Vec<Place> = stage.world.scene.receivers.iter().map(Place::of_receiver).collect();
    let results = on_threads(threads, || experiment.run(&stage.world, &places, &|_| ())).expect("finite samples");
    let document = Document::new(provenance(seed, threads), results).expect("finite numbers");
    document.results_sha256().to_owned()
}

/// Of no consequence to the hash, and different for every number of threads.
fn provenance(seed: u64, threads: usize) -> Provenance {
    Provenance {
        version: String::new(),
        command: format!("--threads {threads}"),
        seed: seed.to_string(),
        scene: String::new(),
        scene_sha256: String::new(),
        threads,
        started: String::new(),
        platform: String::new(),
        settings: [].into(),
    }
}

#[test]
fn a_seed_fixes_the_results_on_any_number_of_threads() {
    for name in ["cornell-box", "two-lights"] {
        let stage = worlds::stage(name);
        let [one, two, seven] = THREADS.map(|threads| results_sha256(&stage, 7, threads));
        assert_eq!((&one, &one), (&two, &seven), "{name}");
        assert_ne!(one, results_sha256(&stage, 8, 2), "{name}: seeds 7 and 8");
    }
}

/// The same estimate by each kind of instructions that the machine has.
fn by_all(estimator: &dyn Estimator, stream: Stream) -> Vec<Estimate> {
    let by = |instructions| secondary_by(estimator, instructions, stream, 0..stream.n).expect("finite samples");
    Instructions::all().into_iter().map(by).collect()
}

#[test]
fn bits_do_not_depend_on_the_instructions() {
    for case in worlds::cases(&worlds::all()) {
        let world = &case.stage.world;
        let query = Query::irradiance(&world.lights);
        let efforts = [Effort::Gather, Effort::Cast];
        let pairs = efforts.into_iter().flat_map(|effort| Strategy::all().into_iter().map(move |s| (effort, s)));
        for (effort, strategy) in pairs {
            let view = View::new(&world.geometry, case.place.frame(), effort);
            let (prepared, known) = (strategy.prepare(&world.lights), samples::known(&case, strategy));
            for n in [1, 17, 1000] {
                let draws = Draws { key: Key::new([u64::from(n)]), stream: [n, 3] };
                for &sampler in Sampler::ALL.iter().filter(|sampler| sampler.is_random()) {
                    let stream = Stream { sampler, draws, n: sampler.rounded(n) };
                    let estimates = by_all(&*prepared.at(&view, &query, &known), stream);
                    let same = estimates.windows(2).all(|pair| pair[0] == pair[1]);
                    assert!(same, "{} {strategy} {sampler} {effort:?} N = {n}: {estimates:?}", case.place.name);
                }
            }
        }
    }
}

fn pixels(stage: &Stage, strategy: Strategy, seed: u64, threads: usize) -> Vec<Pixel> {
    let (width, height) = (16, 13);
    let rendering = Rendering {
        strategy,
        sampler: Sampler::Independent,
        width,
        height,
        crop: Crop { x0: 0, x1: width, y0: 0, y1: height },
        spp: 3,
        light_samples: 2,
        filter: PixelFilter::Box,
        cull: false,
        quantity: Shown::Radiance,
        seed,
    };
    let camera = &stage.world.scene.cameras[0];
    on_threads(threads, || rendering.run(&stage.world, camera, &|_| ())).expect("finite samples")
}

#[test]
fn a_seed_fixes_the_pixels_on_any_number_of_threads() {
    let stage = worlds::stage("cornell-box");
    for strategy in Strategy::all_in_images() {
        let [one, two, seven] = THREADS.map(|threads| pixels(&stage, strategy, 7, threads));
        assert!(one == two && one == seven, "{strategy}");
        assert!(one != pixels(&stage, strategy, 8, 2), "{strategy}: seeds 7 and 8");
    }
}

/// A crop holds the very pixels of the whole image.
#[test]
fn a_crop_is_part_of_the_image() {
    let stage = worlds::stage("cornell-box");
    let camera = &stage.world.scene.cameras[0];
    let whole = Rendering {
        strategy: Strategy::from(Kind::HemisphereCosine),
        sampler: Sampler::Independent,
        width: 12,
        height: 9,
        crop: Crop { x0: 0, x1: 12, y0: 0, y1: 9 },
        spp: 2,
        light_samples: 3,
        filter: PixelFilter::Box,
        cull: false,
        quantity: Shown::Radiance,
        seed: 1,
    };
    let part = Rendering { crop: Crop { x0: 4, x1: 11, y0: 2, y1: 8 }, ..whole.clone() };
    let run = |rendering: &Rendering| rendering.run(&stage.world, camera, &|_| ()).expect("finite samples");
    let (all, some) = (run(&whole), run(&part));
    let rows = all.chunks(12).skip(2).take(6);
    assert!(rows.flat_map(|row| &row[4..11]).eq(&some));
}
