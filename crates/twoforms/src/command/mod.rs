//! One module per command.

pub mod compare;
pub mod completions;
pub mod exact;
pub mod experiment;
pub mod inspect;
pub mod render;
pub mod reproduce;
