//! Exact light against answers found elsewhere, by other means.

#![allow(clippy::doc_markdown, reason = "formulas stand in plain text")]

mod chance;
mod crossings;
mod degenerate;
mod file;
mod known;
mod strata;
mod stress;
mod support;
mod symmetry;
mod view_factors;
mod weights;
