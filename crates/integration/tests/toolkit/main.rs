//! The toolkit against known answers: what the lecture prints, densities against their own definition, samplers, cubature.

mod cubature;
mod densities;
mod dimensions;
mod lecture;
mod refused;
mod samplers;
mod support;
