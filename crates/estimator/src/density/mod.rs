//! Densities: what points are drawn from, and how. A density knows its measure and nothing of the integrand.

mod along;
mod arc_tangent;
mod bilinear_cosine;
mod brdf;
mod hemisphere;
mod lights;
mod luminance;
mod one_target;
mod pieces;
mod projected_solid_angle;
mod sector;
mod solid_angle;
mod spherical_rectangle;
mod spherical_triangle;
mod toward;

pub use bilinear_cosine::{BilinearCosineOnLights, ByBilinearCosine, corner_cosines};
pub use brdf::{BrdfOfSurface, ByBrdf};
pub use hemisphere::{CosineHemisphere, UniformHemisphere};
pub use lights::{AreaOnLights, ByArea, OnLights, Picking, Spread};
pub use luminance::{ByLuminance, LuminanceOnLights};
pub use one_target::OnOneTarget;
pub use pieces::{Piece, Pieces, PiecesOfTargets, each_piece};
pub use projected_solid_angle::{ByProjectedSolidAngle, ProjectedSolidAngleOnLights};
pub use sector::{Sector, sectors};
pub use solid_angle::{BySolidAngle, SolidAngleOnLights};
pub use spherical_rectangle::SphericalRectangle;
pub use spherical_triangle::SphericalTriangle;
pub use toward::{TowardLights, TowardLightsMarginal, TowardLightsMarginally, TowardPreparedLights};

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Real;
use twoforms_geometry::view::{Vantage, View};

use crate::estimator::{Estimator, Single};
use crate::formulation::Formulation;
use crate::lights::Lights;
use crate::measure::{Measure, Pdf, Sample};
use crate::query::Query;
use crate::selection::Selection;
use crate::xi::Xi;

/// A probability density over a measured domain, and a way to draw from it: a pure function of ξ.
pub trait Density<M: Measure>: Sync {
    /// Draws a point. No sample is a sample worth zero, and the zero counts.
    fn sample<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<M, R>, R>;

    /// The density at a point; none where no point is ever drawn.
    fn pdf<R: Real>(&self, from: &Vantage<R>, at: &M::Point<R>) -> Masked<Pdf<M, R>, R>;
}

/// A density made ready: what it needs of a scene is worked out once, what it needs of x once for each x.
pub trait Ready: Sized + Send + Sync {
    /// What it is a density of.
    type Measure: Measure;
    /// The density at one x.
    type At<'a>: Density<Self::Measure>
    where
        Self: 'a;

    /// Works out what is needed of a scene, which must have a light.
    fn prepare(lights: &Lights, selection: Selection) -> Self;

    /// Whether each x has a density of its own, so that a view of many x has none.
    fn depends_on_x(&self) -> bool;

    /// The density at x of points that estimate `query`.
    fn at<'a>(&'a self, view: &View, query: &Query) -> Self::At<'a>;

    /// The estimator of `query` at x by a formulation and this density: with that of [`Ready::at`], or with a simpler one that
    /// draws the same points.
    fn boxed<'a, F>(&'a self, view: &'a View<'a>, query: &'a Query<'a>) -> Box<dyn Estimator + 'a>
    where
        F: Formulation<Measure = Self::Measure> + 'a,
    {
        Box::new(Single::<F, _>::new(view, query, self.at(view, query)))
    }
}
