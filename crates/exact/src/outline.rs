//! Line integrals along the outlines of what x sees: what an outline's uncertainty does to an integral.

use glam::DVec3;

use crate::gauss::{FEW, HIGH};
use crate::visible::Pieces;

/// Σ over edges of ∫ |f| dl, l the length along the edge in metres. With l = d sinh τ from the
/// edge's point nearest to x, at distance d, functions of r = √(d² + l²) are smooth in τ however
/// near the edge passes: a few nodes suffice for an error bound. An edge shorter than d needs no τ.
pub fn line_integral<const K: usize>(pieces: &Pieces, f: impl Fn(DVec3) -> [f64; K]) -> [f64; K] {
    let mut sum = [0.0; K];
    for polygon in pieces.iter() {
        let next = polygon.iter().cycle().skip(1);
        for (&v, &w) in polygon.iter().zip(next) {
            add_edge(&mut sum, v, w, &f);
        }
    }
    sum
}

fn add_edge<const K: usize>(sum: &mut [f64; K], v: DVec3, w: DVec3, f: &impl Fn(DVec3) -> [f64; K]) {
    let Some(along) = (w - v).try_normalize() else {
        return;
    };
    let (from, to) = (v.dot(along), w.dot(along));
    let nearest = v - along * from;
    let d = nearest.length();
    let mut add = |l: f64, dl: f64| {
        let value = f(nearest + along * l);
        for k in 0..K {
            sum[k] += value[k].abs() * dl;
        }
    };
    if to - from < d {
        let length = to - from;
        FEW.iter().for_each(|&(t, weight)| add(from + length * t, length * weight));
        return;
    }
    let (tau0, tau1) = ((from / d).asinh(), (to / d).asinh());
    for &(t, weight) in HIGH.iter() {
        let l = d * (tau0 + (tau1 - tau0) * t).sinh();
        add(l, (d * d + l * l).sqrt() * (tau1 - tau0) * weight);
    }
}
