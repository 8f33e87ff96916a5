//! `twoforms completions`: a script for a shell, on standard output.

use anyhow::Result;
use clap::CommandFactory;
use clap_complete::{Shell, generate};

use crate::args::Args;
use crate::output;

/// Prints the script.
pub fn run(shell: Shell) -> Result<()> {
    let mut script = Vec::new();
    generate(shell, &mut Args::command(), "twoforms", &mut script);
    output::print(&String::from_utf8_lossy(&script))
}
