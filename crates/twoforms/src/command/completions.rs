//! `twoforms completions`: a script for a shell, on standard output.

use clap::CommandFactory;
use clap_complete::{Shell, generate};
use twoforms_report::ReportError;

use crate::args::Args;
use crate::output;

/// Prints the script.
pub fn run(shell: Shell) -> Result<(), ReportError> {
    let mut script = Vec::new();
    generate(shell, &mut Args::command(), "twoforms", &mut script);
    output::print(&String::from_utf8_lossy(&script))
}
