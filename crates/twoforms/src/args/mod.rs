//! The command line's words.

mod camera;
mod list;
mod receivers;

use std::path::PathBuf;

use clap::{ArgAction, Args as ClapArgs, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use twoforms_estimator::sampler::Sampler;

pub use camera::{CameraArgs, ImageSize};
pub use list::{SamplerList, StrategyList};
pub use receivers::{At, Pair, ReceiverArgs, point};

/// Compares the two forms of the rendering equation for direct light.
///
/// The light that a point x receives from area lights can be written as an integral over directions, where a ray finds
/// y = vp(x, Ψ), or over the points y of the lights, where V(x, y) says whether they see each other. Both give the same
/// number; as Monte Carlo estimators they differ in variance. twoforms measures by how much.
#[derive(Debug, Parser)]
#[command(name = "twoforms", version, max_term_width = 110)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Variance per sample count, by both formulations, beside the known value
    Compare(CompareArgs),
    /// An image by one strategy, to EXR with a PNG preview beside it
    Render(RenderArgs),
    /// Lights, triangles, cameras, receivers and warnings of a scene
    Inspect(InspectArgs),
    /// Prints a completion script for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
}

/// What every command that computes takes.
#[derive(Debug, ClapArgs)]
pub struct RunArgs {
    /// Seed: equal seeds give equal results, on any number of threads
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// Threads [default: one per core]
    #[arg(short, long, alias = "nthreads", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// No progress and no warnings
    #[arg(short, long)]
    pub quiet: bool,
    /// Say more on standard error
    #[arg(short, long, action = ArgAction::Count)]
    pub verbose: u8,
}

/// What the light is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum QuantityArg {
    /// ∫ L_e cosθ dω: f_r = 1
    Irradiance,
    /// Toward the eye, from a Lambertian surface, with its own emission
    Radiance,
}

/// How results are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For people
    Table,
    /// For scripts: one document
    Json,
    /// For scripts: one line per receiver, strategy, sampler and N
    Csv,
}

/// `compare`.
#[derive(Debug, ClapArgs)]
#[command(after_help = COMPARE_EXAMPLES)]
pub struct CompareArgs {
    /// A glTF scene (.gltf or .glb)
    pub scene: PathBuf,
    /// Strategies, formulation/density[@selection], separated by commas
    #[arg(long, alias = "strategy", default_value_t = StrategyList::default(), value_name = "LIST")]
    pub strategies: StrategyList,
    /// Samplers, separated by commas
    #[arg(long, alias = "samplers", default_value_t = SamplerList(vec![Sampler::Independent]), value_name = "LIST")]
    pub sampler: SamplerList,
    /// Sample counts N, separated by commas
    #[arg(
        long, value_delimiter = ',', default_value = "1,4,16,64,256,1024", value_name = "N,N,…",
        value_parser = clap::value_parser!(u32).range(1..)
    )]
    pub samples: Vec<u32>,
    /// Independent replicates of each estimate, over which variances are measured
    #[arg(long, default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..))]
    pub replicates: u32,
    /// What is asked of the light
    #[arg(long, value_enum, default_value_t = QuantityArg::Irradiance)]
    pub quantity: QuantityArg,
    /// Where the light is measured.
    #[command(flatten)]
    pub receivers: ReceiverArgs,
    /// The camera for receivers given by pixels.
    #[command(flatten)]
    pub camera: CameraArgs,
    /// How to run.
    #[command(flatten)]
    pub run: RunArgs,
    /// How to print results on standard output
    #[arg(long, value_enum, default_value_t = Format::Table)]
    pub format: Format,
    /// Write what would be printed to this file instead
    #[arg(short, long, alias = "outfile", value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Also write compare.json and compare.csv into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

const COMPARE_EXAMPLES: &str = "\
Examples:
  twoforms compare scenes/cornell-box.gltf
  twoforms compare scenes/two-lights.gltf --strategies area/uniform,area/uniform@power --samples 16
  twoforms compare scenes/cornell-box.gltf --at 0.2,0,0.1,0,1,0 --format json
  twoforms compare room.glb --camera auto --grid 16,16 --out results";

/// `render`.
#[derive(Debug, ClapArgs)]
#[command(after_help = RENDER_EXAMPLES)]
pub struct RenderArgs {
    /// A glTF scene (.gltf or .glb)
    pub scene: PathBuf,
    /// The strategy for direct light
    #[arg(long, alias = "strategies", default_value = "area/uniform", value_name = "NAME")]
    pub strategy: twoforms_estimator::strategy::Strategy,
    /// The sampler of light samples
    #[arg(long, alias = "samplers", default_value = "independent", value_name = "NAME")]
    pub sampler: Sampler,
    /// Camera samples per pixel
    #[arg(long, alias = "samples", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..))]
    pub spp: u32,
    /// Light samples per camera sample
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub light_samples: u32,
    /// Part of the image to render, as fractions from the top left
    #[arg(long, alias = "cropwindow", value_name = "X0,X1,Y0,Y1", value_parser = camera::crop)]
    pub crop: Option<camera::CropWindow>,
    /// Where in a pixel its camera samples lie
    #[arg(long, value_enum, default_value_t = FilterArg::Box)]
    pub pixel_filter: FilterArg,
    /// What is asked of the light
    #[arg(long, value_enum, default_value_t = QuantityArg::Radiance)]
    pub quantity: QuantityArg,
    /// Single-sided surfaces seen from behind are black
    #[arg(long)]
    pub cull: bool,
    /// The camera.
    #[command(flatten)]
    pub camera: CameraArgs,
    /// How to run.
    #[command(flatten)]
    pub run: RunArgs,
    /// The EXR file; a PNG preview of the same name goes beside it [default: the scene's name in this folder]
    #[arg(short, long, alias = "outfile", value_name = "FILE")]
    pub output: Option<PathBuf>,
}

const RENDER_EXAMPLES: &str = "\
Examples:
  twoforms render scenes/cornell-box.gltf -o cornell.exr
  twoforms render scenes/cornell-box.gltf --strategy hemisphere/cosine --spp 256 --width 256 --height 256
  twoforms render room.glb --view 3,2,5,0,1,0,40 --spp 16 --light-samples 16";

/// Where in a pixel its camera samples lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FilterArg {
    /// Uniform over the pixel
    Box,
    /// At its centre
    Point,
}

/// `inspect`.
#[derive(Debug, ClapArgs)]
pub struct InspectArgs {
    /// A glTF scene (.gltf or .glb)
    pub scene: PathBuf,
    /// Print one JSON document instead of text
    #[arg(long, value_enum, default_value_t = InspectFormat::Table)]
    pub format: InspectFormat,
}

/// How `inspect` prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum InspectFormat {
    /// For people
    Table,
    /// For scripts
    Json,
}
