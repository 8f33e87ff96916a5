//! Support for the tests.

pub mod built;
pub mod costs;
pub mod densities;
pub mod domain;
pub mod ggx;
pub mod samples;
pub mod scenes;
pub mod statistics;
pub mod terrain;
pub mod worlds;
