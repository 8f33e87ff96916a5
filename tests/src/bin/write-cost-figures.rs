//! Measures what estimates cost against samples and against triangles, and writes both as figures with their numbers:
//! `cargo run --release -p twoforms-tests --bin write-cost-figures [FOLDER]` makes `cost-against-samples.svg`,
//! `cost-against-triangles.svg` and a `.csv` of each. Without a folder, the `docs/figures/` of the repository. It takes some
//! minutes and 3.5 GB of memory; all is CPU time on one thread, medians of five rounds.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use twoforms_report::figure::{self, Axis, Figure, Line, Scale};
use twoforms_tests::costs::{Asked, Cost, Preparation, prepared};
use twoforms_tests::terrain::Terrain;
use twoforms_tests::worlds;

const AREA: &str = "area/uniform";
const HEMISPHERE: &str = "hemisphere/cosine";
/// Estimates of each kind in a round.
const REPLICATES: u32 = 200;
const BLUE: &str = "#3b82d8";
const ORANGE: &str = "#d9702a";
const GREY: &str = "#808a96";

fn main() -> ExitCode {
    let default = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/figures");
    let folder = std::env::args_os().nth(1).map_or_else(default, PathBuf::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build_global().map_err(Into::into);
    match pool.and_then(|()| against_samples(&folder)).and_then(|()| against_triangles(&folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn asked(samples: Vec<u32>, replicates: u32) -> Result<Asked, Box<dyn Error>> {
    Ok(Asked { strategies: vec![AREA.parse()?, HEMISPHERE.parse()?], samples, replicates })
}

fn colour(strategy: &str) -> &'static str {
    if strategy == AREA { BLUE } else { ORANGE }
}

/// At the lit receiver of the Cornell box, 10³ to 10⁷ samples.
fn against_samples(folder: &Path) -> Result<(), Box<dyn Error>> {
    let mut world = worlds::stage("cornell-box").world;
    world.scene.receivers.retain(|receiver| receiver.name == "floor-lit");
    let costs = asked((3..=7).map(|k| 10_u32.pow(k)).collect(), 20)?.costs(&world)?;
    let line = |strategy: &str| {
        let points = costs.iter().filter(|cost| cost.strategy == strategy);
        let points: Vec<[f64; 2]> = points.map(|cost| [cost.samples as f64, cost.seconds]).collect();
        let each = points.last().map_or(0.0, |[n, seconds]| seconds / n * 1e9);
        Line {
            name: format!("{strategy}, {each:.1} ns a sample"),
            colour: colour(strategy),
            dashed: false,
            marked: true,
            points,
        }
    };
    let figure = Figure {
        title: "Cost of an estimate against its samples, Cornell box, receiver floor-lit".to_owned(),
        across: Axis { name: "N, samples of an estimate".to_owned(), scale: Scale::Decades(figure::number) },
        up: Axis { name: "CPU time".to_owned(), scale: Scale::Decades(figure::seconds) },
        lines: vec![line(AREA), line(HEMISPHERE)],
    };
    let row = |cost: &Cost| {
        let Cost { strategy, samples, seconds, .. } = cost;
        format!("{strategy},{samples},{seconds:.3e},{:.2}\n", seconds / *samples as f64 * 1e9)
    };
    let rows: String = costs.iter().map(row).collect();
    let head = "strategy,samples,cpu seconds an estimate,cpu nanoseconds a sample\n";
    write(folder, "cost-against-samples", &figure, &(head.to_owned() + &rows))
}

/// A terrain as it was measured.
struct Measured {
    triangles: u64,
    preparation: Preparation,
    costs: Vec<Cost>,
}

/// Over terrains of 10³ to 10⁷ triangles, 1024 samples an estimate.
fn against_triangles(folder: &Path) -> Result<(), Box<dyn Error>> {
    let measured = (3..=7).map(|k| measured(10_u32.pow(k))).collect::<Result<Vec<_>, _>>()?;
    let kinds = measured[0].costs.len();
    let cost = |k: usize| {
        let Cost { receiver, strategy, .. } = &measured[0].costs[k];
        let points = measured.iter().map(|terrain| [terrain.triangles as f64, 1.0 / rate(&terrain.costs[k])]);
        let receiver = receiver.trim_start_matches("receiver-");
        let name = format!("10⁶ samples, {strategy}, {receiver}");
        Line { name, colour: colour(strategy), dashed: receiver == "hidden", marked: true, points: points.collect() }
    };
    let preparation = measured.iter().map(|terrain| [terrain.triangles as f64, terrain.preparation.seconds]).collect();
    let before =
        Line { name: "all but samples".to_owned(), colour: GREY, dashed: false, marked: true, points: preparation };
    let figure = Figure {
        title: "Cost against triangles, terrains under one light".to_owned(),
        across: Axis { name: "triangles".to_owned(), scale: Scale::Decades(figure::number) },
        up: Axis { name: "CPU time".to_owned(), scale: Scale::Decades(figure::seconds) },
        lines: (0..kinds).map(cost).chain([before]).collect(),
    };
    let column = |cost: &Cost| format!(",{} {}: million samples a cpu second", cost.receiver, cost.strategy);
    let columns: String = measured[0].costs.iter().map(column).collect();
    let head = format!("triangles,all but samples: cpu seconds,peak memory: bytes{columns}\n");
    write(folder, "cost-against-triangles", &figure, &(head + &measured.iter().map(row).collect::<String>()))
}

fn measured(triangles: u32) -> Result<Measured, Box<dyn Error>> {
    let (terrain, asked) = (Terrain::of(triangles), asked(vec![1024], REPLICATES)?);
    let path = std::env::temp_dir().join(format!("twoforms-terrain-{triangles}.glb"));
    std::fs::write(&path, terrain.to_glb())?;
    let prepared = prepared(&path, &asked);
    std::fs::remove_file(&path)?;
    let (world, preparation) = prepared?;
    Ok(Measured { triangles: terrain.triangle_count(), preparation, costs: asked.costs(&world)? })
}

/// Million samples a CPU second.
fn rate(cost: &Cost) -> f64 {
    cost.samples as f64 / cost.seconds * 1e-6
}

fn row(terrain: &Measured) -> String {
    let Measured { triangles, preparation: Preparation { seconds, peak_memory }, costs } = terrain;
    let memory = peak_memory.map_or(String::new(), |bytes| bytes.to_string());
    let rates: Vec<String> = costs.iter().map(|cost| format!("{:.1}", rate(cost))).collect();
    format!("{triangles},{seconds:.4},{memory},{}\n", rates.join(","))
}

fn write(folder: &Path, name: &str, figure: &Figure, numbers: &str) -> Result<(), Box<dyn Error>> {
    for (end, text) in [("svg", &*figure.to_svg()), ("csv", numbers)] {
        let path = folder.join(name).with_extension(end);
        let shown = path.display().to_string();
        std::fs::write(&path, text)
            .map_err(|error| format!("cannot write {shown}: {error}; name a folder that is there"))?;
        println!("{shown}");
    }
    Ok(())
}
