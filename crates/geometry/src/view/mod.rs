//! The View from x: all that depends on x alone.
//!
//! Many samples share one x. What it sees of each target (where the target lies, which triangles can stand between) is
//! worked out once, in binary64, in the frame of x; then V(x, y) and "which light does Ψ reach" are dot products with
//! planes through x, the same few for every sample. Where too many triangles stand between, and where there are too many
//! targets, rays are cast instead. Both ways answer alike, up to samples within rounding of an edge.

mod cone;
mod facet;
mod group;
mod polygon;
mod prospect;
mod shaft;
mod sight;
mod vantage;
mod vista;
mod window;

use glam::DVec3;

use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::real::{Mask, Real};
use crate::vector::Vector;

pub use cone::Cone;
use cone::Start;
use facet::Wide;
pub use facet::{Facet, Standing};
pub use prospect::{Need, Prospect, prospects};
pub use sight::{Between, Sight};
pub use vantage::Vantage;
pub use vista::{Glimpse, Pane, Vista};

/// Most targets that a view looks at one by one; beyond, rays find them.
const MANY_TARGETS: usize = 64;

/// How a view answers its questions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Few samples at this x: cast a ray for each question.
    Cast,
    /// Many samples at this x: gather what stands between x and the targets first.
    Gather,
}

/// What x sees of the targets.
pub struct View<'g> {
    geometry: &'g Geometry,
    frame: Frame,
    sights: Option<Vec<Sight>>,
    /// Where targets lie that are too many for sights, if that is worth working out once for all.
    facets: Vec<Wide>,
}

impl<'g> View<'g> {
    /// The view from the origin of `frame`.
    pub fn new(geometry: &'g Geometry, frame: Frame, effort: Effort) -> Self {
        let look = |target| Some(Sight::new(geometry, &frame, target, effort));
        let sights = sights(geometry, look);
        let many = if sights.is_none() && effort == Effort::Gather { geometry.targets().len() as u32 } else { 0 };
        let facets = (0..many).map(|target| Facet::wide(geometry, &frame, target)).collect();
        Self { geometry, frame, sights, facets }
    }

    /// The view from every point of a footprint around the origin of `frame`: a convex polygon in the plane z = 0 of the
    /// frame, in metres. None where there are too many targets, or its points lie on both sides of one that emits to both.
    pub fn over(geometry: &'g Geometry, frame: Frame, footprint: &[DVec3]) -> Option<Self> {
        let look = |target| Sight::over(geometry, &frame, footprint, target);
        Some(Self { geometry, frame, sights: Some(sights(geometry, look)?), facets: Vec::new() })
    }

    /// All samples look from x.
    #[inline(always)]
    pub fn from_x<R: Real>(&self) -> Vantage<'_, R> {
        Vantage { view: self, start: Start::origin(), wanted: R::Mask::splat(true) }
    }

    /// Each sample looks from its own point of the footprint, in the frame of x.
    #[inline(always)]
    pub fn from_points<R: Real>(&self, start: Vector<R>) -> Vantage<'_, R> {
        Vantage { view: self, start: Start::at(start), wanted: R::Mask::splat(true) }
    }

    /// Where x is and which way it faces.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The geometry that x looks at.
    pub fn geometry(&self) -> &'g Geometry {
        self.geometry
    }

    /// What was gathered about each target, in order; `None` where there are too many and rays are cast instead.
    pub fn sights(&self) -> Option<&[Sight]> {
        self.sights.as_deref()
    }

    /// Does something with the corners of a target, counter-clockwise from its front, in metres in the frame of x; nothing
    /// where x is not on a side that emits.
    pub fn facing<T>(&self, target: u32, f: impl FnOnce(&[DVec3]) -> T) -> Option<T> {
        let facet = self.wide(target);
        facet.faces_x().then(|| f(facet.corners()))
    }

    fn outline(&self, target: u32) -> Cone {
        match &self.sights {
            Some(sights) => *sights[target as usize].outline(),
            None => self.wide(target).outline(),
        }
    }

    fn wide(&self, target: u32) -> Wide {
        match (&self.sights, self.facets.get(target as usize)) {
            (Some(sights), _) => *sights[target as usize].facet(),
            (None, Some(facet)) => *facet,
            (None, None) => Facet::wide(self.geometry, &self.frame, target),
        }
    }
}

/// What is seen of each target; none where there are too many, or one of them is cut out.
fn sights(geometry: &Geometry, look: impl Fn(u32) -> Option<Sight>) -> Option<Vec<Sight>> {
    let count = geometry.targets().len();
    let cut = || geometry.is_veiled() && (0..count as u32).any(|target| geometry.is_cut(target));
    if count > MANY_TARGETS || cut() { None } else { (0..count as u32).map(look).collect() }
}
