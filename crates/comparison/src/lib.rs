//! The experiment: strategies × samplers × sample counts × replicates → rows of means, variances and rates; and images.

mod answer;
mod clock;
mod crossing;
pub mod error;
mod exact_result;
pub mod exactly;
pub mod experiment;
pub mod image;
mod measurement;
mod motion;
pub mod on_light;
pub mod place;
pub mod places;
mod plan;
pub mod points;
pub mod request;
pub mod result;
mod rows;
pub mod statistics;
pub mod sweep;
pub mod sweep_text;
pub mod swept;
pub mod verdict;
pub mod viewpoint;
pub mod world;
