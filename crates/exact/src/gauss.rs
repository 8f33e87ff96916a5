//! Gauss–Legendre rules.

use std::sync::LazyLock;

pub use twoforms_estimator::gauss::{Rule, legendre};

/// 3 nodes, for error bounds.
pub static FEW: LazyLock<Rule> = LazyLock::new(|| legendre(3));

/// 4 nodes, to judge five by.
pub static FOUR: LazyLock<Rule> = LazyLock::new(|| legendre(4));

/// 5 nodes, where little changes.
pub static FIVE: LazyLock<Rule> = LazyLock::new(|| legendre(5));

/// 7 nodes, to judge the larger rule by.
pub static LOW: LazyLock<Rule> = LazyLock::new(|| legendre(7));

/// 11 nodes.
pub static HIGH: LazyLock<Rule> = LazyLock::new(|| legendre(11));
