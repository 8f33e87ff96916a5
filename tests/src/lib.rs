//! Support for the tests.

pub mod densities;
pub mod domain;
pub mod samples;
pub mod scenes;
pub mod statistics;
pub mod worlds;
