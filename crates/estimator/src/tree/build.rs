//! Which targets stand together: a binary tree from above, each node cut where its two sides cost least.

use glam::DVec3;

use super::bounds::Bounds;
use super::cone::Cone;
use super::emitter::Emitter;
use super::row::{self, Row};

/// Bins along an axis, between which a node may be cut.
const BINS: usize = 16;

/// The tree as it grows.
pub(super) struct Build<'e> {
    emitters: &'e [Emitter],
    /// What rows are relative to.
    origin: DVec3,
    /// A row for each node that has two children, before those of its children; first come those on its left.
    pub(super) rows: Vec<Row>,
    /// Targets left of the cut of each such node.
    pub(super) left: Vec<u32>,
}

impl<'e> Build<'e> {
    /// Puts targets in the order of the tree's leaves.
    pub(super) fn new(emitters: &'e [Emitter], origin: DVec3, order: &mut [u32]) -> Self {
        let mut build = Self { emitters, origin, rows: Vec::new(), left: Vec::new() };
        build.grow(order);
        build
    }

    fn grow(&mut self, targets: &mut [u32]) {
        if targets.len() < 2 {
            return;
        }
        let left = self.cut(targets);
        let (one, other) = targets.split_at_mut(left);
        let children = [self.child(one), self.child(other)];
        self.rows.push(row::of(children));
        self.left.push(left as u32);
        self.grow(one);
        self.grow(other);
    }

    /// What a walk is told of some targets: a ball around them, a cone around their normals, and their power.
    fn child(&self, targets: &[u32]) -> [f32; row::CHILD] {
        let emitters = || targets.iter().map(|&target| &self.emitters[target as usize]);
        let bounds = self.bounds(targets);
        let corners = emitters().flat_map(Emitter::corners);
        let radius = corners.map(|corner| corner.distance(bounds.middle())).fold(0.0, f64::max);
        let normals: DVec3 = emitters().map(|emitter| emitter.normal * emitter.power).sum();
        let cone = match normals.try_normalize() {
            Some(axis) => {
                let cos = emitters().map(|emitter| emitter.normal.dot(axis)).fold(1.0, f64::min);
                let around = Cone { axis, spread: libm::acos(cos.max(-1.0)) };
                if around.spread < bounds.normals.spread { around } else { bounds.normals }
            }
            None => bounds.normals,
        };
        row::child(bounds.middle() - self.origin, radius, cone, bounds.both, bounds.power)
    }

    fn bounds(&self, targets: &[u32]) -> Bounds {
        let mut each = targets.iter().map(|&target| Bounds::from(&self.emitters[target as usize]));
        let first = each.next().expect("a node holds a target");
        each.fold(first, |bounds, next| bounds.with(&next))
    }

    /// Puts the targets on the left of the best cut first, and says how many they are: half of them where no cut parts them.
    fn cut(&self, targets: &mut [u32]) -> usize {
        let middle = |target: &u32| self.emitters[*target as usize].middle();
        let (low, high) = targets
            .iter()
            .map(middle)
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        let size = high - low;
        let axes = (0..3).filter(|&axis| size[axis] > 0.0);
        let cuts = axes.filter_map(|axis| self.best(targets, axis, low[axis], size));
        let best = cuts.min_by(|one, other| one.cost.total_cmp(&other.cost));
        let Some(Cut { axis, before, .. }) = best else { return targets.len() / 2 };
        targets.sort_by_key(|target| bin(middle(target)[axis], low[axis], size[axis]) >= before);
        targets.partition_point(|target| bin(middle(target)[axis], low[axis], size[axis]) < before)
    }

    /// The cheapest cut across an axis.
    fn best(&self, targets: &[u32], axis: usize, low: f64, size: DVec3) -> Option<Cut> {
        let mut bins: [Option<Bounds>; BINS] = [None; BINS];
        for &target in targets {
            let emitter = &self.emitters[target as usize];
            let slot = &mut bins[bin(emitter.middle()[axis], low, size[axis])];
            *slot = both(*slot, Some(Bounds::from(emitter)));
        }
        let stretch = size.max_element() / size[axis];
        let sums = |bins: &mut dyn Iterator<Item = &Option<Bounds>>| {
            let before = |sum: &mut Option<Bounds>, next: &Option<Bounds>| {
                let after = both(*sum, *next);
                Some(std::mem::replace(sum, after))
            };
            bins.scan(None, before).collect::<Vec<_>>()
        };
        let before = sums(&mut bins.iter().chain([&None]));
        let mut after = sums(&mut bins.iter().rev().chain([&None]));
        after.reverse();
        let cut = |k: usize| {
            let cost = before[k]?.cost() + after[k]?.cost();
            Some(Cut { axis, before: k, cost: stretch * cost })
        };
        (1..BINS).filter_map(cut).min_by(|one, other| one.cost.total_cmp(&other.cost))
    }
}

/// Where to cut: across an axis, before a bin.
struct Cut {
    axis: usize,
    before: usize,
    cost: f64,
}

fn bin(at: f64, low: f64, size: f64) -> usize {
    (((at - low) / size * BINS as f64) as usize).min(BINS - 1)
}

fn both(one: Option<Bounds>, other: Option<Bounds>) -> Option<Bounds> {
    match (one, other) {
        (Some(one), Some(other)) => Some(one.with(&other)),
        (one, other) => one.or(other),
    }
}
