//! What the examples share: their arguments, and the CPU time of work done again and again.

use std::error::Error;

use cpu_time::ProcessTime;

/// The command line: `WORDS` words in order, and `OPTIONS` options, each followed by a whole number from 1 on; 1 where one
/// is not given.
///
/// # Errors
/// Anything else; the message ends in `usage`.
pub fn arguments<const WORDS: usize, const OPTIONS: usize>(
    usage: &str,
    options: [&str; OPTIONS],
) -> Result<([String; WORDS], [usize; OPTIONS]), Box<dyn Error>> {
    let (mut words, mut numbers) = (Vec::new(), [1; OPTIONS]);
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        if let Some(option) = options.iter().position(|name| *name == argument) {
            let value = arguments.next().ok_or(format!("{argument} needs a number; {usage}"))?;
            numbers[option] = whole(&value, &argument)?;
        } else if argument.starts_with("--") {
            return Err(format!("there is no option {argument}; {usage}").into());
        } else {
            words.push(argument);
        }
    }
    let words = words.try_into().map_err(|_| format!("{WORDS} arguments are needed; {usage}"))?;
    Ok((words, numbers))
}

/// A whole number from 1 on.
///
/// # Errors
/// Another text; the message says that it was given for `name`.
pub fn whole<N: std::str::FromStr + PartialEq + From<u8>>(text: &str, name: &str) -> Result<N, String> {
    let number = text.parse().ok().filter(|n| *n != N::from(0));
    number.ok_or(format!("{name} is a whole number from 1 on, not {text}"))
}

/// CPU seconds of all threads together, for one round of work done several times.
pub struct Seconds {
    /// The middle one.
    pub median: f64,
    /// The least.
    pub best: f64,
}

/// Does the work `repeat` times; it is told which round it is.
///
/// # Errors
/// That of the first round that fails.
pub fn seconds<E>(repeat: usize, mut work: impl FnMut(u64) -> Result<(), E>) -> Result<Seconds, E> {
    let mut times = Vec::new();
    for round in 0..repeat as u64 {
        let start = ProcessTime::now();
        work(round)?;
        times.push(start.elapsed().as_secs_f64());
    }
    times.sort_unstable_by(f64::total_cmp);
    Ok(Seconds { median: times[repeat / 2], best: times[0] })
}
