//! Multiple importance sampling with one sample or more of each technique (Veach 1997, chapter 9).
//!
//! I = Σ_i Σ_k w_i(X_ik) f(X_ik) / (n_i p_i(X_ik)), densities per solid angle at the point y of a light that x sees. A technique
//! that cannot come upon y has density zero there.

use twoforms_geometry::masked::Masked;
use twoforms_geometry::real::{Mask, Real, Word};
use twoforms_geometry::view::{Vantage, View};

use crate::estimator::{Primary, Worth, count};
use crate::numbers::Drawn;
use crate::query::Query;
use crate::rgb::Rgb;
use crate::strategy::{MOST, Weighting};
use crate::technique::{Found, Local};

/// A team of techniques, weighted.
pub(crate) struct Mis<'a> {
    pub(crate) view: &'a View<'a>,
    pub(crate) query: &'a Query<'a>,
    /// Techniques with n_i, the samples of each.
    pub(crate) team: Vec<(Local<'a>, u32)>,
    /// Σ n_i: pairs of random numbers that a sample of the team takes.
    pub(crate) pairs: usize,
    pub(crate) weighting: Weighting,
    /// α_i of each technique, RGB, where the weights are optimal.
    pub(crate) alpha: Vec<[f32; 3]>,
    /// Rays of pilot samples.
    pub(crate) setup_rays: u64,
}

impl Primary for Mis<'_> {
    fn view(&self) -> &View<'_> {
        self.view
    }

    fn query(&self) -> &Query<'_> {
        self.query
    }

    fn pairs(&self) -> usize {
        self.pairs
    }

    fn setup_rays(&self) -> u64 {
        self.setup_rays
    }

    #[inline(always)]
    fn primary<R: Real>(&self, from: &Vantage<R>, drawn: Drawn) -> Worth<R> {
        let (mut value, mut rays) = (self.constant(from), R::Word::splat(0));
        let mut pair = 0;
        for (i, (technique, n)) in self.team.iter().enumerate() {
            for _ in 0..*n {
                let found = technique.find(from, drawn.xi(pair));
                rays = rays.wrapping_add(count::<R>(found.asked));
                value = value + self.weighted(from, i, &found);
                pair += 1;
            }
        }
        Worth { value, rays }
    }
}

impl Mis<'_> {
    /// Σ α_i.
    #[inline(always)]
    fn constant<R: Real>(&self, from: &Vantage<R>) -> Rgb<R> {
        let mut sum = Rgb::splat([0.0; 3]);
        for alpha in &self.alpha {
            sum = sum + Rgb::splat(*alpha);
        }
        sum.or_black(from.wanted())
    }

    /// w_i f/(n_i p_i) of one sample of technique i.
    #[inline(always)]
    fn weighted<R: Real>(&self, from: &Vantage<R>, i: usize, found: &Found<R>) -> Rgb<R> {
        let missed = self.missed(from, i, found);
        if !found.seen.any() {
            return missed;
        }
        let q = self.expected(from, i, found);
        let f = self.query.received(from, Masked::new(found.y, found.seen), &found.xy);
        let value = match self.weighting {
            Weighting::Optimal | Weighting::Pilot(_) => self.residual(f, &q),
            weighting => f * weighting.over(&q[..self.team.len()], i),
        };
        value.or_black(found.seen) + missed
    }

    /// q_k = n_k p_k where a sample of technique i met light; zeros after the last.
    #[inline(always)]
    pub(super) fn expected<R: Real>(&self, from: &Vantage<R>, i: usize, found: &Found<R>) -> [R; MOST] {
        let mut q = [R::zero(); MOST];
        for (k, (technique, n)) in self.team.iter().enumerate() {
            let pdf = if k == i { found.pdf } else { technique.pdf_of(&from.only(found.seen), &found.y, &found.xy) };
            q[k] = pdf * R::splat(*n as f32);
        }
        q
    }

    /// With optimal weights: (f − Σ α_k p_k) / Σ n_k p_k (Kondapaneni et al. 2019, "Optimal multiple importance sampling",
    /// equation 14, without its constant Σ α_k).
    #[inline(always)]
    fn residual<R: Real>(&self, f: Rgb<R>, q: &[R; MOST]) -> Rgb<R> {
        let (mut rest, mut sum) = (f, R::zero());
        for (k, (_, n)) in self.team.iter().enumerate() {
            rest = rest + Rgb::splat(self.alpha[k].map(|alpha| -alpha / *n as f32)) * q[k];
            sum = sum + q[k];
        }
        rest * (R::one() / sum)
    }

    /// The same where x sees no light: f = 0, and no other technique comes upon the same point, so −α_i/n_i is left.
    #[inline(always)]
    fn missed<R: Real>(&self, from: &Vantage<R>, i: usize, found: &Found<R>) -> Rgb<R> {
        let Some(alpha) = self.alpha.get(i) else { return Rgb::splat([0.0; 3]) };
        let n = self.team[i].1 as f32;
        Rgb::splat(alpha.map(|alpha| -alpha / n)).or_black(from.wanted() & !found.seen)
    }
}
