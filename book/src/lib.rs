//! What makes a book of `docs`: formulas are turned into MathML ahead of time, so that a browser needs no scripts for them, and
//! links are held to what they lead to.

pub mod formulas;
pub mod html;
pub mod markdown;
pub mod preprocessor;
