//! The number by chance: measures and densities, the two formulations side by side, the catalogue of strategies,
//! samplers, moments.
//!
//! Three files hold the subject: [`measure`], and the mirror images `formulation/hemisphere.rs` and
//! `formulation/area.rs`. A formulation and a density never see each other; the measure is all that they share.

mod alone;
pub mod batch;
pub mod cells;
pub mod combination;
pub mod compensation;
pub mod density;
pub mod estimate;
pub mod estimator;
pub mod formulation;
pub mod gauss;
pub mod glossy;
pub mod lights;
pub mod measure;
pub mod moments;
pub mod nearest;
pub mod numbers;
mod philox;
pub mod query;
pub mod rgb;
pub mod sampler;
pub mod secondary;
pub mod selection;
pub mod strategy;
pub mod technique;
pub mod tree;
pub mod xi;
