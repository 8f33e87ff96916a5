//! Support for the tests.

pub mod scenes;
