//! Walking the tree along a ray.

use fearless_simd::{Simd, prelude::*};

use super::Hierarchy;
use super::best::Best;
use super::crossings::Crossings;
use super::node::{Child, FAN, Node, WIDTH};
use super::probe::{Probe, reach_of, short_of};
use super::stack::{Stack, entry, parts};
use crate::ray::{Hit, Ray, Shear};

/// The nearest triangle along the ray, the lower index of those at one distance; nearer children first.
#[inline(always)]
pub(super) fn closest<S: Simd, T: Stack>(simd: S, tree: &Hierarchy, ray: &Ray) -> Option<Hit> {
    let shear = Shear::new(ray);
    let probe = Probe::new(ray, &shear, tree.magnitude);
    let (mut best, mut reach) = (Best::NOTHING, f32::INFINITY);
    let mut stack = T::new();
    let mut next = tree.root.map(|root| (0.0, root));
    while let Some((start, child)) = next {
        next = if child.is_packet() {
            closest_in(simd, tree, (start, child), (ray, &shear, &probe), (&mut best, &mut reach));
            None
        } else {
            let node = &tree.nodes[child.index()];
            let (entered, distances) = node.enter(simd, &probe, reach);
            nearest(node, entered, distances.as_array(), &mut stack)
        };
        next = next.or_else(|| within_reach(&mut stack, reach));
    }
    best.hit(tree)
}

/// Takes what is nearer in a packet, which begins at `start` or later, for the best hit, and how far that reaches.
///
/// Nothing is behind where the packet begins ahead of the origin, and nothing beyond where nothing was met: there edges
/// alone say what is possible, and binary64 need not wait for depths.
#[inline(always)]
pub(super) fn closest_in<S: Simd>(
    simd: S,
    tree: &Hierarchy,
    (start, child): (f32, Child),
    (ray, shear, probe): (&Ray, &Shear, &Probe),
    (best, reach): (&mut Best, &mut f32),
) {
    let packet = &tree.packets[child.index()];
    let crossings = Crossings::new(simd, packet, probe);
    let plain = start > 0.0 && best.packet == Child::NONE;
    let possible = if plain { crossings.inside() } else { crossings.possible(probe, *reach) };
    for lane in lanes::<WIDTH>(possible) {
        if let Some(t) = packet.meet(lane, ray, shear, f64::from(probe.magnitude)).filter(|&t| t <= best.t) {
            let new = Best { t, packet: child, lane };
            if new.before(best, tree) {
                (*best, *reach) = (new, reach_of(t));
            }
        }
    }
}

/// Whether the ray meets a triangle at a distance below `before` for which `blocks` holds; larger children first, which
/// are the likelier to block, and a node's packets before what is below it.
#[inline(always)]
pub(super) fn any<S: Simd, T: Stack>(
    simd: S,
    tree: &Hierarchy,
    ray: &Ray,
    before: f64,
    blocks: &impl Fn(u32) -> bool,
) -> bool {
    let shear = Shear::new(ray);
    let probe = Probe::new(ray, &shear, tree.magnitude);
    let reach = reach_of(before);
    let mut stack = T::new();
    let mut next = tree.root;
    while let Some(child) = next {
        let node = &tree.nodes[child.index()];
        let entered = node.enter(simd, &probe, reach).0;
        next = largest(node, entered & !node.packets, &mut stack).or_else(|| stack.pop().map(|entry| parts(entry).1));
        for slot in lanes::<FAN>(entered & node.packets) {
            if any_in(simd, tree, node.children[slot], (ray, &shear, &probe), (before, reach), blocks) {
                return true;
            }
        }
    }
    false
}

/// Whether the ray meets a triangle of a packet before its end for which `blocks` holds.
#[inline(always)]
fn any_in<S: Simd>(
    simd: S,
    tree: &Hierarchy,
    child: Child,
    (ray, shear, probe): (&Ray, &Shear, &Probe),
    (before, reach): (f64, f32),
    blocks: &impl Fn(u32) -> bool,
) -> bool {
    let packet = &tree.packets[child.index()];
    let crossings = Crossings::new(simd, packet, probe);
    let possible = crossings.possible(probe, reach);
    if possible == 0 {
        return false;
    }
    let certain = crossings.certain(packet, probe, short_of(before));
    for lane in lanes::<WIDTH>(certain) {
        if blocks(tree.triangles[child.index()][lane]) {
            return true;
        }
    }
    for lane in lanes::<WIDTH>(possible & !certain) {
        let t = packet.meet(lane, ray, shear, f64::from(probe.magnitude));
        if t.is_some_and(|t| t < before) && blocks(tree.triangles[child.index()][lane]) {
            return true;
        }
    }
    false
}

/// The lanes of a mask, lowest first, all below N.
#[inline(always)]
pub(super) fn lanes<const N: usize>(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = mask.trailing_zeros() as usize % N;
        (mask != 0).then(|| {
            mask &= mask - 1;
            lane
        })
    })
}

/// The largest of the children entered; the others go on the stack, the smallest first.
#[inline(always)]
fn largest(node: &Node, entered: u32, stack: &mut impl Stack) -> Option<Child> {
    let mut others = entered & entered.wrapping_sub(1);
    while others != 0 {
        let slot = others.ilog2() as usize % FAN;
        others ^= 1 << slot;
        stack.push(entry(0.0, node.children[slot]));
    }
    (entered != 0).then(|| node.children[entered.trailing_zeros() as usize % FAN])
}

/// The nearest of the children entered, and where; the others go on the stack, the second nearest on top.
#[inline(always)]
pub(super) fn nearest(
    node: &Node,
    entered: u32,
    distances: &[f32; FAN],
    stack: &mut impl Stack,
) -> Option<(f32, Child)> {
    let child = |slot: usize| entry(distances[slot], node.children[slot]);
    let mut slots = lanes::<FAN>(entered);
    let only = slots.next()?;
    let Some(other) = slots.next().map(child) else {
        return Some((distances[only], node.children[only]));
    };
    let only = child(only);
    let (mut first, mut second) = (only.min(other), only.max(other));
    for other in slots.map(child) {
        stack.push(second.max(other));
        let nearer = second.min(other);
        second = first.max(nearer);
        first = first.min(nearer);
    }
    stack.push(second);
    Some(parts(first))
}

/// The next on the stack that begins within reach, and where.
#[inline(always)]
pub(super) fn within_reach(stack: &mut impl Stack, reach: f32) -> Option<(f32, Child)> {
    loop {
        let (distance, child) = parts(stack.pop()?);
        if distance <= reach {
            return Some((distance, child));
        }
    }
}
