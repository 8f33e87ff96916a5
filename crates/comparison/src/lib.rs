//! The experiment. Skeleton.

pub mod result;
