//! twoforms compares the two forms of the rendering equation for direct light: over directions, and over the points of
//! the lights. This is its command line, and the only place that chooses exit codes.

mod args;
mod command;
mod output;
mod progress;
mod run;

use std::process::ExitCode;

use clap::CommandFactory;
use clap::error::ErrorKind;

use args::{Args, Command};
use command::compare::Found;

/// 0: done · 1: the input or the run failed · 2: wrong usage, as clap has it · 3: a check found a biased estimator, or a reproduction that differs.
fn main() -> ExitCode {
    let (args, said) = Args::read();
    if let Some((command, why)) = args.command.misuse() {
        misused(command, why);
    }
    let nothing = |()| Found::Nothing;
    let done = match &args.command {
        Command::Compare(compare) => command::compare::run(compare, &said),
        Command::Exact(exact) => command::exact::run(exact).map(nothing),
        Command::Render(render) => command::render::run(render).map(nothing),
        Command::Reproduce(reproduce) => command::reproduce::list_or_run(reproduce),
        Command::Inspect(inspect) => command::inspect::run(inspect).map(nothing),
        Command::Completions { shell } => command::completions::run(*shell).map(nothing).map_err(Into::into),
    };
    match done {
        Ok(Found::Nothing) => ExitCode::SUCCESS,
        Ok(Found::Fault) => ExitCode::from(3),
        Err(error) if output::reader_left(&error) => ExitCode::SUCCESS,
        Err(error) => {
            output::say(&format!("twoforms: {error:#}"));
            ExitCode::from(1)
        }
    }
}

/// Ends the program as a wrong word does.
fn misused(command: &str, why: &str) -> ! {
    let mut all = Args::command();
    all.build();
    let named = all.find_subcommand(command).cloned();
    named.unwrap_or(all).error(ErrorKind::ArgumentConflict, why).exit()
}
