//! Help that teaches, and completions.

use crate::support::{has_all, run, twoforms};

#[test]
fn the_help_of_every_command_shows_an_example() {
    for command in ["compare", "exact", "render", "inspect", "completions"] {
        for option in ["--help", "-h"] {
            let help = run([command, option]).printed();
            has_all(&help, &["Usage:", "Examples:", &format!("twoforms {command} ")]);
        }
    }
    has_all(&twoforms("--help").printed(), &["vp(x, Ψ)", "V(x, y)", "Examples:", "twoforms compare"]);
}

#[test]
fn options_stand_under_their_headings() {
    let help = twoforms("compare -h").printed();
    let headings = ["Options:", "Receivers:", "Camera:", "Run:", "Output:", "Examples:"];
    let places: Vec<usize> = headings.iter().map(|heading| help.find(heading).expect("a heading")).collect();
    assert!(places.is_sorted(), "{help}");
    let of_run = &help[places[3]..places[4]];
    has_all(of_run, &["--seed", "--threads", "--quiet", "--verbose"]);
    has_all(&help[places[4]..places[5]], &["--format", "--output", "--out "]);
}

#[test]
fn the_long_help_lists_the_strategies() {
    for command in ["compare", "render"] {
        let help = run([command, "--help"]).printed();
        has_all(&help, &["formulation/density[@selection]", "  hemisphere/cosine\n", "  area/uniform@power\n"]);
    }
}

#[test]
fn the_version_is_that_of_the_package() {
    assert_eq!(twoforms("--version").printed(), format!("twoforms {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn every_shell_has_its_completions() {
    for (shell, begins) in [
        ("bash", "_twoforms()"),
        ("zsh", "#compdef twoforms"),
        ("fish", "complete -c twoforms"),
        ("elvish", "edit:completion:arg-completer[twoforms]"),
        ("powershell", "Register-ArgumentCompleter"),
    ] {
        let script = run(["completions", shell]).printed();
        has_all(&script, &[begins, "compare", "strategies"]);
    }
}
