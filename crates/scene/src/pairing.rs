//! Targets of one light: its triangles, two by two where they make a parallelogram.

use std::collections::{HashMap, HashSet};

use twoforms_geometry::blocking::{TOLERANCE, coplanar};
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::target::{Shape, Sides, Target};

use crate::coincident::{Place, place};
use crate::glow::Glow;

/// How many triangles on one edge are tried as partners. A surface has two; a knot of thousands is left as it is.
const TRIED: usize = 16;

/// The later triangles on a directed edge, with the vertex opposite to it.
type Edges = HashMap<[Place; 2], Vec<Opposite>>;

#[derive(Clone, Copy)]
struct Opposite {
    triangle: u32,
    apex: u32,
    /// The triangle's own vertices at the ends of the edge.
    side: [u32; 2],
}

/// The targets of the light made of `triangles` (in order), each in at most one: a triangle takes the first later one
/// with which it forms a parallelogram that the light's texture, if it has one, covers by one map.
pub(crate) fn targets(mesh: &Mesh, triangles: &[u32], sides: Sides, glow: Option<&Glow<'_>>) -> Vec<Target> {
    let edges = edges(mesh, triangles);
    let mut taken = HashSet::new();
    let mut targets = Vec::new();
    for &triangle in triangles {
        if !taken.insert(triangle) {
            continue;
        }
        let shape = parallelogram(mesh, triangle, &edges, &taken, glow).unwrap_or(Shape::Triangle(triangle));
        if let Shape::Parallelogram { triangles: [_, second], .. } = shape {
            taken.insert(second);
        }
        targets.push(Target { shape, sides });
    }
    targets
}

fn edges(mesh: &Mesh, triangles: &[u32]) -> Edges {
    let mut edges = Edges::new();
    for &triangle in triangles {
        for [from, to, apex] in rotations(mesh.triangles[triangle as usize]) {
            let opposite = Opposite { triangle, apex, side: [from, to] };
            edges.entry([from, to].map(|i| place(mesh.vertices[i as usize]))).or_default().push(opposite);
        }
    }
    edges
}

/// The first partner of `first` over any of its three edges.
fn parallelogram(
    mesh: &Mesh,
    first: u32,
    edges: &Edges,
    taken: &HashSet<u32>,
    glow: Option<&Glow<'_>>,
) -> Option<Shape> {
    let partners = rotations(mesh.triangles[first as usize]).into_iter().filter_map(|[a, b, c]| {
        let diagonal = [a, c].map(|i| place(mesh.vertices[i as usize]));
        let candidates = edges.get(&diagonal)?;
        let later = &candidates[candidates.partition_point(|o| o.triangle <= first)..];
        let fits = |o: &&Opposite| {
            !taken.contains(&o.triangle)
                && closes(mesh, [a, b, c, o.apex])
                && coplanar(&mesh.triangle(first), &mesh.triangle(o.triangle))
                && glow.is_none_or(|glow| glow.is_affine([a, b, c, o.apex], o.side))
        };
        let Opposite { triangle, apex, .. } = *later.iter().take(TRIED).find(fits)?;
        Some(([first, triangle], [a, b, c, apex]))
    });
    let (triangles, corners) = partners.min_by_key(|(triangles, _)| triangles[1])?;
    Some(Shape::Parallelogram { triangles, corners })
}

/// Whether a + c = b + d within the tolerance of blocking, taken of the longer diagonal: so small a departure changes
/// the density of the bilinear map by no more than binary32 rounds it.
fn closes(mesh: &Mesh, corners: [u32; 4]) -> bool {
    let [a, b, c, d] = corners.map(|i| mesh.vertices[i as usize].as_dvec3());
    let size = a.distance(c).max(b.distance(d));
    (a + c - b - d).length() <= TOLERANCE * size
}

fn rotations([a, b, c]: [u32; 3]) -> [[u32; 3]; 3] {
    [[a, b, c], [b, c, a], [c, a, b]]
}
