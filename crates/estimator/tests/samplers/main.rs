//! Samplers, each as every strategy sees it: uniform words, their strata, pairs that know nothing of each other, the same bits
//! by all instructions.

mod bits;
mod layers;
mod points;
mod rates;
mod uniform;
