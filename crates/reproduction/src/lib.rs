//! Published results of Monte Carlo integration and direct light, computed again.
//!
//! A reproduction is a file ([`schema`]): experiments with a subject (a die, an integral, the light in a scene) and rows that say
//! what a source prints or a derivation gives. [`run`] works it out: without chance, by chance with an interval, and a verdict.
//! The same file with a user's own scene is an experiment of theirs.

pub mod catalogue;
pub mod crossing;
pub mod either;
pub mod formula;
pub mod idle;
pub mod lighting;
mod limits;
pub mod nested;
pub mod outcome;
pub mod overrides;
pub mod plot;
pub mod printed;
pub mod reading;
pub mod reproduction;
pub mod schema;
pub mod stage;
pub mod toolkit;
pub mod variable;

pub use outcome::{Row, Verdict};
pub use plot::Plot;
pub use reading::{Error, Text};
pub use reproduction::{Hears, Reproduction, Section, Settings, run};
