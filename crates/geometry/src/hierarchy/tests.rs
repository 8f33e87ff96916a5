//! The wide tree against brute force, at every level of instructions and in awkward places.

use std::cell::Cell;
use std::ops::ControlFlow;

use fearless_simd::Level;
use glam::{DVec3, Vec3};
use rand_philox::{Philox, u32_to_unit_f64};

use super::Hierarchy;
use super::binary::{Binary, Place};
use super::node::WIDTH;
use super::stack::Depth;
use crate::mesh::Mesh;
use crate::ray::{Hit, Ray};
use crate::tracer::{BruteForce, Region, Tracer};

struct Draws(Philox);

impl Draws {
    fn unit(&mut self) -> f64 {
        u32_to_unit_f64(self.0.next_u32())
    }

    /// Uniform in the cube [-1, 1]³.
    fn in_cube(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }

    fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n - 1)
    }
}

fn draws(seed: u64) -> Draws {
    Draws(Philox::from_u64_seed(seed))
}

/// Random triangles of about this size in the cube of twice `half` a side around `centre`.
fn soup(draws: &mut Draws, count: usize, [half, size]: [f64; 2], centre: DVec3) -> Mesh {
    let mut mesh = Mesh::default();
    for _ in 0..count {
        let middle = centre + draws.in_cube() * half;
        let first = mesh.vertices.len() as u32;
        mesh.vertices.extend([(); 3].map(|()| (middle + draws.in_cube() * size).as_vec3()));
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    mesh
}

/// All levels of instructions that this machine has.
fn levels() -> Vec<Level> {
    let best = Level::new();
    #[cfg(target_arch = "x86_64")]
    {
        let lower =
            [best.as_sse2().map(Level::Sse2), best.as_sse4_2().map(Level::Sse4_2), best.as_avx2().map(Level::Avx2)];
        lower.into_iter().flatten().chain([best]).collect()
    }
    #[cfg(not(target_arch = "x86_64"))]
    vec![best]
}

fn bits(hit: Option<Hit>) -> Option<(u64, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.triangle))
}

/// A ray at a vertex, an edge, the middle of a triangle or anywhere, from near or far.
fn ray(mesh: &Mesh, draws: &mut Draws) -> Ray {
    let (low, high) = mesh.bounds().expect("the mesh is not empty");
    let (low, high) = (low.as_dvec3(), high.as_dvec3());
    let size = (high - low).max_element();
    let vertex = |draws: &mut Draws| mesh.vertices[draws.below(mesh.vertices.len())].as_dvec3();
    let origin = match draws.below(4) {
        0 => vertex(draws),
        1 => DVec3::new(low.x, high.y, vertex(draws).z),
        _ => (low + high) * 0.5 + draws.in_cube() * size,
    };
    let triangle = mesh.triangle(draws.below(mesh.len()) as u32).vertices();
    let axis = DVec3::AXES[draws.below(3)] * if draws.below(2) == 0 { 1.0 } else { -1.0 };
    let direction = match draws.below(5) {
        0 => axis * size,
        1 => triangle[0] - origin,
        2 => triangle[0].lerp(triangle[1], draws.unit()) - origin,
        3 => (triangle[0] + triangle[1] + triangle[2]) / 3.0 - origin,
        _ => draws.in_cube() * size,
    };
    Ray::new(origin, if direction == DVec3::ZERO { axis } else { direction })
}

/// The same bits as brute force, for nearest hits and for blocking just before, at and beyond them.
fn compare(tree: &Hierarchy, mesh: &Mesh, ray: &Ray, what: &str) {
    let truth = BruteForce.closest(mesh, ray);
    assert_eq!(bits(tree.closest(mesh, ray)), bits(truth), "{what}, {ray:?}");
    let at = truth.map_or(1.0, |hit| hit.t);
    for before in [at, at * (1.0 + f64::EPSILON), at * 0.5, f64::INFINITY] {
        let odd = |triangle: u32| triangle % 2 == 1;
        let (one, other) = (tree.any(mesh, ray, before, odd), BruteForce.any(mesh, ray, before, odd));
        assert_eq!(one, other, "{what}, {ray:?} before {before}");
    }
}

#[test]
fn every_level_of_instructions_gives_the_bits_of_brute_force() {
    let mut draws = draws(1);
    for (count, size) in [(1, 1.0), (7, 0.5), (8, 0.5), (9, 0.5), (300, 0.5), (2000, 0.02)] {
        let mesh = soup(&mut draws, count, [1.0, size], DVec3::ZERO);
        let rays: Vec<Ray> = (0..2000).map(|_| ray(&mesh, &mut draws)).collect();
        for level in levels() {
            let tree = Hierarchy::with_level(&mesh, level);
            let what = format!("{count} triangles, {level:?}");
            for ray in &rays {
                compare(&tree, &mesh, ray, &what);
            }
        }
    }
}

/// From the smallest coordinates to beyond what lanes hold, near the origin of space and far from it.
#[test]
fn scenes_of_every_size_give_the_bits_of_brute_force() {
    let mut draws = draws(2);
    for exponent in [-38, -30, -20, -10, -4, 4, 10, 14, 18] {
        let size = 10_f64.powi(exponent);
        for centre in [DVec3::ZERO, DVec3::new(3.0, -700.0, 50.0) * size, DVec3::splat(1e5) * size] {
            let mesh = soup(&mut draws, 60, [size, 0.3 * size], centre);
            let tree = Hierarchy::new(&mesh);
            for _ in 0..500 {
                let ray = ray(&mesh, &mut draws);
                let what = format!("size {size}, centre {centre}");
                compare(&tree, &mesh, &ray, &what);
                let length = 10_f64.powi(draws.below(80) as i32 - 40);
                compare(&tree, &mesh, &Ray::new(ray.origin, ray.direction * length), &what);
                let from_afar = ray.origin - ray.direction * 10_f64.powi(draws.below(12) as i32);
                compare(&tree, &mesh, &Ray::new(from_afar, ray.direction), &what);
            }
        }
    }
}

/// A fine mesh upon a ground a million times its size: triangles of all sizes in one packet and along one ray.
#[test]
fn a_trinket_on_a_plain_gives_the_bits_of_brute_force() {
    let mut draws = draws(3);
    let mut mesh = soup(&mut draws, 300, [0.01, 0.003], DVec3::new(120.0, 0.01, -40.0));
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend([[-1e4, -1e4], [1e4, -1e4], [1e4, 1e4], [-1e4, 1e4]].map(|[x, z]| Vec3::new(x, 0.0, z)));
    mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    let tree = Hierarchy::new(&mesh);
    for _ in 0..5000 {
        let at = mesh.vertices[draws.below(first as usize)].as_dvec3();
        let origin = at + draws.in_cube() * 10_f64.powi(draws.below(7) as i32 - 3);
        compare(&tree, &mesh, &Ray::new(origin, at - origin), "trinket");
        compare(&tree, &mesh, &Ray::new(origin, draws.in_cube()), "trinket");
    }
}

/// Triangles of one plane, each around the one before.
fn nested(count: usize) -> Mesh {
    let corner = |k: usize| {
        [[-1.0, -1.0], [1.0, -1.0], [0.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.0) * (1 + k) as f32 + Vec3::Z)
    };
    let triangle = |k: u32| [3 * k, 3 * k + 1, 3 * k + 2];
    Mesh { vertices: (0..count).flat_map(corner).collect(), triangles: (0..count as u32).map(triangle).collect() }
}

/// Each of nested triangles is best joined with what is inside of it, which makes the deepest trees: every kind of stack
/// answers alike.
#[test]
fn trees_of_every_depth_answer() {
    let mut deepest = Depth::Shallow;
    for count in [2, WIDTH, 1000, 5000] {
        let mesh = nested(count);
        let mut tree = Hierarchy::new(&mesh);
        deepest = tree.depth;
        for depth in [tree.depth, Depth::Deep] {
            tree.depth = depth;
            let hit = tree.closest(&mesh, &Ray::new(DVec3::ZERO, DVec3::Z));
            assert_eq!(bits(hit), Some((1.0_f64.to_bits(), 0)), "{count} triangles, {depth:?}");
            assert!(!tree.any(&mesh, &Ray::new(DVec3::ZERO, DVec3::Z), 2.0, |_| false));
        }
    }
    assert_ne!(deepest, Depth::Shallow);
}

/// Copies of a triangle, and the steps of a stair: far fewer levels than triangles.
#[test]
fn triangles_that_lie_alike_make_no_chain() {
    let mut draws = draws(8);
    for (name, step) in [("copies", Vec3::ZERO), ("stair", Vec3::new(0.125, 0.125, 0.0))] {
        let corner = |k: u32| [Vec3::ZERO, Vec3::X, Vec3::Z].map(|corner| corner * 0.125 + step * k as f32);
        let vertices = (0..4096).flat_map(corner).collect();
        let mesh = Mesh { vertices, triangles: (0..4096).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect() };
        let levels = levels_of(&Binary::new(&mesh));
        assert!(levels < 256, "{name}: {levels} levels");
        let tree = Hierarchy::new(&mesh);
        (0..20).for_each(|_| compare(&tree, &mesh, &ray(&mesh, &mut draws), name));
    }
}

fn levels_of(binary: &Binary) -> usize {
    let (mut deepest, mut left) = (0, vec![(0, 1)]);
    while let Some((node, level)) = left.pop() {
        deepest = deepest.max(level);
        if let Place::Pair(children) = binary.at(node) {
            left.extend(children.map(|child| (child, level + 1)));
        }
    }
    deepest
}

#[test]
fn no_triangles_are_no_trouble() {
    let mesh = Mesh::default();
    let tree = Hierarchy::new(&mesh);
    assert_eq!(tree.closest(&mesh, &Ray::new(DVec3::ZERO, DVec3::X)), None);
    assert!(!tree.any(&mesh, &Ray::new(DVec3::ZERO, DVec3::X), f64::INFINITY, |_| true));
    tree.within(&mesh, &Region { origin: DVec3::ZERO, half_spaces: Vec::new() }, |_| panic!("there is nothing"));
}

/// Every triangle that touches a region is visited once, at every level, and few that lie far from it.
#[test]
fn regions_lose_no_triangle() {
    let mut draws = draws(4);
    for centre in [DVec3::ZERO, DVec3::new(1000.0, -3.0, 40.0)] {
        let mesh = soup(&mut draws, 3000, [1.0, 0.05], centre);
        for level in levels() {
            let tree = Hierarchy::with_level(&mesh, level);
            for _ in 0..200 {
                let origin = centre + draws.in_cube();
                let planes = draws.below(6);
                let normals: Vec<DVec3> = (0..planes).map(|_| draws.in_cube() * 10_f64.powi(3)).collect();
                let half_spaces = normals.iter().map(|&n| (n, n.length() * 0.2 * draws.unit())).collect();
                let region = Region { origin, half_spaces };
                let mut visits = vec![0; mesh.len()];
                tree.within(&mesh, &region, |triangle| {
                    visits[triangle as usize] += 1;
                    ControlFlow::Continue(())
                });
                for (index, &visits) in (0..).zip(&visits) {
                    assert!(visits <= 1, "{index} is visited {visits} times");
                    let outside = by_most(&region, mesh.triangle(index).vertices());
                    assert!(visits == 1 || outside > 0.0, "{index} is lost in {region:?}");
                    assert!(visits == 0 || outside < 1e-3, "{index} is {outside} outside");
                }
            }
        }
    }
}

/// How far a triangle lies outside the half-space that it is farthest out of, metres; not above 0 where it may touch.
fn by_most(region: &Region, vertices: [DVec3; 3]) -> f64 {
    let outside = |(normal, offset): &(DVec3, f64)| {
        let along = vertices.map(|v| (normal.dot(v - region.origin) - offset) / normal.length());
        along.into_iter().fold(f64::INFINITY, f64::min)
    };
    region.half_spaces.iter().map(outside).fold(0.0, f64::max)
}

#[test]
fn a_visit_can_be_broken_off() {
    let mesh = soup(&mut draws(5), 500, [1.0, 0.1], DVec3::ZERO);
    let visits = Cell::new(0);
    Hierarchy::new(&mesh).within(&mesh, &Region { origin: DVec3::ZERO, half_spaces: Vec::new() }, |_| {
        visits.set(visits.get() + 1);
        if visits.get() == 17 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!(visits.get(), 17);
}

/// Rays together get the answers that each gets alone, whether they run alike or not.
#[test]
fn bundles_give_the_bits_of_single_rays() {
    let mut draws = draws(6);
    for (count, size) in [(1, 1.0), (40, 0.4), (3000, 0.05)] {
        let mesh = soup(&mut draws, count, [1.0, size], DVec3::ZERO);
        for level in levels() {
            let tree = Hierarchy::with_level(&mesh, level);
            for spread in [0.0, 0.01, 0.3, 3.0] {
                for _ in 0..300 {
                    let (origin, direction) = (draws.in_cube() * 2.0, draws.in_cube());
                    let mut near = |v: DVec3, by: f64| v + draws.in_cube() * by;
                    let together: Vec<Ray> = (0..19)
                        .map(|k| Ray::new(near(origin, spread * f64::from(k % 2)), near(direction, spread)))
                        .collect();
                    let mut hits = vec![None; together.len()];
                    tree.closest_of(&mesh, &together, &mut hits);
                    for (ray, hit) in together.iter().zip(hits) {
                        assert_eq!(bits(hit), bits(tree.closest(&mesh, ray)), "{count} triangles, {level:?}, {ray:?}");
                    }
                }
            }
        }
    }
}
