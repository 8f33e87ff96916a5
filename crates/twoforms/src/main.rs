//! twoforms compares the two forms of the rendering equation for direct light: over directions, and over the points of
//! the lights. This is its command line, and the only place that chooses exit codes.

mod args;
mod command;
mod output;
mod places;
mod progress;
mod run;

use std::process::ExitCode;

use clap::Parser;

use args::{Args, Command};

/// 0: done · 1: the input or the run failed · 2: wrong usage (chosen by clap) · 3: a check found a biased estimator.
fn main() -> ExitCode {
    let args = Args::parse();
    let done = match &args.command {
        Command::Compare(compare) => command::compare::run(compare),
        Command::Render(render) => command::render::run(render),
        Command::Inspect(inspect) => command::inspect::run(inspect),
        Command::Completions { shell } => command::completions::run(*shell),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if output::reader_left(&error) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("twoforms: {error:#}");
            ExitCode::from(1)
        }
    }
}
