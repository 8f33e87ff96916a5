//! Up to eight rays that run alike, led through the tree together.

use fearless_simd::{Simd, f32x16, prelude::*};

use super::Hierarchy;
use super::best::Best;
use super::node::{Node, WIDTH};
use super::probe::{Probe, STRETCH};
use super::stack::Stack;
use super::traverse::{closest_in, nearest, within_reach};
use crate::ray::{Hit, Ray, Shear};

/// All rays of a bundle as one: intervals of their origins and of the inverses of their directions.
///
/// A box is entered by none where it is not entered by this one: its distance is the least that (b − o)·r takes for the
/// nearest faces b, and it leaves at the greatest for the farthest (Reshetov, Soupikov, Hurley 2005, "Multi-Level Ray
/// Tracing Algorithm").
struct Bundle {
    /// The rows of a node with the faces where all enter, and those where all leave.
    near: [usize; 3],
    far: [usize; 3],
    /// The origins that are farthest ahead, which enter first, and those farthest back.
    ahead: [f32; 3],
    back: [f32; 3],
    /// The least and the greatest 1/d.
    rates: [[f32; 2]; 3],
}

impl Bundle {
    /// The bundle of some rays; `None` where they do not run to the same side along every axis.
    #[inline(always)]
    fn new(probes: &[Probe]) -> Option<Self> {
        let first = probes.first()?;
        let (mut ahead, mut back, mut rates) = ([0.0; 3], [0.0; 3], [[0.0; 2]; 3]);
        for k in 0..3 {
            let forward = first.rate[k] > 0.0;
            let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
            rates[k] = [f32::INFINITY, f32::NEG_INFINITY];
            for probe in probes {
                if (probe.rate[k] > 0.0) != forward {
                    return None;
                }
                low = low.min(probe.place[k] - probe.apart[k]);
                high = high.max(probe.place[k] + probe.apart[k]);
                rates[k] = [rates[k][0].min(probe.rate[k]), rates[k][1].max(probe.rate[k])];
            }
            (ahead[k], back[k]) = if forward { (high, low) } else { (low, high) };
        }
        Some(Self { near: first.near, far: first.far, ahead, back, rates })
    }

    /// Which children may be entered before `reach`, a bit each, and where at the earliest.
    #[inline(always)]
    fn enter<S: Simd>(&self, simd: S, node: &Node, reach: f32) -> (u32, f32x16<S>) {
        let entry = self.soonest(simd, node, 0).max(self.soonest(simd, node, 1)).max(self.soonest(simd, node, 2));
        let exit = self.latest(simd, node, 0).min(self.latest(simd, node, 1)).min(self.latest(simd, node, 2));
        let (entry, exit) = (entry.max(0.0), (exit * STRETCH).min(f32x16::splat(simd, reach)));
        (entry.simd_le(exit).to_bitmask() as u32, entry)
    }

    /// The least distance of the faces where all enter, along one axis.
    #[inline(always)]
    fn soonest<S: Simd>(&self, simd: S, node: &Node, k: usize) -> f32x16<S> {
        let way = node.face(simd, self.near[k]) - self.ahead[k];
        (way * self.rates[k][0]).min(way * self.rates[k][1])
    }

    /// The greatest distance of the faces where all leave, along one axis.
    #[inline(always)]
    fn latest<S: Simd>(&self, simd: S, node: &Node, k: usize) -> f32x16<S> {
        let way = node.face(simd, self.far[k]) - self.back[k];
        (way * self.rates[k][0]).max(way * self.rates[k][1])
    }
}

/// The nearest triangle along each of up to eight rays; `false`, and no answers, where they do not run alike.
#[inline(always)]
pub(super) fn closest<S: Simd, T: Stack>(simd: S, tree: &Hierarchy, rays: &[Ray], hits: &mut [Option<Hit>]) -> bool {
    let mut shears = [Shear::NONE; WIDTH];
    let mut probes = [Probe::NONE; WIDTH];
    for (k, ray) in rays.iter().enumerate().take(WIDTH) {
        shears[k] = Shear::new(ray);
        probes[k] = Probe::new(ray, &shears[k], tree.magnitude);
    }
    let count = rays.len().min(WIDTH);
    let Some(bundle) = Bundle::new(&probes[..count]) else {
        return false;
    };
    let (mut best, mut reach) = ([Best::NOTHING; WIDTH], [f32::INFINITY; WIDTH]);
    let mut farthest = f32::INFINITY;
    let mut stack = T::new();
    let mut next = tree.root.map(|root| (0.0, root));
    while let Some((start, child)) = next {
        next = if child.is_packet() {
            for k in 0..count {
                closest_in(
                    simd,
                    tree,
                    (start, child),
                    (&rays[k], &shears[k], &probes[k]),
                    (&mut best[k], &mut reach[k]),
                );
            }
            farthest = reach[..count].iter().copied().fold(0.0, f32::max);
            None
        } else {
            let node = &tree.nodes[child.index()];
            let (entered, distances) = bundle.enter(simd, node, farthest);
            nearest(node, entered, distances.as_array(), &mut stack)
        };
        next = next.or_else(|| within_reach(&mut stack, farthest));
    }
    for (hit, best) in hits.iter_mut().zip(best) {
        *hit = best.hit(tree);
    }
    true
}
