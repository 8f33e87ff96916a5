//! Walking the tree along a ray.

use fearless_simd::{Simd, f32x8, prelude::*};

use super::Hierarchy;
use super::node::{Child, Node, WIDTH};
use super::probe::{Probe, reach_of};
use super::stack::{Stack, entry, parts};
use crate::ray::{Hit, Ray, Shear};

/// The nearest triangle along the ray, the lower index of those at one distance; nearer children first.
#[inline(always)]
pub(super) fn closest<S: Simd, T: Stack>(simd: S, tree: &Hierarchy, ray: &Ray) -> Option<Hit> {
    let shear = Shear::new(ray);
    let probe = Probe::new(ray, &shear, tree.magnitude);
    let mut best = Hit { t: f64::INFINITY, triangle: u32::MAX };
    let mut reach = f32::INFINITY;
    let mut stack = T::new();
    let mut next = tree.root;
    while let Some(child) = next {
        next = if child.is_packet() {
            let (packet, triangles) = (&tree.packets[child.index()], &tree.triangles[child.index()]);
            for lane in lanes(packet.candidates(simd, &probe, f32x8::splat(simd, reach))) {
                if let Some(t) = packet.meet(lane, ray, &shear, probe.magnitude).filter(|&t| t <= best.t) {
                    let hit = Hit { t, triangle: triangles[lane] };
                    best = if hit.before(&best) { hit } else { best };
                    reach = reach_of(best.t);
                }
            }
            None
        } else {
            let node = &tree.nodes[child.index()];
            let (entered, distances) = node.enter(simd, &probe, f32x8::splat(simd, reach));
            nearest(node, entered, distances.as_array(), &mut stack)
        };
        while next.is_none() {
            let Some(entry) = stack.pop() else { break };
            let (distance, child) = parts(entry);
            next = (distance <= reach).then_some(child);
        }
    }
    (best.t < f64::INFINITY).then_some(best)
}

/// Whether the ray meets a triangle at a distance below `before` for which `blocks` holds; larger children first, which
/// are the likelier to block.
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
    let reach = f32x8::splat(simd, reach_of(before));
    let mut stack = T::new();
    let mut next = tree.root;
    while let Some(child) = next {
        if child.is_packet() {
            let packet = &tree.packets[child.index()];
            for lane in lanes(packet.candidates(simd, &probe, reach)) {
                let met = packet.meet(lane, ray, &shear, probe.magnitude).is_some_and(|t| t < before);
                if met && blocks(tree.triangles[child.index()][lane]) {
                    return true;
                }
            }
        } else {
            let node = &tree.nodes[child.index()];
            let (entered, _) = node.enter(simd, &probe, reach);
            for slot in lanes(entered.reverse_bits() >> (u32::BITS - WIDTH as u32)) {
                stack.push(entry(0.0, node.children[WIDTH - 1 - slot]));
            }
        }
        next = stack.pop().map(|entry| parts(entry).1);
    }
    false
}

/// The lanes of a mask, lowest first.
#[inline(always)]
pub(super) fn lanes(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = mask.trailing_zeros() as usize % WIDTH;
        (mask != 0).then(|| {
            mask &= mask - 1;
            lane
        })
    })
}

/// The nearest of the children entered; the others go on the stack, the farthest first.
#[inline(always)]
fn nearest(node: &Node, entered: u32, distances: &[f32; WIDTH], stack: &mut impl Stack) -> Option<Child> {
    let child = |slot: usize| entry(distances[slot], node.children[slot]);
    let mut slots = lanes(entered);
    let first = child(slots.next()?);
    let Some(second) = slots.next().map(child) else {
        return Some(parts(first).1);
    };
    let Some(third) = slots.next().map(child) else {
        stack.push(first.max(second));
        return Some(parts(first.min(second)).1);
    };
    let mut sorted = [first, second, third, 0, 0, 0, 0, 0];
    let mut count = 3;
    for slot in slots {
        sorted[count % WIDTH] = child(slot);
        count += 1;
    }
    let sorted = &mut sorted[..count];
    sorted.sort_unstable_by(|one, other| other.cmp(one));
    let (last, others) = sorted.split_last()?;
    others.iter().for_each(|&entry| stack.push(entry));
    Some(parts(*last).1)
}
