//! Neighbouring targets in clusters: what x can tell of many targets at once.
//!
//! A scene may have thousands of targets, of which x sees the light of few. A binary tree over them, built once, lets whole
//! clusters be passed over that lie below x's horizon or turn their dark sides to it.

use std::ops::Range;

use glam::{DVec3, Vec3};

use crate::frame::Frame;
use crate::mesh::Mesh;
use crate::target::{Sides, Target};

/// A tree over targets.
#[derive(Clone, Debug)]
pub struct Clusters {
    /// Depth first: the first half of a cluster follows it.
    nodes: Vec<Node>,
    /// Targets by number; each cluster is a run of them.
    targets: Vec<u32>,
}

#[derive(Clone, Debug)]
struct Node {
    low: Vec3,
    high: Vec3,
    normals: Normals,
    targets: Range<u32>,
    /// Index of the second half; `None` for a cluster that has no halves.
    second: Option<u32>,
}

/// The cone that holds the front normals of one-sided targets; all directions where a target is two-sided.
#[derive(Clone, Copy, Debug)]
struct Normals {
    axis: DVec3,
    sin: f64,
    cos: f64,
}

/// Most targets of a cluster that has no halves.
const LEAF: usize = 4;
/// What rounding may add to a sine or, over the largest coordinate, to a height.
const SLACK: f64 = 1e-9;

impl Clusters {
    /// Builds the tree, by halves along the longest extent.
    pub fn new(mesh: &Mesh, targets: &[Target]) -> Self {
        let mut leaves: Vec<Leaf> = (0..).zip(targets).map(|(k, target)| Leaf::of(mesh, target, k)).collect();
        let mut nodes = Vec::with_capacity(targets.len());
        if !leaves.is_empty() {
            grow(&mut nodes, &mut leaves, 0);
        }
        Self { nodes, targets: leaves.into_iter().map(|leaf| leaf.target).collect() }
    }

    /// Offers clusters of targets, each the numbers of some targets: first all of them, and where `take` answers false, its
    /// halves instead, down to single targets, where the answer no longer matters. Clusters whose targets certainly all lie
    /// below the horizon of `frame`, or certainly all turn a dark side to x, are left out; others that x gets no light from
    /// may be offered. The order depends on targets alone.
    pub fn offer(&self, frame: &Frame, mut take: impl FnMut(&[u32]) -> bool) {
        let mut open: Vec<u32> = if self.nodes.is_empty() { Vec::new() } else { vec![0] };
        while let Some(index) = open.pop() {
            let node = &self.nodes[index as usize];
            if node.is_below(frame) || node.is_turned_away(frame.x()) {
                continue;
            }
            let targets = &self.targets[node.targets.start as usize..node.targets.end as usize];
            if take(targets) {
                continue;
            }
            match node.second {
                Some(second) => open.extend([second, index + 1]),
                None if targets.len() > 1 => targets.chunks(1).for_each(|one| _ = take(one)),
                None => {}
            }
        }
    }
}

/// A target before it has its place in the tree.
#[derive(Clone, Copy)]
struct Leaf {
    target: u32,
    low: Vec3,
    high: Vec3,
    /// The front normal of a one-sided target, else zero.
    normal: DVec3,
}

impl Leaf {
    fn of(mesh: &Mesh, target: &Target, index: u32) -> Self {
        let corners = target.corners(mesh);
        let [a, b, c, ..] = corners.as_slice() else { unreachable!("a target has three corners or four") };
        let [a, b, c] = [a, b, c].map(|v| v.as_dvec3());
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let (low, high) = bounds(corners.as_slice().iter().map(|&v| (v, v)));
        Self { target: index, low, high, normal: if target.sides == Sides::Front { normal } else { DVec3::ZERO } }
    }
}

fn bounds(boxes: impl Iterator<Item = (Vec3, Vec3)>) -> (Vec3, Vec3) {
    boxes.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), (l, h)| (low.min(l), high.max(h)))
}

/// Appends the cluster of `leaves`, the first of which has number `first` in the tree, and the clusters within.
fn grow(nodes: &mut Vec<Node>, leaves: &mut [Leaf], first: u32) {
    let (low, high) = bounds(leaves.iter().map(|leaf| (leaf.low, leaf.high)));
    let targets = first..first + leaves.len() as u32;
    let index = nodes.len();
    nodes.push(Node { low, high, normals: Normals::of(leaves), targets, second: None });
    if leaves.len() <= LEAF {
        return;
    }
    let centre = |leaf: &Leaf| leaf.low + leaf.high;
    let (low, high) = bounds(leaves.iter().map(|leaf| (centre(leaf), centre(leaf))));
    let axis = (high - low).max_position();
    let half = leaves.len() / 2;
    leaves
        .select_nth_unstable_by(half, |a, b| centre(a)[axis].total_cmp(&centre(b)[axis]).then(a.target.cmp(&b.target)));
    let (one, other) = leaves.split_at_mut(half);
    grow(nodes, one, first);
    nodes[index].second = Some(nodes.len() as u32);
    grow(nodes, other, first + half as u32);
}

impl Normals {
    const ALL: Self = Self { axis: DVec3::ZERO, sin: 0.0, cos: -1.0 };

    fn of(leaves: &[Leaf]) -> Self {
        let axis = leaves.iter().map(|leaf| leaf.normal).sum::<DVec3>().normalize_or_zero();
        let cos = leaves.iter().map(|leaf| axis.dot(leaf.normal)).fold(1.0, f64::min);
        // A two-sided target has no normal here, and so no cosine above zero.
        if cos <= 0.0 { Self::ALL } else { Self { axis, cos, sin: (1.0 - cos * cos).max(0.0).sqrt() } }
    }
}

impl Node {
    fn is_below(&self, frame: &Frame) -> bool {
        let (low, high) = (self.low.as_dvec3(), self.high.as_dvec3());
        let highest = DVec3::select(frame.n_x().cmpgt(DVec3::ZERO), high, low);
        let scale = low.abs().max(high.abs()).max(frame.x().abs()).max_element();
        frame.n_x().dot(highest - frame.x()) < -SLACK * scale
    }

    /// Whether N·(x − y) < 0 for every normal and every point y of the box. With θ the angle between the axis and the way
    /// from the box's centre to x, α that of the cone, and β that of the sphere around the box as x sees it, all these
    /// products are negative where θ > π/2 + α + β.
    fn is_turned_away(&self, x: DVec3) -> bool {
        let (low, high) = (self.low.as_dvec3(), self.high.as_dvec3());
        let (toward_x, radius) = (x - 0.5 * (low + high), 0.5 * (high - low).length());
        let distance = toward_x.length();
        if radius >= distance {
            return false;
        }
        let sin = radius / distance;
        let cos = (1.0 - sin * sin).sqrt();
        let Normals { axis, sin: sin_a, cos: cos_a } = self.normals;
        let narrow = cos_a * cos - sin_a * sin > 0.0;
        narrow && axis.dot(toward_x) / distance < -(sin_a * cos + cos_a * sin) - SLACK
    }
}
