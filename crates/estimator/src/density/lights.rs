//! Points on the lights.

use std::borrow::Cow;
use std::sync::Arc;

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::Real;
use twoforms_geometry::segment::SurfacePoint;
use twoforms_geometry::view::{Vantage, View};

use super::{Density, OnOneTarget, Ready};
use crate::estimator::{Estimator, Single};
use crate::formulation::Formulation;
use crate::lights::Lights;
use crate::measure::{Pdf, Sample, SurfaceArea};
use crate::query::Query;
use crate::selection::{Picked, Picker, Selection};
use crate::tree::{Tree, Walk};
use crate::xi::Xi;

/// A measure in which points are uniform over a target: a map from the unit square, and how much of the measure there is per
/// area.
pub trait Spread: Sync {
    /// The point of a target, or of a piece of one, that two uniform numbers pick.
    fn point<R: Real>(&self, from: &Vantage<R>, piece: R::Word, uv: [R; 2]) -> SurfacePoint<R>;

    /// The same point, and dm/dA there as the draw knows it: before y was rounded.
    #[inline(always)]
    fn draw<R: Real>(&self, from: &Vantage<R>, piece: R::Word, uv: [R; 2]) -> (SurfacePoint<R>, R) {
        let y = self.point(from, piece, uv);
        (y, self.per_area(from, &y))
    }

    /// dm/dA at y: how much of the measure there is per square metre of the target; not positive where there is none.
    fn per_area<R: Real>(&self, from: &Vantage<R>, y: &SurfacePoint<R>) -> R;
}

/// How a target is picked at one x.
#[derive(Clone, Debug)]
pub enum Picking<'p> {
    /// From a list, with the pieces that targets fall into.
    Listed(Cow<'p, Picker>),
    /// By a walk through the tree, targets being whole.
    Tree(Walk<'p>),
}

impl Picking<'_> {
    /// What a random word picks.
    #[inline(always)]
    pub fn pick<R: Real>(&self, word: R::Word) -> Picked<R> {
        match self {
            Self::Listed(picker) => picker.pick(word),
            Self::Tree(walk) => walk.pick(word),
        }
    }

    /// The probability of picking a target over its measure.
    #[inline(always)]
    pub fn density<R: Real>(&self, target: R::Word) -> R {
        match self {
            Self::Listed(picker) => picker.density(target),
            Self::Tree(walk) => walk.density(target),
        }
    }

    /// The probability that a target is picked: less than one where a light is picked that has none to be drawn on.
    pub fn mass(&self) -> f64 {
        match self {
            Self::Listed(picker) => picker.mass(),
            Self::Tree(_) => 1.0,
        }
    }
}

/// A target is picked, then a point on it uniformly in a measure m: p(y) = Pr(target)/m(target) · dm/dA.
#[derive(Clone, Debug)]
pub struct OnLights<'p, S> {
    /// Picks the target.
    pub picking: Picking<'p>,
    /// The measure.
    pub spread: S,
}

impl<S: Spread> Density<SurfaceArea> for OnLights<'_, S> {
    #[inline(always)]
    fn sample<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SurfaceArea, R>, R> {
        let Picked { piece, u, density } = self.picking.pick::<R>(xi.pick());
        let (at, per_area) = self.spread.draw(from, piece, [u, xi.v()]);
        let pdf = density * per_area;
        Masked::new(Sample { at, pdf: Pdf::new(pdf) }, R::zero().lt(pdf))
    }

    #[inline(always)]
    fn pdf<R: Real>(&self, from: &Vantage<R>, y: &SurfacePoint<R>) -> Masked<Pdf<SurfaceArea, R>, R> {
        let pdf = self.picking.density::<R>(y.target) * self.spread.per_area(from, y);
        Masked::new(Pdf::new(pdf), R::zero().lt(pdf))
    }
}

/// Area itself.
#[derive(Clone, Copy, Debug)]
pub struct ByArea;

impl Spread for ByArea {
    #[inline(always)]
    fn point<R: Real>(&self, from: &Vantage<R>, target: R::Word, uv: [R; 2]) -> SurfacePoint<R> {
        from.facet(target).point(uv, target)
    }

    #[inline(always)]
    fn per_area<R: Real>(&self, _: &Vantage<R>, _: &SurfacePoint<R>) -> R {
        R::one()
    }
}

/// `area/uniform`: back-facing targets included.
#[derive(Clone, Debug)]
pub struct AreaOnLights {
    selection: Selection,
    everywhere: Option<Picker>,
    tree: Option<Arc<Tree>>,
}

impl Ready for AreaOnLights {
    type Measure = SurfaceArea;
    type At<'a> = OnLights<'a, ByArea>;

    fn prepare(lights: &Lights, selection: Selection) -> Self {
        let tree = (selection == Selection::Tree).then(|| lights.tree().clone());
        Self { selection, everywhere: Picker::of_area(selection, lights), tree }
    }

    fn depends_on_x(&self) -> bool {
        self.everywhere.is_none()
    }

    fn at<'a>(&'a self, view: &View, query: &Query) -> OnLights<'a, ByArea> {
        let lights = query.lights();
        let of = |picker| OnLights { picking: Picking::Listed(picker), spread: ByArea };
        match (&self.everywhere, &self.tree) {
            (Some(picker), _) => of(Cow::Borrowed(picker)),
            (None, Some(tree)) => OnLights { picking: Picking::Tree(Walk::new(tree, view.frame())), spread: ByArea },
            (None, None) => {
                let at_x = || self.selection.at_x(lights, view);
                of(Cow::Owned(Picker::new(self.selection, lights, lights.areas(), at_x)))
            }
        }
    }

    fn boxed<'a, F>(&'a self, view: &'a View<'a>, query: &'a Query<'a>) -> Box<dyn Estimator + 'a>
    where
        F: Formulation<Measure = SurfaceArea> + 'a,
    {
        match query.lights().areas() {
            &[area] => Box::new(Single::<F, _>::new(view, query, OnOneTarget::new(area))),
            _ => Box::new(Single::<F, _>::new(view, query, self.at(view, query))),
        }
    }
}
