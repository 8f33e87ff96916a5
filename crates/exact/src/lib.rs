//! Direct light without chance: irradiance with occlusion, and the variance of the estimators, for
//! triangles lit by triangles.
//!
//! Input is what one receiver x meets, in its own frame ([`Facing`], [`Light`]); [`Sight`] takes
//! the blockers away from each emitter, leaving convex polygons ([`visible`]), and sums their
//! [`moments`] over edges. The irradiance and the second moments of the basic estimators are such
//! sums; where they cancel, and for the weighted strategies, [`cubature`] over the same polygons
//! takes their place. Every value comes with an absolute error bound, or not at all.
//!
//! In words of the rendering equation: E = ∫ L_e cosθ_x V dω, f_r = 1. For a diffuse surface
//! multiply E by ρ/π and variances by (ρ/π)². For a surface with a highlight, cubature gives the radiance toward an eye and
//! the variances of its estimators ([`reflected`]).

pub mod arc;
pub mod bilinear;
pub mod clip;
pub mod cone;
pub mod cubature;
pub mod density;
pub mod error;
pub mod facet;
pub mod facing;
pub mod gauss;
pub mod glow;
pub mod jittered;
pub mod law;
pub mod mis;
pub mod moments;
pub mod moved;
pub mod optimal;
pub mod outline;
pub mod picked;
pub mod receiver;
pub mod reflected;
pub mod seen;
pub mod sight;
pub mod spread;
pub mod value;
pub mod variance;
pub mod visible;

pub use error::Error;
pub use facing::{Facing, Light};
pub use glow::Glow;
pub use jittered::variance_of_jittered;
pub use sight::Sight;
pub use value::Value;
pub use variance::{has_formula, with_formula};
