//! Where samples look from, and what they see.

use glam::DVec3;

use super::View;
use super::cone::{Line, Start};
use super::facet::{Facet, ROW};
use super::sight::{Between, Sight};
use crate::masked::Masked;
use crate::ray::Ray;
use crate::real::{Mask, Real, Word};
use crate::segment::SurfacePoint;
use crate::vector::{Direction, Vector};

/// Where samples look from: all from x, or each from its own point of a footprint around x. What is seen is said from
/// there, in the axes of the frame of x.
#[derive(Clone, Copy)]
pub struct Vantage<'v, R: Real> {
    pub(super) view: &'v View<'v>,
    pub(super) start: Start<R>,
    pub(super) wanted: R::Mask,
}

impl<'v, R: Real> Vantage<'v, R> {
    /// Only these samples count; of others nothing is asked that costs a ray.
    #[inline(always)]
    pub fn only(self, wanted: R::Mask) -> Self {
        Self { wanted: self.wanted & wanted, ..self }
    }

    /// The samples that count.
    #[inline(always)]
    pub fn wanted(&self) -> R::Mask {
        self.wanted
    }

    /// The points of the footprint, in metres in the frame of x; none where all samples look from x itself.
    #[inline(always)]
    pub fn footprint(&self) -> Option<Vector<R>> {
        self.start.beside()
    }

    /// What x sees.
    #[inline(always)]
    pub fn view(&self) -> &'v View<'v> {
        self.view
    }

    /// Where samples look from, in the frame of x.
    #[inline(always)]
    pub fn start(&self) -> Vector<R> {
        self.start.point()
    }

    /// A position said from where its sample looks from, said from x.
    #[inline(always)]
    pub fn from_x(&self, position: Vector<R>) -> Vector<R> {
        self.start() + position
    }

    /// The targets as samples meet them, by each sample's index.
    #[inline(always)]
    pub fn facet(&self, target: R::Word) -> Facet<R> {
        let facet = match self.view.sights.as_deref() {
            Some([sight]) => Facet::splat(sight.row()),
            _ => Facet::from_row(self.view.looked_up(target)),
        };
        match self.start.beside() {
            Some(start) => facet.seen_from(start),
            None => facet,
        }
    }

    /// Whether the line along Ψ meets a target, whatever stands between and whichever side it shows.
    #[inline(always)]
    pub fn meets(&self, target: R::Word, psi: Direction<R>) -> R::Mask {
        self.view.meets(Lines::of(psi.vector(), self.start), target, self.wanted)
    }

    /// The same for one target: a few dot products.
    #[inline(always)]
    pub fn meets_one(&self, target: u32, psi: Direction<R>) -> R::Mask {
        let line = Line { toward: psi.vector(), start: self.start };
        self.wanted & self.view.outline(target).holds(&line)
    }

    /// y = vp(x, Ψ) where y is on the emitting side of a target; nothing where Ψ meets no surface, a surface that does
    /// not emit, or the dark side of one that does.
    #[inline(always)]
    pub fn vp(&self, psi: Direction<R>) -> Masked<SurfacePoint<R>, R> {
        let (reached, target) = match &self.view.sights {
            Some(sights) => self.reached_by_planes(sights, psi),
            None => self.view.reached_by_rays(Lines::of(psi.vector(), self.start), self.wanted),
        };
        let target = R::select_word(reached, target, R::Word::splat(0));
        if !reached.any() {
            let nowhere = SurfacePoint { position: psi.vector(), depth: R::zero(), target };
            return Masked::new(nowhere, reached);
        }
        Masked::new(self.facet(target).point_along(psi, target), reached)
    }

    /// y = vp(x, Ψ) for a direction aimed at a point of `target`: where Ψ meets its plane, if nothing stands between.
    ///
    /// That Ψ points at the target is taken from the caller, who drew the point: a direction rounded to binary32 may
    /// leave a small light near its edges, and those samples would be lost.
    #[inline(always)]
    pub fn vp_on(&self, target: R::Word, psi: Direction<R>) -> Masked<SurfacePoint<R>, R> {
        let y = self.facet(target).point_along(psi, target);
        let facing = R::zero().lt(y.depth) & R::zero().lt(psi.cos_theta());
        Masked::new(y, facing & self.visible(&y, facing))
    }

    /// V(x, y): whether nothing stands between x and y. Where y is below x's horizon or x behind y the answer means
    /// nothing; both make the sample worth zero.
    #[inline(always)]
    pub fn visible(&self, y: &SurfacePoint<R>, asked: R::Mask) -> R::Mask {
        let asked = asked & self.wanted;
        let Some(sights) = &self.view.sights else {
            return self.view.clear_by_ray(Lines::of(y.position, self.start), y.target, asked);
        };
        match &sights[..] {
            [sight] => {
                let line = Line { toward: y.position, start: self.start };
                self.view.unblocked(sight, &line, y.target, asked)
            }
            sights => self.view.unblocked_by_each(sights, Lines::of(y.position, self.start), y.target, asked),
        }
    }

    /// The sights are disjoint but for edges and blocked by each other, so the first that is reached is the one.
    #[inline(always)]
    fn reached_by_planes(&self, sights: &[Sight], psi: Direction<R>) -> (R::Mask, R::Word) {
        let line = Line { toward: psi.vector(), start: self.start };
        let (mut reached, mut found) = (R::Mask::splat(false), R::Word::splat(0));
        for (k, sight) in sights.iter().enumerate() {
            if !sight.lit() {
                continue;
            }
            let inside = self.wanted & !reached & sight.outline().holds(&line);
            if inside.any() {
                let target = R::Word::splat(k as u32);
                let seen = self.view.unblocked(sight, &line, target, inside);
                (reached, found) = (reached | seen, R::select_word(seen, target, found));
            }
        }
        (reached, found)
    }
}

/// Lines as numbers by themselves, to be handed to what stands apart: where a vector itself is handed over, the one of the hot
/// path lives in memory.
#[derive(Clone, Copy)]
struct Lines<R> {
    toward: [R; 3],
    start: Option<[R; 3]>,
}

impl<R: Real> Lines<R> {
    #[inline(always)]
    fn of(toward: Vector<R>, start: Start<R>) -> Self {
        Self { toward: toward.to_array(), start: start.beside().map(Vector::to_array) }
    }

    #[inline(always)]
    fn line(&self) -> Line<R> {
        let start = match self.start {
            Some(start) => Start::at(Vector::from(start)),
            None => Start::origin(),
        };
        Line { toward: Vector::from(self.toward), start }
    }

    /// Asks a question about the line of each sample where `asked`.
    #[inline(always)]
    fn each(
        &self,
        asked: R::Mask,
        word: R::Word,
        mut question: impl FnMut(u32, Line<f32>) -> Option<u32>,
    ) -> (R::Mask, R::Word) {
        let [u, v, w] = self.toward;
        match self.start {
            None => R::each(
                asked,
                word,
                [u, v, w],
                #[inline(always)]
                |k, toward| question(k, Line { toward: Vector::from(toward), start: Start::origin() }),
            ),
            Some([x, y, z]) => R::each(
                asked,
                word,
                [x, y, z, u, v, w],
                #[inline(always)]
                |k, [x, y, z, u, v, w]| {
                    question(k, Line { toward: Vector::new(u, v, w), start: Start::at(Vector::new(x, y, z)) })
                },
            ),
        }
    }
}

impl View<'_> {
    /// The share of light that passes what is blended between a point of a target and where its sample looks from, and arrives
    /// if the target is there at all: `start` and `toward` in the frame of x, `toward` from the one to the other.
    pub fn passing(&self, start: [f32; 3], toward: [f32; 3], target: u32) -> f64 {
        let [start, toward] = [start, toward].map(|v| DVec3::from_array(v.map(f64::from)));
        let ray = self.ray(start, toward);
        if self.geometry.is_hole(target, ray.at(1.0)) {
            return 0.0;
        }
        let before = self.wide(target).distance_along(start, toward);
        self.geometry.transmittance(&ray, before, target)
    }

    /// Whether nothing stands before the sight's target along lines, where `asked`.
    #[inline(always)]
    fn unblocked<R: Real>(&self, sight: &Sight, line: &Line<R>, target: R::Word, asked: R::Mask) -> R::Mask {
        match sight.between() {
            Between::Gathered(cones) => {
                let mut clear = asked;
                for cone in cones {
                    clear = clear & !cone.holds(line);
                }
                clear
            }
            Between::Unknown => self.clear_by_ray(Lines::of(line.toward, line.start), target, asked),
        }
    }

    #[inline(never)]
    fn looked_up<R: Real>(&self, target: R::Word) -> [R; ROW] {
        R::apart(
            #[inline(always)]
            || match &self.sights {
                Some(sights) => R::gather(
                    target,
                    #[inline(always)]
                    |k| sights[k as usize].row(),
                ),
                None => R::gather(
                    target,
                    #[inline(always)]
                    |k| self.wide(k).row(),
                ),
            },
        )
    }

    #[inline(never)]
    fn meets<R: Real>(&self, lines: Lines<R>, target: R::Word, asked: R::Mask) -> R::Mask {
        R::apart(
            #[inline(always)]
            || {
                lines.each(
                    asked,
                    target,
                    #[inline(always)]
                    |k, line| self.outline(k).holds(&line).then_some(k),
                )
            },
        )
        .0
    }

    #[inline(never)]
    fn unblocked_by_each<R: Real>(
        &self,
        sights: &[Sight],
        lines: Lines<R>,
        target: R::Word,
        asked: R::Mask,
    ) -> R::Mask {
        R::apart(
            #[inline(always)]
            || {
                let (line, mut visible) = (lines.line(), R::Mask::splat(false));
                for (k, sight) in sights.iter().enumerate() {
                    let here = asked & R::same(target, R::Word::splat(k as u32));
                    if here.any() {
                        visible = visible | self.unblocked(sight, &line, target, here);
                    }
                }
                visible
            },
        )
    }

    #[inline(never)]
    fn reached_by_rays<R: Real>(&self, lines: Lines<R>, asked: R::Mask) -> (R::Mask, R::Word) {
        R::apart(
            #[inline(always)]
            || {
                lines.each(
                    asked,
                    R::Word::splat(0),
                    #[inline(always)]
                    |_, line| self.reached_by_ray(&line),
                )
            },
        )
    }

    #[cold]
    #[inline(never)]
    fn clear_by_ray<R: Real>(&self, lines: Lines<R>, target: R::Word, asked: R::Mask) -> R::Mask {
        R::apart(
            #[inline(always)]
            || {
                lines.each(
                    asked,
                    target,
                    #[inline(always)]
                    |k, line| self.clear(&line, k).then_some(k),
                )
            },
        )
        .0
    }

    /// Casts a ray along a local line toward the plane of a target.
    fn clear(&self, line: &Line<f32>, target: u32) -> bool {
        let (start, toward) = wide(line);
        let (before, ray) = (self.wide(target).distance_along(start, toward), self.ray(start, toward));
        // What is cut out is not there: no technique comes upon it.
        let there = !self.geometry.is_veiled() || !self.geometry.is_hole(target, ray.at(before));
        there && self.geometry.visible(&ray, before, target)
    }

    /// The target that a local line reaches first of all surfaces, on a side that emits.
    fn reached_by_ray(&self, line: &Line<f32>) -> Option<u32> {
        let (start, toward) = wide(line);
        let hit = self.geometry.vp(&self.ray(start, toward))?;
        let target = self.geometry.target_of(hit.triangle)?;
        self.wide(target).faces_x().then_some(target)
    }

    fn ray(&self, start: DVec3, toward: DVec3) -> Ray {
        Ray::new(self.frame.x() + self.frame.to_world(start), self.frame.to_world(toward))
    }
}

fn wide(line: &Line<f32>) -> (DVec3, DVec3) {
    let wide = |v: Vector<f32>| DVec3::from_array(v.to_array().map(f64::from));
    (line.start.beside().map_or(DVec3::ZERO, wide), wide(line.toward))
}
