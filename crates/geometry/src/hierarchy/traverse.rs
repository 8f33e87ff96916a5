//! Walking the tree along a ray.

use fearless_simd::{Simd, f32x8, prelude::*};

use super::Hierarchy;
use super::node::{Child, Node, WIDTH};
use super::probe::Probe;
use super::stack::{Stack, entry, parts};
use crate::ray::{Hit, Ray};
use crate::tracer::meet;

/// The nearest triangle along the ray, the lower index of those at one distance; nearer children first.
#[inline(always)]
pub(super) fn closest<S: Simd>(simd: S, tree: &Hierarchy, ray: &Ray) -> Option<Hit> {
    let probe = Probe::new(simd, ray, tree.magnitude);
    let (mut best, mut reach) = (None, f32::INFINITY);
    let mut stack = Stack::new();
    let mut next = tree.root;
    while let Some(child) = next {
        if child.is_packet() {
            let found = closest_in(simd, tree, child, ray, &probe, reach, best);
            if found != best {
                best = found;
                reach = best.map_or(f32::INFINITY, |hit| probe.reach(hit.t));
            }
            next = pop_within(&mut stack, reach);
        } else {
            let node = &tree.nodes[child.index()];
            let (entered, distances) = node.enter(simd, &probe, f32x8::splat(simd, reach));
            next = nearest(node, entered, &distances.to_array(), &mut stack).or_else(|| pop_within(&mut stack, reach));
        }
    }
    best
}

/// Whether the ray meets a triangle at a distance below `before` for which `blocks` holds; larger children first, which
/// are the likelier to block.
#[inline(always)]
pub(super) fn any<S: Simd>(
    simd: S,
    tree: &Hierarchy,
    ray: &Ray,
    before: f64,
    blocks: &impl Fn(u32) -> bool,
) -> bool {
    let probe = Probe::new(simd, ray, tree.magnitude);
    let reach = f32x8::splat(simd, probe.reach(before));
    let mut stack = Stack::new();
    let mut next = tree.root;
    while let Some(child) = next {
        if child.is_packet() {
            let packet = &tree.packets[child.index()];
            let mut candidates = packet.candidates(simd, &probe, reach);
            while candidates != 0 {
                let lane = candidates.trailing_zeros() as usize;
                candidates &= candidates - 1;
                let triangle = || tree.triangles[child.index()][lane % WIDTH];
                if meet(&packet.triangle(lane % WIDTH), ray).is_some_and(|t| t < before) && blocks(triangle()) {
                    return true;
                }
            }
        } else {
            let node = &tree.nodes[child.index()];
            let (mut entered, _) = node.enter(simd, &probe, reach);
            while entered != 0 {
                let slot = (31 - entered.leading_zeros()) as usize % WIDTH;
                entered ^= 1 << slot;
                stack.push(u64::from(node.children[slot].bits()));
            }
        }
        next = stack.pop().map(|entry| parts(entry).1);
    }
    false
}

/// The best of a hit and those in a packet.
#[inline(always)]
fn closest_in<S: Simd>(
    simd: S,
    tree: &Hierarchy,
    child: Child,
    ray: &Ray,
    probe: &Probe<S>,
    reach: f32,
    mut best: Option<Hit>,
) -> Option<Hit> {
    let packet = &tree.packets[child.index()];
    let mut candidates = packet.candidates(simd, probe, f32x8::splat(simd, reach));
    while candidates != 0 {
        let lane = candidates.trailing_zeros() as usize % WIDTH;
        candidates &= candidates - 1;
        if let Some(t) = meet(&packet.triangle(lane), ray) {
            let hit = Hit { t, triangle: tree.triangles[child.index()][lane] };
            if best.is_none_or(|best| hit.before(&best)) {
                best = Some(hit);
            }
        }
    }
    best
}

/// The nearest of the children entered; the others go on the stack, the farthest first.
#[inline(always)]
fn nearest(node: &Node, mut entered: u32, distances: &[f32; WIDTH], stack: &mut Stack) -> Option<Child> {
    let mut sorted = [0; WIDTH];
    let mut count = 0;
    while entered != 0 {
        let slot = entered.trailing_zeros() as usize % WIDTH;
        entered &= entered - 1;
        let new = entry(distances[slot], node.children[slot]);
        let mut place = count;
        while place > 0 && sorted[place - 1] < new {
            sorted[place] = sorted[place - 1];
            place -= 1;
        }
        sorted[place] = new;
        count += 1;
    }
    let (last, others) = sorted[..count].split_last()?;
    others.iter().for_each(|&entry| stack.push(entry));
    Some(parts(*last).1)
}

/// The next on the stack that begins within reach.
#[inline(always)]
fn pop_within(stack: &mut Stack, reach: f32) -> Option<Child> {
    loop {
        let (distance, child) = parts(stack.pop()?);
        if distance <= reach {
            return Some(child);
        }
    }
}
