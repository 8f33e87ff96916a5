//! One module per command.

pub mod compare;
pub mod completions;
pub mod exact;
pub mod inspect;
pub mod render;
