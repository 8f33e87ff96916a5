//! Points on the lights.

use std::borrow::Cow;

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
use crate::selection::{Picker, Selection};
use crate::xi::Xi;

/// A measure in which points are uniform over a target: a map from the unit square, and how much of the measure there is per
/// area.
pub trait Spread: Sync {
    /// The point of a target, or of a piece of one, that two uniform numbers pick.
    fn point<R: Real>(&self, from: &Vantage<R>, piece: R::Word, uv: [R; 2]) -> SurfacePoint<R>;

    /// dm/dA at y: how much of the measure there is per square metre of the target; not positive where there is none.
    fn per_area<R: Real>(&self, from: &Vantage<R>, y: &SurfacePoint<R>) -> R;
}

/// A target is picked, then a point on it uniformly in a measure m: p(y) = Pr(target)/m(target) · dm/dA.
#[derive(Clone, Debug)]
pub struct OnLights<'p, S> {
    /// Picks the target.
    pub picker: Cow<'p, Picker>,
    /// The measure.
    pub spread: S,
}

impl<S: Spread> Density<SurfaceArea> for OnLights<'_, S> {
    #[inline(always)]
    fn sample<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Masked<Sample<SurfaceArea, R>, R> {
        let (piece, u) = self.picker.pick::<R>(xi.pick());
        let at = self.spread.point(from, piece, [u, xi.v()]);
        self.pdf(from, &at).map(|pdf| Sample { at, pdf })
    }

    #[inline(always)]
    fn pdf<R: Real>(&self, from: &Vantage<R>, y: &SurfacePoint<R>) -> Masked<Pdf<SurfaceArea, R>, R> {
        let pdf = self.picker.density::<R>(y.target) * self.spread.per_area(from, y);
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
}

impl Ready for AreaOnLights {
    type Measure = SurfaceArea;
    type At<'a> = OnLights<'a, ByArea>;

    fn prepare(lights: &Lights, selection: Selection) -> Self {
        Self { selection, everywhere: Picker::of_area(selection, lights) }
    }

    fn depends_on_x(&self) -> bool {
        self.everywhere.is_none()
    }

    fn at<'a>(&'a self, view: &View, query: &Query) -> OnLights<'a, ByArea> {
        let lights = query.lights();
        let at_x = || Picker::new(self.selection, lights, lights.areas(), || lights.contributions(view));
        let picker = self.everywhere.as_ref().map_or_else(|| Cow::Owned(at_x()), Cow::Borrowed);
        OnLights { picker, spread: ByArea }
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
