//! What can keep a value from being had.

use thiserror::Error;

/// Why a receiver, or one value at it, has no exact answer.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Error {
    /// A coordinate, area or radiance is NaN or infinite.
    #[error(
        "target {target} has a coordinate, area or radiance that is not finite: check the scene's vertices and transforms"
    )]
    NotFinite {
        /// Which target.
        target: u32,
    },
    /// The area or power of a light is NaN, infinite or negative.
    #[error(
        "light {light} has an area or power that is not a finite number from zero up: check its vertices and emission"
    )]
    BadLight {
        /// Which light.
        light: usize,
    },
    /// A target names a light that the scene's list of lights does not hold.
    #[error("target {target} belongs to light {light}, but only {lights} lights are listed")]
    NoSuchLight {
        /// Which target.
        target: u32,
        /// The light it names.
        light: u32,
        /// How many lights there are.
        lights: usize,
    },
    /// The receiver lies on an emitter, where irradiance jumps from one side to the other.
    #[error("the receiver lies on target {target}, which emits: move it off the light, to either side")]
    OnLight {
        /// Which target.
        target: u32,
    },
    /// What x sees of a target falls into more pieces than are worth computing.
    #[error("what the receiver sees of target {target} is cut into more than {limit} pieces by {blockers} blockers")]
    TooManyPieces {
        /// Which target.
        target: u32,
        /// Triangles that may stand between.
        blockers: usize,
        /// How many cuts are tried before giving up.
        limit: usize,
    },
    /// A texture that a target emits by shows more texels to the receiver than are worth computing.
    #[error(
        "what the receiver sees of target {target} shows more than {limit} texels of the texture that it emits by: reduce \
         the image"
    )]
    TooManyTexels {
        /// Which target.
        target: u32,
        /// How many pieces are tried before giving up.
        limit: usize,
    },
    /// What is not opaque stands between the receiver and a target, or the target itself is cut out.
    #[error(
        "the receiver sees target {target}, or might, through a surface that is cut out or blended, or that target is cut out \
         itself: only sampling tells what arrives"
    )]
    Veiled {
        /// Which target.
        target: u32,
    },
    /// Cubature stopped at its limit of work with too large an error left.
    #[error("cubature did not converge: relative error {relative:.1e} after {cells} cells")]
    NotConverged {
        /// Estimated error over the value.
        relative: f64,
        /// Triangles evaluated.
        cells: usize,
    },
    /// The mean that came with a variance is not the irradiance.
    #[error("the variance's own mean {mean} differs from the irradiance {irradiance} by more than rounding explains")]
    Inconsistent {
        /// Mean of the estimator by cubature.
        mean: f64,
        /// Irradiance by edge sums.
        irradiance: f64,
    },
    /// The eye cannot see the side of a surface with a highlight on which the receiver lies.
    #[error("the eye lies behind the surface at the receiver: look from the other side, or turn the receiver's normal")]
    BehindSurface,
    /// The strategy's weights of least variance are known for a constant f_r alone.
    #[error("its α are known only where f_r is the same for all directions: leave highlights out, or take mis/balance")]
    NotConstant,
    /// No formula is known here for the variance of this strategy.
    #[error("no formula is known for its variance")]
    NoFormula,
    /// What the tree would pick is not known.
    #[error("the tree over the targets is not known here, where lights are listed one by one or have been moved")]
    NoTree,
    /// The selection never picks a light that contributes, so the estimator has no finite variance
    /// about the irradiance.
    #[error("light {light} contributes but is never picked: choose another selection")]
    NeverPicked {
        /// Which light.
        light: usize,
    },
    /// Stratified sampling needs every target of the scene, in order.
    #[error(
        "the targets listed cover {listed} m² of the lights' {total} m²: list those that do not face the receiver too"
    )]
    Unlisted {
        /// Area of the targets listed, in m².
        listed: f64,
        /// Area of all lights, in m².
        total: f64,
    },
}
