//! Teams of techniques, weighted, and mixtures of two.
//!
//! Densities, integrands and values are per area at a point y of a light: F = L g with g = cosθ_x cosθ_y/r², q_k = n_k p_k.

use std::borrow::Cow;

use glam::DVec3;
use twoforms_estimator::strategy::{Team, Weighting};
use twoforms_estimator::technique::Technique;

use crate::density::Density;
use crate::error::Error;
use crate::law::Law;
use crate::seen::Seen;
use crate::sight::Sight;
use crate::spread::{by_cubature, by_rough_cubature};
use crate::visible::Pieces;

/// Densities below this share of the largest are cut off.
const CUT: f64 = 0.1;

/// The densities of a team's members at one x, each with n, the samples that it draws.
pub struct Members(Vec<(Density, f64)>);

impl Members {
    /// # Errors
    /// As [`Density::new`].
    pub fn new(sight: &Sight, team: Team) -> Result<Self, Error> {
        let member = |member: twoforms_estimator::strategy::Member| {
            Ok((Density::new(sight, member.technique)?, f64::from(member.samples)))
        };
        team.members().map(member).collect::<Result<_, Error>>().map(Self)
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// n of a member.
    pub fn samples(&self, member: usize) -> f64 {
        self.0[member].1
    }

    /// What x sees of a facet, in pieces on which all densities are smooth: targets fall into the same pieces for all of them.
    pub fn cut<'s>(&self, index: usize, seen: &'s Seen) -> Cow<'s, Pieces> {
        cut(self.0.iter().map(|(density, _)| density), index, seen)
    }

    /// The probability that a sample of a member is worth zero, and a bound of its error.
    pub fn missed(&self, member: usize) -> (f64, f64) {
        self.0[member].0.missed()
    }

    /// p_k at y, zeros after the last.
    pub fn densities(&self, index: usize, seen: &Seen, y: DVec3) -> [f64; 3] {
        let mut p = [0.0; 3];
        p.iter_mut().zip(&self.0).for_each(|(p, (density, _))| *p = density.per_area(index, seen, y));
        p
    }

    /// q_k = n_k p_k.
    pub fn expected(&self, p: [f64; 3]) -> [f64; 3] {
        let mut q = p;
        q.iter_mut().zip(&self.0).for_each(|(q, (_, n))| *q *= n);
        q
    }

    /// The law of one sample of each member: it is worth w_i F/q_i.
    ///
    /// # Errors
    /// [`Error::NotConverged`]; [`Error::NoFormula`] for weights that need α.
    pub fn laws(&self, sight: &Sight, weighting: Weighting) -> Result<Vec<Law>, Error> {
        (0..self.count()).map(|i| self.law(sight, weighting, i)).collect()
    }

    fn law(&self, sight: &Sight, weighting: Weighting, i: usize) -> Result<Law, Error> {
        let (hidden, hidden_error) = self.missed(i);
        let mut law = Law { parts: Vec::new(), hidden, hidden_error };
        for (index, seen) in visible(sight).filter(|&(index, _)| self.0[i].0.reaches(index)) {
            let f = |y: DVec3| {
                let p = self.densities(index, seen, y);
                [seen.g(y) * over(weighting, self.expected(p), i), p[i]]
            };
            let pieces = self.cut(index, seen);
            law.parts.extend(match weighting {
                Weighting::Balance | Weighting::Power => by_cubature(index, seen, &pieces, f)?,
                Weighting::Cutoff | Weighting::Maximum => by_rough_cubature(index, seen, &pieces, f)?,
                _ => return Err(Error::NoFormula),
            });
        }
        Ok(law)
    }
}

/// w_i/q_i; zero where nothing is drawn, as on the horizon itself.
pub fn over(weighting: Weighting, q: [f64; 3], i: usize) -> f64 {
    let most = q.iter().copied().fold(0.0, f64::max);
    if most <= 0.0 {
        return 0.0;
    }
    let sum_from = |bound: f64| q.iter().filter(|&&q| q >= bound).sum::<f64>();
    match weighting {
        Weighting::Power => q[i] / q.iter().map(|q| q * q).sum::<f64>(),
        Weighting::Cutoff if q[i] < CUT * most => 0.0,
        Weighting::Cutoff => 1.0 / sum_from(CUT * most),
        Weighting::Maximum if q.iter().position(|&q| q == most) != Some(i) => 0.0,
        Weighting::Maximum => 1.0 / most,
        _ => 1.0 / sum_from(0.0),
    }
}

/// The law of one sample of A p_1 + (1 − A) p_2.
///
/// # Errors
/// As [`Density::new`]; [`Error::NotConverged`].
pub fn mixture(sight: &Sight, share: f64, pair: [Technique; 2]) -> Result<Law, Error> {
    let [one, other] = [Density::new(sight, pair[0])?, Density::new(sight, pair[1])?];
    let mix = |one: f64, other: f64| share * one + (1.0 - share) * other;
    let hidden = mix(one.missed().0, other.missed().0);
    let mut law = Law { parts: Vec::new(), hidden, hidden_error: mix(one.missed().1, other.missed().1) };
    for (index, seen) in visible(sight) {
        let pieces = cut([&one, &other].into_iter(), index, seen);
        law.parts.extend(by_cubature(index, seen, &pieces, |y| {
            let p = mix(one.per_area(index, seen, y), other.per_area(index, seen, y));
            // On the horizon itself nothing arrives, and nothing may be drawn.
            [if p > 0.0 { seen.g(y) / p } else { 0.0 }, p]
        })?);
    }
    Ok(law)
}

/// What x sees of a facet, in pieces on which all of some densities are smooth.
pub fn cut<'d, 's>(mut densities: impl Iterator<Item = &'d Density>, index: usize, seen: &'s Seen) -> Cow<'s, Pieces> {
    densities.find_map(|density| density.cut(index, seen)).unwrap_or(Cow::Borrowed(&seen.pieces))
}

/// The facets of which x sees something.
pub fn visible(sight: &Sight) -> impl Iterator<Item = (usize, &Seen)> {
    sight.seen.iter().enumerate().filter(|(_, seen)| seen.is_visible())
}
