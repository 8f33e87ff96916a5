//! Tests of hypotheses, and families of them.

mod binomial;
mod chi_square;
mod family;
mod z_test;

pub use binomial::BinomialTest;
pub use chi_square::ChiSquare;
pub use family::{Family, Outcome};
pub use z_test::ZTest;
