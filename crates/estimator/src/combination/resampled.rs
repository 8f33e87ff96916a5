//! Resampled importance sampling (Talbot, Cline, Egbert 2005): one of M candidates is kept, in proportion to what it would
//! contribute were nothing in between, and only for that one a ray is cast.
//!
//! I = f(y)/p̂(y) · (1/M) Σ_i p̂(y_i)/p(y_i), where y is y_i with probability in proportion to p̂(y_i)/p(y_i).

use twoforms_geometry::real::{Real, Word};
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::vector::Vector;
use twoforms_geometry::view::{Vantage, View};

use crate::density::{ByArea, Density, OnLights};
use crate::estimator::{Primary, Worth, count};
use crate::formulation::{Area, Formulation};
use crate::measure::Sample;
use crate::numbers::Drawn;
use crate::query::Query;

/// One of `candidates` from `density`. The reservoir keeps one of those seen so far and forgets the others (Chao 1982).
pub(crate) struct Resampled<'a> {
    pub(crate) view: &'a View<'a>,
    pub(crate) query: &'a Query<'a>,
    pub(crate) density: OnLights<'a, ByArea>,
    pub(crate) candidates: u32,
    /// Pairs of random numbers: one a candidate, and one that decides.
    pub(crate) pairs: usize,
}

/// The candidate kept so far.
struct Reservoir<R: Real> {
    y: SurfacePoint<R>,
    /// 1/p̂(y).
    per_target: R,
    /// Σ p̂/p over the candidates seen.
    sum: R,
    /// What rounding has added to the sum beyond that (Kahan 1965): of a thousand like terms it would be more than any other's.
    excess: R,
    /// What is left of the random number that decides.
    u: R,
}

impl<R: Real> Reservoir<R> {
    fn empty(u: R) -> Self {
        let zero = R::zero();
        let nowhere =
            SurfacePoint { position: Vector::new(zero, zero, R::one()), depth: zero, target: R::Word::splat(0) };
        Self { y: nowhere, per_target: zero, sum: zero, excess: zero, u }
    }

    /// Takes a candidate of weight w with probability w over the sum; the random number is stretched and serves again.
    #[inline(always)]
    fn offer(&mut self, y: &SurfacePoint<R>, target: R, w: R) {
        let added = w - self.excess;
        let sum = self.sum + added;
        self.excess = (sum - self.sum) - added;
        let share = w / sum;
        let taken = R::zero().lt(w) & self.u.le(share);
        let stretched = R::select(taken, self.u / share, (self.u - share) / (R::one() - share));
        self.u = R::select(R::zero().lt(w), stretched, self.u);
        self.per_target = R::select(taken, R::one() / target, self.per_target);
        self.y = SurfacePoint::select(taken, y, &self.y);
        self.sum = sum;
    }
}

impl Primary for Resampled<'_> {
    fn view(&self) -> &View<'_> {
        self.view
    }

    fn query(&self) -> &Query<'_> {
        self.query
    }

    fn pairs(&self) -> usize {
        self.pairs
    }

    #[inline(always)]
    fn primary<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Worth<R> {
        let mut kept = Reservoir::empty(drawn.xi::<R>(self.candidates as usize).v());
        for k in 0..self.candidates as usize {
            let (Sample { at: y, pdf }, some) = self.density.sample(from, drawn.xi(k)).parts();
            let target = self.query.unhidden(from, &y);
            let counts = some & R::zero().lt(target);
            kept.offer(&y, target, R::select(counts, target / pdf.value(), R::zero()));
        }
        let some = from.wanted() & R::zero().lt(kept.sum);
        let f = Area::integrand(&from.only(some), self.query, &kept.y).value();
        let scale = kept.per_target * kept.sum * R::splat(1.0 / self.candidates as f32);
        Worth { value: (f * scale).or_black(some), rays: count::<R>(some & Segment::to(&kept.y).facing()) }
    }
}
