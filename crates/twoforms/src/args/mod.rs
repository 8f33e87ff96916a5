//! The command line's words.

mod camera;
mod help;
mod list;
mod receivers;
mod whole;

use std::path::PathBuf;

use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::parser::ValueSource;
use clap::{ArgAction, Args as ClapArgs, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use twoforms_comparison::experiment::{DEFAULT_REPLICATES, DEFAULT_SAMPLES};
use twoforms_comparison::request::{self, Asked, Idle, Request};
use twoforms_comparison::sweep::Sweep;
use twoforms_comparison::verdict::Criteria;
use twoforms_estimator::sampler::Sampler;

pub use camera::CameraArgs;
pub use list::{SamplerList, StrategyList};
pub use receivers::ReceiverArgs;

use whole::between;

/// Compares the two forms of the rendering equation for direct light.
///
/// The light that a point x receives from area lights can be written as an integral over directions, where a ray finds
/// y = vp(x, Ψ), or over the points y of the lights, where V(x, y) says whether they see each other. Both give the same
/// number; as Monte Carlo estimators they differ in variance. twoforms measures by how much.
#[derive(Debug, Parser)]
#[command(name = "twoforms", version, max_term_width = 110, after_help = help::ALL)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

impl Args {
    /// The command line, and the options that it names for its command; a wrong one ends the program with code 2.
    pub fn read() -> (Self, Vec<String>) {
        let mut command = Self::command();
        let matches = command.get_matches_mut();
        let said = matches.subcommand().and_then(|(name, options)| {
            let known = command.find_subcommand(name)?.get_arguments().map(|argument| argument.get_id().as_str());
            let said = known.filter(|id| options.value_source(id) == Some(ValueSource::CommandLine));
            Some(said.map(str::to_owned).collect())
        });
        let said = said.unwrap_or_default();
        (Self::from_arg_matches(&matches).unwrap_or_else(|error| error.exit()), said)
    }
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Variance per sample count, by both formulations, beside the known value
    Compare(CompareArgs),
    /// Irradiance and the variance of every strategy, with no randomness at all
    Exact(ExactArgs),
    /// An image by one strategy, to EXR with a PNG preview beside it
    Render(RenderArgs),
    /// Published results, ours beside theirs
    #[command(after_help = help::REPRODUCE)]
    Reproduce(ReproduceArgs),
    /// Lights, triangles, cameras, receivers and warnings of a scene
    Inspect(InspectArgs),
    /// Prints a completion script for a shell
    #[command(after_help = help::COMPLETIONS)]
    Completions {
        /// The shell
        shell: Shell,
    },
}

/// What every command that computes takes.
#[derive(Clone, Debug, ClapArgs)]
#[command(next_help_heading = "Run")]
pub struct RunArgs {
    /// Seed: equal seeds give equal results, on any number of threads [default: 0]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = between::<u64>(0, u64::MAX))]
    pub seed: Option<u64>,
    /// Threads [default: one per core]
    #[arg(
        short, long, alias = "nthreads", value_name = "N", allow_negative_numbers = true,
        value_parser = between::<u16>(1, 1024)
    )]
    pub threads: Option<u16>,
    /// No progress, no warnings, no notes
    #[arg(short, long)]
    pub quiet: bool,
    /// Say more on standard error
    #[arg(short, long, action = ArgAction::Count, conflicts_with = "quiet")]
    pub verbose: u8,
}

/// What `--seed` is where a file may say another.
const SEED_OF_FILE: &str =
    "Seed: equal seeds give equal results, on any number of threads [default: the file's, if one is run, else 0]";

impl RunArgs {
    /// The seed where no file says one.
    pub fn seed(&self) -> u64 {
        self.seed.unwrap_or(0)
    }
}

/// What the light is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum QuantityArg {
    /// ∫ L_e cosθ dω: f_r = 1
    Irradiance,
    /// ∫ L_e f_r cosθ dω toward the camera, with the surface's own emission
    Radiance,
}

impl From<QuantityArg> for Asked {
    fn from(quantity: QuantityArg) -> Self {
        match quantity {
            QuantityArg::Irradiance => Self::Irradiance,
            QuantityArg::Radiance => Self::Radiance,
        }
    }
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

/// Where the light is measured, and what is asked of it.
#[derive(Clone, Debug, ClapArgs)]
pub struct PlacesArgs {
    /// What is asked of the light
    #[arg(long, value_enum, default_value_t = QuantityArg::Irradiance)]
    pub quantity: QuantityArg,
    /// Radiance without highlights: every surface reflects diffusely, by its albedo (a metal's is black)
    #[arg(long)]
    pub lambert: bool,
    /// The receivers.
    #[command(flatten)]
    pub receivers: ReceiverArgs,
    /// The camera for receivers given by pixels, and for radiance toward it.
    #[command(flatten)]
    pub camera: CameraArgs,
}

impl PlacesArgs {
    /// Why some of it means nothing beside the rest, if that is so.
    pub fn misuse(&self) -> Option<&'static str> {
        Some(match self.but_points().idle()? {
            Idle::Albedo => "--albedo is for --quantity radiance: irradiance does not depend on a surface",
            Idle::Lambert => "--lambert is for --quantity radiance: irradiance does not depend on a surface",
            Idle::Size => {
                "--width and --height are of the image that --pixel and --grid look through: pass one of these (without \
                 receivers --grid 8,8 is what is taken)"
            }
            Idle::Camera => "--view is a camera by itself: leave out --view or --camera",
        })
    }

    /// What they ask for.
    ///
    /// # Errors
    /// Where a file of receivers cannot be read.
    pub fn request(&self) -> Result<Request, String> {
        Ok(Request { points: self.receivers.points()?, ..self.but_points() })
    }

    /// The same without points, which may be in files.
    fn but_points(&self) -> Request {
        let receivers = &self.receivers;
        Request {
            asked: self.quantity.into(),
            lambert: self.lambert,
            points: Vec::new(),
            receivers: receivers.receiver.clone(),
            pixels: receivers.pixel.iter().map(|pixel| pixel.0).collect(),
            grid: receivers.grid,
            albedo: receivers.albedo,
            camera: self.camera.choice(),
        }
    }
}

impl Command {
    /// The command's word, and why options of it mean nothing together, if that is so.
    pub fn misuse(&self) -> Option<(&'static str, &'static str)> {
        match self {
            Self::Compare(args) if !args.is_file() => Some(("compare", args.places.misuse()?)),
            Self::Exact(args) => Some(("exact", args.places.misuse()?)),
            _ => None,
        }
    }
}

/// When a bias is found.
#[derive(Clone, Debug, ClapArgs)]
#[command(next_help_heading = "Verdicts")]
pub struct CriteriaArgs {
    /// Chance of any false alarm in a run
    #[arg(long, default_value_t = Criteria::default().level, value_name = "P", allow_negative_numbers = true, value_parser = share)]
    pub level: f64,
    /// The bias that still counts as none, as a share of the exact value
    #[arg(
        long, default_value_t = Criteria::default().margin, value_name = "SHARE", allow_negative_numbers = true,
        value_parser = share
    )]
    pub margin: f64,
    /// Exit with 3 if an estimator is found to be biased
    #[arg(long)]
    pub check: bool,
}

fn share(text: &str) -> Result<f64, String> {
    request::share(text.parse().unwrap_or(f64::NAN)).map_err(str::to_owned)
}

/// How results are printed, and where.
#[derive(Clone, Debug, ClapArgs)]
#[command(next_help_heading = "Output")]
pub struct PrintArgs {
    /// How to print results on standard output
    #[arg(long, value_enum, default_value_t = Format::Table)]
    pub format: Format,
    /// Write what would be printed to this file instead
    #[arg(short, long, alias = "outfile", value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// `exact`.
#[derive(Debug, ClapArgs)]
#[command(after_help = help::EXACT)]
pub struct ExactArgs {
    /// A glTF scene (.gltf or .glb)
    pub scene: PathBuf,
    /// Strategies, separated by commas [default: all with an exact variance]
    #[arg(long, alias = "strategy", value_name = "LIST")]
    pub strategies: Option<StrategyList>,
    /// Move receivers or lights in steps, and find where two variances are equal: receiver.x|y|z|normal and light.x|y|z are
    /// offsets in metres, light.scale is about each light's centroid [strategies by default: the basic ones]
    #[arg(long, value_name = "PARAM=FROM:TO[:log]:STEPS")]
    pub sweep: Option<Sweep>,
    /// Where, and what is asked there.
    #[command(flatten)]
    pub places: PlacesArgs,
    /// How to run.
    #[command(flatten)]
    pub run: RunArgs,
    /// How to print.
    #[command(flatten)]
    pub print: PrintArgs,
    /// Also write exact.json and exact.csv into this folder
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    pub out: Option<PathBuf>,
}

/// `compare`.
#[derive(Clone, Debug, ClapArgs)]
#[command(after_help = help::COMPARE, after_long_help = help::with_strategies(help::COMPARE))]
#[command(mut_arg("seed", |seed| seed.help(SEED_OF_FILE)))]
pub struct CompareArgs {
    /// A glTF scene (.gltf or .glb), or a file with an experiment (.toml)
    pub scene: PathBuf,
    /// Set a field of the experiment's file
    #[arg(short = 'D', value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Strategies by name, separated by commas
    #[arg(long, alias = "strategy", default_value_t = StrategyList::default(), value_name = "LIST")]
    pub strategies: StrategyList,
    /// Samplers, separated by commas
    #[arg(long, alias = "samplers", default_value_t = SamplerList(vec![Sampler::Independent]), value_name = "LIST")]
    pub sampler: SamplerList,
    /// Sample counts N, separated by commas
    #[arg(
        long, value_delimiter = ',', default_values_t = DEFAULT_SAMPLES, value_name = "N,N,…",
        allow_negative_numbers = true, value_parser = between::<u32>(1, u64::from(u32::MAX))
    )]
    pub samples: Vec<u32>,
    /// Independent replicates of each estimate, over which variances are measured
    #[arg(
        long, default_value_t = DEFAULT_REPLICATES, value_name = "R", allow_negative_numbers = true,
        value_parser = between::<u32>(1, u64::from(u32::MAX))
    )]
    pub replicates: u32,
    /// Where, and what is asked there.
    #[command(flatten)]
    pub places: PlacesArgs,
    /// When a bias is found.
    #[command(flatten)]
    pub criteria: CriteriaArgs,
    /// How to run.
    #[command(flatten)]
    pub run: RunArgs,
    /// How to print.
    #[command(flatten)]
    pub print: PrintArgs,
    /// Also write compare.json, compare.csv and, where an experiment's file was run, that file into this folder
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    pub out: Option<PathBuf>,
}

impl CompareArgs {
    /// Whether an experiment's file is named instead of a scene.
    pub fn is_file(&self) -> bool {
        self.scene.extension().is_some_and(|extension| extension == "toml")
    }
}

/// `reproduce`.
#[derive(Debug, ClapArgs)]
#[command(mut_arg("seed", |seed| seed.help(SEED_OF_FILE)))]
pub struct ReproduceArgs {
    /// Reproductions by name, or files of experiments (.toml) [default: list them]
    #[arg(value_name = "NAME|FILE.toml")]
    pub what: Vec<String>,
    /// All of them
    #[arg(long, conflicts_with = "what")]
    pub all: bool,
    /// A tenth of the replicates; rows then notice only three times as large a change
    #[arg(long)]
    pub quick: bool,
    /// Set a field of the file, in all of its experiments or, as experiment.2.KEY, in one, or experiment.2.row.1.KEY
    #[arg(short = 'D', value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Exit with 3 if a row differs from what is published, derived or exact
    #[arg(long)]
    pub check: bool,
    /// How to run.
    #[command(flatten)]
    pub run: RunArgs,
    /// How to print.
    #[command(flatten)]
    pub print: PrintArgs,
    /// Also write reproduce.json, reproduce.csv, the figures (SVG) and the files that were run into this folder
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    pub out: Option<PathBuf>,
}

/// `render`.
#[derive(Debug, ClapArgs)]
#[command(after_help = help::RENDER, after_long_help = help::with_strategies(help::RENDER))]
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
    #[arg(
        long, alias = "samples", default_value_t = 64, value_name = "N", allow_negative_numbers = true,
        value_parser = between::<u32>(1, MOST_IN_EXR)
    )]
    pub spp: u32,
    /// Light samples per camera sample
    #[arg(
        long, default_value_t = 1, value_name = "N", allow_negative_numbers = true,
        value_parser = between::<u32>(1, u64::from(u32::MAX))
    )]
    pub light_samples: u32,
    /// Part of the image to render, as fractions from the top left
    #[arg(long, alias = "cropwindow", value_name = "X0,X1,Y0,Y1", allow_hyphen_values = true, value_parser = camera::crop)]
    pub crop: Option<camera::CropWindow>,
    /// Where in a pixel its camera samples lie
    #[arg(long, value_enum, default_value_t = FilterArg::Box, value_name = "FILTER")]
    pub pixel_filter: FilterArg,
    /// What is asked of the light
    #[arg(long, value_enum, default_value_t = QuantityArg::Radiance)]
    pub quantity: QuantityArg,
    /// No highlights: every surface reflects diffusely, by its albedo (a metal's is black)
    #[arg(long)]
    pub lambert: bool,
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
    #[arg(
        short, long, alias = "outfile", value_name = "FILE", help_heading = "Output",
        value_parser = PathBufValueParser::new().try_map(exr_file)
    )]
    pub output: Option<PathBuf>,
}

/// The largest number that an attribute of an EXR file holds.
const MOST_IN_EXR: u64 = i32::MAX as u64;

/// The path of an EXR file.
fn exr_file(path: PathBuf) -> Result<PathBuf, &'static str> {
    let is_exr = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("exr"));
    if is_exr { Ok(path) } else { Err("needs a name that ends in .exr; a PNG preview goes beside it by itself") }
}

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
#[command(after_help = help::INSPECT)]
pub struct InspectArgs {
    /// A glTF scene (.gltf or .glb)
    pub scene: PathBuf,
    /// How to print it on standard output
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
