//! CPU time.

use cpu_time::ThreadTime;

/// Does something and says how many CPU seconds of this thread it took.
pub(crate) fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = ThreadTime::now();
    let done = work();
    (done, start.elapsed().as_secs_f64())
}
