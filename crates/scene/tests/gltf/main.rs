//! Small glTF files, right and wrong, and what becomes of them.

mod lights;
mod reading;
mod receivers;
mod refusals;
mod support;
