//! Rows and images to files and tables.
//!
//! | what | module | for |
//! |---|---|---|
//! | a comparison with its provenance and its hash | [`document`] | everything below |
//! | pretty JSON, schema `twoforms.compare/1` | [`json`] | scripts |
//! | one CSV line per receiver, strategy, sampler and N | [`csv`] | notebooks |
//! | tables, rates, verdicts and the sentence to remember | [`table`], [`summary`] | people |
//! | binary32 EXR, 8-bit sRGB preview | [`exr`], [`png`] | viewers |
//!
//! A number that is not finite is an error everywhere: it never becomes a `null`, an empty cell or a black pixel.

pub mod csv;
pub mod document;
pub mod error;
pub mod exact;
pub mod exr;
pub mod figure;
pub mod file;
pub mod image;
pub mod json;
pub mod png;
pub mod provenance;
pub mod reproduction;
pub mod summary;
pub mod table;

mod attributes;
mod bias;
mod cells;
mod finite;
mod layout;
mod number;
mod ranking;
mod rates;
mod sweep;

pub use document::Document;
pub use error::ReportError;
pub use exact::ExactDocument;
pub use image::{Channel, Image};
pub use provenance::{Provenance, Setting};
pub use reproduction::ReproductionDocument;
pub use table::Detail;
