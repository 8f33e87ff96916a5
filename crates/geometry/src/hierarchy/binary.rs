//! The binary tree that the wide one is made from, built by obvhs. This is the only file that knows obvhs.

use glam::Vec3A;
use obvhs::Boundable;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use crate::mesh::{Mesh, Triangle};

/// Share of the nodes that the first pass tries to move to a better place; later passes try fewer.
const MOVED: f32 = 0.05;
/// Boxes are enlarged by up to this share of their size. Of boxes that lie alike, as copies of a triangle do or the steps of a
/// stair, each would name the same side as its better neighbour, and a pass over all of them would merge one pair.
const LOOSENESS: f32 = 1.0 / 4096.0;
/// So few triangles are merged in no time whatever their boxes are, and keep them as they are.
const FEW: usize = 1024;
/// Merges below which only direct neighbours are looked at, where almost all of them merge anyway.
const NARROW_SEARCH: usize = 3;

/// A binary tree of bounding boxes with one triangle in each leaf.
///
/// Built bottom up (Meister and Bittner 2018, "Parallel Locally-Ordered Clustering for Bounding Volume Hierarchy
/// Construction"), then improved by moving subtrees (by the same, "Parallel Reinsertion for Bounding Volume Hierarchy
/// Optimization"), on all threads.
pub(super) struct Binary(Bvh2);

impl Binary {
    /// Builds the tree.
    pub(super) fn new(mesh: &Mesh) -> Self {
        let all = 0..mesh.len() as u32;
        let boxes: Vec<Bounds> = all.clone().map(|t| Bounds::of(mesh, t)).collect();
        let mut builder = PlocBuilder::with_capacity(boxes.len());
        let mut tree =
            builder.build(PlocSearchDistance::Medium, &boxes, all.collect(), SortPrecision::U64, NARROW_SEARCH);
        drop((builder, boxes));
        ReinsertionOptimizer::default().run(&mut tree, MOVED, None);
        Self(tree)
    }

    /// Number of nodes; the root, if there is any, is node 0.
    pub(super) fn len(&self) -> usize {
        if self.0.primitive_indices.is_empty() { 0 } else { self.0.nodes.len() }
    }

    /// What stands at a node.
    pub(super) fn at(&self, node: u32) -> Place {
        let node = &self.0.nodes[node as usize];
        if node.is_leaf() {
            Place::Triangle(self.0.primitive_indices[node.first_index as usize])
        } else {
            Place::Pair([node.first_index, node.first_index + 1])
        }
    }

    /// The corners of a node's box.
    pub(super) fn bounds(&self, node: u32) -> [[f32; 3]; 2] {
        let bounds = self.0.nodes[node as usize].aabb;
        [bounds.min.to_array(), bounds.max.to_array()]
    }

    /// Half the area of a node's box.
    pub(super) fn half_area(&self, node: u32) -> f32 {
        self.0.nodes[node as usize].aabb.half_area()
    }
}

/// What stands at a node of the binary tree.
pub(super) enum Place {
    /// One triangle, by its index in the mesh.
    Triangle(u32),
    /// Two nodes.
    Pair([u32; 2]),
}

struct Bounds(Aabb);

impl Bounds {
    fn of(mesh: &Mesh, triangle: u32) -> Self {
        let Triangle { a, b, c } = mesh.triangle(triangle);
        let bounds = Self(Aabb::from_points(&[a, b, c].map(Vec3A::from)));
        if mesh.len() > FEW { bounds.loosened(triangle) } else { bounds }
    }

    /// The box enlarged by a little that differs from triangle to triangle and from face to face, as far as binary32 reaches.
    fn loosened(self, triangle: u32) -> Self {
        let most = LOOSENESS * self.0.diagonal().max_element();
        // Multiples of the golden ratio less their whole parts, in units of 2⁻³²: spread evenly, hardly two alike.
        let share =
            |face| triangle.wrapping_mul(6).wrapping_add(face).wrapping_mul(0x9E37_79B9) as f32 * 2_f32.powi(-32);
        let outward = |first| most * Vec3A::new(share(first), share(first + 1), share(first + 2));
        let (min, max) = (self.0.min - outward(0), self.0.max + outward(3));
        if min.is_finite() && max.is_finite() { Self(Aabb { min, max }) } else { self }
    }
}

impl Boundable for Bounds {
    fn aabb(&self) -> Aabb {
        self.0
    }
}
