//! Progress on standard error, to a terminal only.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::args::RunArgs;

/// A bar that counts to `total` of `what`; silent when quiet or when standard error is no terminal.
pub fn bar(total: u64, what: &'static str, run: &RunArgs) -> ProgressBar {
    let target = if run.quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(10) };
    let bar = ProgressBar::with_draw_target(Some(total), target);
    let template = "{elapsed:>4} {wide_bar} {percent:>3} % of {human_len} {msg}, {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.set_message(what);
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
