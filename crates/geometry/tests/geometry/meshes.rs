//! Meshes to attack.

use std::collections::HashMap;

use glam::{DQuat, DVec3, Vec3};
use twoforms_geometry::mesh::Mesh;

use crate::draws::Draws;

/// Appends a triangle with vertices of its own.
pub fn push_triangle(mesh: &mut Mesh, corners: [Vec3; 3]) -> u32 {
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend(corners);
    mesh.triangles.push([first, first + 1, first + 2]);
    mesh.len() as u32 - 1
}

/// Appends a quadrilateral as two triangles on the diagonal from corner 0 to corner 2; returns the triangles and corners.
pub fn push_quad(mesh: &mut Mesh, corners: [Vec3; 4]) -> ([u32; 2], [u32; 4]) {
    let k = mesh.vertices.len() as u32;
    mesh.vertices.extend(corners);
    mesh.triangles.extend([[k, k + 1, k + 2], [k, k + 2, k + 3]]);
    let last = mesh.len() as u32;
    ([last - 2, last - 1], [k, k + 1, k + 2, k + 3])
}

/// The box between two corners, fronts outward.
pub fn cuboid(low: Vec3, high: Vec3) -> Mesh {
    let corner = |k: u32| Vec3::select(glam::BVec3::new(k & 1 != 0, k & 2 != 0, k & 4 != 0), high, low);
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Mesh { vertices: (0..8).map(corner).collect(), triangles }
}

/// A regular tetrahedron around the origin, each triangle split in four `levels` times, vertices moved to the radius
/// that `radius` gives them. Closed and star-shaped, fronts outward.
pub fn ball(levels: u32, mut radius: impl FnMut() -> f64) -> Mesh {
    let mut vertices: Vec<DVec3> =
        [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(DVec3::from).to_vec();
    let mut triangles: Vec<[u32; 3]> = vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    for _ in 0..levels {
        let mut middles = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                vertices.push((vertices[a as usize].normalize() + vertices[b as usize].normalize()) * 0.5);
                vertices.len() as u32 - 1
            })
        };
        let split = |[a, b, c]: [u32; 3]| {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(split).collect();
    }
    let vertices = vertices.iter().map(|v| (v.normalize() * radius()).as_vec3()).collect();
    Mesh { vertices, triangles }
}

/// The walls, floor and ceiling of the Cornell box and a wall in front, fronts outward, in metres: closed, since its six
/// sides share the eight measured corners.
pub fn room() -> Mesh {
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z) * 1e-3;
    let floor = [at(552.8, 0.0, 0.0), at(0.0, 0.0, 0.0), at(0.0, 0.0, 559.2), at(549.6, 0.0, 559.2)];
    let above = [at(556.0, 548.8, 0.0), at(0.0, 548.8, 0.0), at(0.0, 548.8, 559.2), at(556.0, 548.8, 559.2)];
    let mut mesh = Mesh::default();
    push_quad(&mut mesh, [floor[3], floor[2], floor[1], floor[0]]);
    push_quad(&mut mesh, above);
    for k in 0..4 {
        let next = (k + 1) % 4;
        push_quad(&mut mesh, [floor[k], floor[next], above[next], above[k]]);
    }
    mesh
}

/// The sides and top of the two blocks of the Cornell box, in metres.
pub fn add_blocks(mesh: &mut Mesh) {
    let short = [[130.0, 65.0], [82.0, 225.0], [240.0, 272.0], [290.0, 114.0]];
    let tall = [[423.0, 247.0], [265.0, 296.0], [314.0, 456.0], [472.0, 406.0]];
    for (base, height) in [(short, 165.0), (tall, 330.0)] {
        let at = |k: usize, y: f32| Vec3::new(base[k % 4][0], y, base[k % 4][1]) * 1e-3;
        push_quad(mesh, [0, 1, 2, 3].map(|k| at(k, height)));
        for k in 0..4 {
            push_quad(mesh, [at(k, 0.0), at(k, height), at(k + 1, height), at(k + 1, 0.0)]);
        }
    }
}

/// The corners of the light of the Cornell box at `height` metres, front downward.
pub fn light_corners(height: f32) -> [Vec3; 4] {
    [[0.343, 0.227], [0.343, 0.332], [0.213, 0.332], [0.213, 0.227]].map(|[x, z]| Vec3::new(x, height, z))
}

/// Random triangles of about this size in [-1, 1]³.
pub fn soup(draws: &mut Draws, count: usize, size: f64) -> Mesh {
    let mut mesh = Mesh::default();
    for _ in 0..count {
        let centre = draws.in_cube();
        push_triangle(&mut mesh, [(); 3].map(|()| (centre + draws.in_cube() * size).as_vec3()));
    }
    mesh
}

/// Long triangles whose third vertex lies within `width` of the opposite edge.
pub fn slivers(draws: &mut Draws, count: usize, width: f64) -> Mesh {
    let mut mesh = Mesh::default();
    for _ in 0..count {
        let (a, b) = (draws.in_cube(), draws.in_cube());
        let c = a.lerp(b, draws.unit()) + draws.in_cube() * width;
        push_triangle(&mut mesh, [a, b, c].map(DVec3::as_vec3));
    }
    mesh
}

/// Axis-aligned squares of a grid, every vertex repeated, and every seventh square there twice.
pub fn grid(cells: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let step = 2.0 / cells as f32;
    for cell in 0..cells * cells {
        let (s, t) = ((cell % cells) as f32 * step - 1.0, (cell / cells) as f32 * step - 1.0);
        let square = [[s, t], [s + step, t], [s + step, t + step], [s, t + step]];
        let height = (cell % 5) as f32 * 0.25 - 0.5;
        for _ in 0..=usize::from(cell % 7 == 0) {
            push_quad(&mut mesh, square.map(|[s, t]| Vec3::new(s, t, height)));
            push_quad(&mut mesh, square.map(|[s, t]| Vec3::new(height, s, t)));
        }
    }
    mesh
}

/// The mesh with every vertex carried by `f`.
pub fn carried(mesh: &Mesh, f: impl Fn(DVec3) -> DVec3) -> Mesh {
    let vertices = mesh.vertices.iter().map(|v| f(v.as_dvec3()).as_vec3()).collect();
    Mesh { vertices, triangles: mesh.triangles.clone() }
}

/// Some rotations that align with no axis, and the identity.
pub fn turns() -> [DQuat; 4] {
    let about = |x, y, z, angle| DQuat::from_axis_angle(DVec3::new(x, y, z).normalize(), angle);
    [DQuat::IDENTITY, about(1.0, 2.0, 3.0, 0.7), about(-3.0, 1.0, 0.2, 2.1), about(0.1, -1.0, 0.5, 1.3)]
}
