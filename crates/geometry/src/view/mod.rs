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
mod pyramid;
mod sight;
mod window;

use glam::DVec3;

use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::masked::Masked;
use crate::ray::Ray;
use crate::real::{Mask, Real};
use crate::segment::SurfacePoint;
use crate::vector::{Direction, Vector};

pub use cone::Cone;
use facet::Wide;
pub use facet::{Facet, Standing};
pub use prospect::{Need, Prospect, prospects};
pub use sight::{Between, Sight};

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
}

impl<'g> View<'g> {
    /// The view from the origin of `frame`.
    pub fn new(geometry: &'g Geometry, frame: Frame, effort: Effort) -> Self {
        let count = geometry.targets().len() as u32;
        let look = |target| Sight::new(geometry, &frame, target, effort);
        let sights = (count as usize <= MANY_TARGETS).then(|| (0..count).map(look).collect());
        Self { geometry, frame, sights }
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

    /// The targets as x meets them, by each sample's index.
    #[inline(always)]
    pub fn facet<R: Real>(&self, target: R::Word) -> Facet<R> {
        Facet::from_row(R::gather(target, |k| self.facet_row(k)))
    }

    /// Whether the line from x along Ψ meets a target, whatever stands between and whichever side it shows.
    #[inline(always)]
    pub fn meets<R: Real>(&self, target: R::Word, psi: Direction<R>) -> R::Mask {
        let all = R::Mask::splat(true);
        R::each(all, target, psi.vector().to_array(), |k, psi| self.outline(k).holds(Vector::from(psi)).then_some(k)).0
    }

    /// y = vp(x, Ψ) where y is on the emitting side of a target; nothing where Ψ meets no surface, a surface that does
    /// not emit, or the dark side of one that does.
    #[inline(always)]
    pub fn vp<R: Real>(&self, psi: Direction<R>) -> Masked<SurfacePoint<R>, R> {
        let (reached, target) = match &self.sights {
            Some(sights) => self.reached_by_planes(sights, psi),
            None => R::each(R::Mask::splat(true), R::splat_word(0), psi.vector().to_array(), |_, psi| {
                self.reached_by_ray(psi)
            }),
        };
        let target = R::select_word(reached, target, R::splat_word(0));
        if !reached.any() {
            let nowhere = SurfacePoint { position: psi.vector(), depth: R::zero(), target };
            return Masked::new(nowhere, reached);
        }
        Masked::new(self.facet::<R>(target).point_along(psi, target), reached)
    }

    /// y = vp(x, Ψ) for a direction aimed at a point of `target`: where Ψ meets its plane, if nothing stands between.
    ///
    /// That Ψ points at the target is taken from the caller, who drew the point: a direction rounded to binary32 may
    /// leave a small light near its edges, and those samples would be lost.
    #[inline(always)]
    pub fn vp_on<R: Real>(&self, target: R::Word, psi: Direction<R>) -> Masked<SurfacePoint<R>, R> {
        let y = self.facet::<R>(target).point_along(psi, target);
        let facing = R::zero().lt(y.depth) & R::zero().lt(psi.cos_theta());
        Masked::new(y, facing & self.visible(&y, facing))
    }

    /// V(x, y): whether nothing stands between x and y. Where y is below x's horizon or x behind y the answer means
    /// nothing; both make the sample worth zero.
    #[inline(always)]
    pub fn visible<R: Real>(&self, y: &SurfacePoint<R>, asked: R::Mask) -> R::Mask {
        let Some(sights) = &self.sights else {
            return self.visible_by_ray(y, asked);
        };
        (0..).zip(sights).fold(R::Mask::splat(false), |visible, (k, sight)| {
            let here = asked & R::same(y.target, R::splat_word(k));
            if here.any() { visible | (here & self.unblocked(sight, y.position, y.target, here)) } else { visible }
        })
    }

    /// The sights are disjoint but for edges and blocked by each other, so the first that is reached is the one.
    #[inline(always)]
    fn reached_by_planes<R: Real>(&self, sights: &[Sight], psi: Direction<R>) -> (R::Mask, R::Word) {
        let nothing = (R::Mask::splat(false), R::splat_word(0));
        (0..).zip(sights).filter(|(_, sight)| sight.lit()).fold(nothing, |(reached, found), (k, sight)| {
            let inside = !reached & sight.outline().holds(psi.vector());
            if !inside.any() {
                return (reached, found);
            }
            let target = R::splat_word(k);
            let seen = inside & self.unblocked(sight, psi.vector(), target, inside);
            (reached | seen, R::select_word(seen, target, found))
        })
    }

    /// Whether nothing stands between x and the sight's target in a direction (of any length), where `asked`.
    #[inline(always)]
    fn unblocked<R: Real>(&self, sight: &Sight, toward: Vector<R>, target: R::Word, asked: R::Mask) -> R::Mask {
        match sight.between() {
            Between::Gathered(cones) => {
                let mut clear = asked;
                for cone in cones {
                    if !clear.any() {
                        break;
                    }
                    clear = clear & !cone.holds(toward);
                }
                clear
            }
            Between::Unknown => self.clear_by_ray(toward, target, asked),
        }
    }

    fn visible_by_ray<R: Real>(&self, y: &SurfacePoint<R>, asked: R::Mask) -> R::Mask {
        self.clear_by_ray(y.position, y.target, asked)
    }

    #[inline(always)]
    fn clear_by_ray<R: Real>(&self, toward: Vector<R>, target: R::Word, asked: R::Mask) -> R::Mask {
        let clear = |k, toward| self.clear(toward, k).then_some(k);
        R::each(asked, target, toward.to_array(), clear).0
    }

    /// Casts a ray in a local direction toward the plane of a target.
    fn clear(&self, toward: [f32; 3], target: u32) -> bool {
        let local = DVec3::from_array(toward.map(f64::from));
        let before = self.wide(target).distance_along(local);
        let ray = Ray::new(self.frame.x(), self.frame.to_world(local));
        self.geometry.visible(&ray, before, target)
    }

    /// The target that a local direction reaches first of all surfaces, on a side that emits.
    fn reached_by_ray(&self, psi: [f32; 3]) -> Option<u32> {
        let local = DVec3::from_array(psi.map(f64::from));
        let hit = self.geometry.vp(&Ray::new(self.frame.x(), self.frame.to_world(local)))?;
        let target = self.geometry.target_of(hit.triangle)?;
        self.wide(target).faces_x().then_some(target)
    }

    fn outline(&self, target: u32) -> Cone {
        match &self.sights {
            Some(sights) => *sights[target as usize].outline(),
            None => self.wide(target).outline(),
        }
    }

    fn facet_row(&self, target: u32) -> [f32; facet::ROW] {
        match &self.sights {
            Some(sights) => sights[target as usize].row(),
            None => self.wide(target).row(),
        }
    }

    fn wide(&self, target: u32) -> Wide {
        match &self.sights {
            Some(sights) => *sights[target as usize].facet(),
            None => Facet::wide(self.geometry, &self.frame, target),
        }
    }
}
