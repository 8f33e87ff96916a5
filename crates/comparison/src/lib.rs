//! The experiment: strategies × samplers × sample counts × replicates → rows of means, variances and rates; and images.

mod answer;
mod clock;
pub mod error;
pub mod exactly;
pub mod experiment;
pub mod image;
mod measurement;
pub mod place;
mod plan;
pub mod result;
mod rows;
pub mod statistics;
pub mod verdict;
pub mod viewpoint;
pub mod world;
