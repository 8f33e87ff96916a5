//! From the binary tree to the wide one: which of its nodes become nodes with sixteen children, which become packets.
//!
//! Ylitie, Karras, Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", section 3.1:
//! C(n, i) is the least cost of a subtree n that is given as at most i nodes or packets of the wide tree,
//!
//! ```text
//! C(n, 1) = min(A_n · c_packet where the subtree fits in a packet, A_n · c_node + min over k of C(l, k) + C(r, 16 − k))
//! C(n, i) = min(C(n, i − 1), min over 0 < k < i of C(l, k) + C(r, i − k))
//! ```
//!
//! with A_n the area of its box and l, r its two children. Unlike there, a packet costs the same whatever it holds.

use super::binary::{Binary, Place};
use super::node::{FAN, WIDTH};

/// What a packet costs against a node: their times for one ray.
const PACKET_COST: f32 = 1.0;

/// The choices that make the wide tree cheapest.
pub(super) struct Collapse<'b> {
    binary: &'b Binary,
    choices: Vec<Choice>,
}

/// The choices at one node of the binary tree.
#[derive(Clone, Copy)]
struct Choice {
    /// `share[i − 1]`: how many of i parts the left child gets; 0 where fewer than i parts are no worse. The first
    /// counts for a node of the wide tree, which has sixteen.
    share: [u8; FAN - 1],
    /// Whether the subtree, given as one part, is a packet.
    packet: bool,
}

/// What is known of a subtree whose choices are made.
struct Subtree {
    /// `costs[i − 1]` is C(n, i).
    costs: [f32; FAN - 1],
    triangles: usize,
}

impl Subtree {
    /// The most parts, of those that costs are kept for, that it can fall into.
    fn most(&self) -> usize {
        self.triangles.min(FAN - 1)
    }
}

impl<'b> Collapse<'b> {
    /// Finds the cheapest choices, from the leaves up.
    pub(super) fn new(binary: &'b Binary) -> Self {
        let mut choices = vec![Choice { share: [0; FAN - 1], packet: true }; binary.len()];
        let mut waiting: Vec<Subtree> = Vec::new();
        for &node in downward(binary).iter().rev() {
            let area = binary.half_area(node);
            let subtree = match binary.at(node) {
                Place::Triangle(_) => Subtree { costs: [area * PACKET_COST; FAN - 1], triangles: 1 },
                Place::Pair(_) => {
                    let right = waiting.len() - 1;
                    let (subtree, choice) = choose(area, &waiting[right - 1], &waiting[right]);
                    waiting.truncate(right - 1);
                    choices[node as usize] = choice;
                    subtree
                }
            };
            waiting.push(subtree);
        }
        Self { binary, choices }
    }

    /// Whether a subtree becomes a packet.
    pub(super) fn is_packet(&self, node: u32) -> bool {
        self.choices[node as usize].packet
    }

    /// The up to sixteen parts that a subtree falls into, the largest first, where it becomes a node.
    pub(super) fn parts(&self, node: u32) -> Vec<u32> {
        let mut parts = Vec::with_capacity(FAN);
        if let Place::Pair([left, right]) = self.binary.at(node) {
            let share = usize::from(self.choices[node as usize].share[0]);
            self.split(left, share, &mut parts);
            self.split(right, FAN - share, &mut parts);
        }
        parts.sort_by(|&one, &other| self.binary.half_area(other).total_cmp(&self.binary.half_area(one)));
        parts
    }

    /// The triangles of a subtree that becomes a packet.
    pub(super) fn triangles(&self, node: u32) -> Vec<u32> {
        let mut found = Vec::with_capacity(WIDTH);
        self.gather(node, &mut found);
        found
    }

    fn gather(&self, node: u32, found: &mut Vec<u32>) {
        match self.binary.at(node) {
            Place::Triangle(triangle) => found.push(triangle),
            Place::Pair(children) => children.into_iter().for_each(|child| self.gather(child, found)),
        }
    }

    /// Gives a subtree as at most `count` parts.
    fn split(&self, node: u32, count: usize, parts: &mut Vec<u32>) {
        let share = &self.choices[node as usize].share;
        let wanted = (1..count).rev().map(|i| (i + 1, usize::from(share[i]))).find(|&(_, left)| left > 0);
        match (wanted, self.binary.at(node)) {
            (Some((count, for_left)), Place::Pair([left, right])) => {
                self.split(left, for_left, parts);
                self.split(right, count - for_left, parts);
            }
            _ => parts.push(node),
        }
    }
}

/// A subtree whose box has half this area, of its two children. More parts than triangles are no cheaper, so that only as
/// many are tried.
fn choose(area: f32, left: &Subtree, right: &Subtree) -> (Subtree, Choice) {
    let triangles = left.triangles + right.triangles;
    let best = |parts: usize| {
        let some = parts.saturating_sub(right.most()).max(1)..=left.most().min(parts - 1);
        let costs = some.map(|k| (left.costs[k - 1] + right.costs[parts - k - 1], k));
        costs.fold((f32::INFINITY, 0), |best, next| if next.0 < best.0 { next } else { best })
    };
    let (parts, share) = best(triangles.min(FAN));
    let node = area + parts;
    let packet = if triangles <= WIDTH { area * PACKET_COST } else { f32::INFINITY };
    let mut costs = [packet.min(node); FAN - 1];
    let mut choice = Choice { share: [share as u8; FAN - 1], packet: packet <= node };
    for i in 2..FAN {
        let (parts, share) = best(i);
        let cheaper = parts < costs[i - 2];
        costs[i - 1] = if cheaper { parts } else { costs[i - 2] };
        choice.share[i - 1] = if cheaper { share as u8 } else { 0 };
    }
    (Subtree { costs, triangles }, choice)
}

/// All nodes, each before its children, right ones first: backwards, whatever lies below a node comes right before it, left
/// before right.
fn downward(binary: &Binary) -> Vec<u32> {
    let mut order = Vec::with_capacity(binary.len());
    let mut left = if binary.len() == 0 { Vec::new() } else { vec![0] };
    while let Some(node) = left.pop() {
        order.push(node);
        if let Place::Pair(children) = binary.at(node) {
            left.extend(children);
        }
    }
    order
}
