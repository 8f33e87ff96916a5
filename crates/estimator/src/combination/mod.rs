//! Combinations: estimators made of several techniques, or of one technique and what is known of the light unhidden.

mod alpha;
mod control;
mod mis;
mod mixture;
mod resampled;

pub use alpha::alpha;
pub(crate) use control::{ControlVariate, Ratio, Shadow};
pub(crate) use mis::Mis;
pub(crate) use mixture::{Mixture, Split};
pub(crate) use resampled::Resampled;
