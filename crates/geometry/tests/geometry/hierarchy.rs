//! The hierarchy and brute force give the same bits.

use glam::DVec3;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::ray::{Hit, Ray};
use twoforms_geometry::target::{Shape, Sides, Target};

use crate::draws::Draws;
use crate::meshes::{add_blocks, ball, carried, grid, room, slivers, soup, turns};

fn meshes() -> Vec<(&'static str, Mesh)> {
    let mut draws = Draws::new(100);
    let mut furnished = room();
    add_blocks(&mut furnished);
    vec![
        ("large triangles", soup(&mut draws, 200, 1.0)),
        ("small triangles", soup(&mut draws, 400, 0.1)),
        ("slivers", slivers(&mut draws, 300, 1e-4)),
        ("thinner slivers", slivers(&mut draws, 300, 1e-7)),
        ("grid", grid(8)),
        ("turned grid", carried(&grid(8), |v| turns()[2] * v)),
        ("star", ball(3, || draws.between(0.2, 1.5))),
        ("room", furnished),
        ("one triangle", soup(&mut draws, 1, 1.0)),
    ]
}

fn ray(mesh: &Mesh, draws: &mut Draws) -> Ray {
    let vertex = |draws: &mut Draws| mesh.vertices[draws.below(mesh.vertices.len())].as_dvec3();
    let origin = match draws.below(4) {
        0 => vertex(draws),
        1 => (draws.in_cube() * 4.0).round() * 0.25,
        _ => draws.in_cube() * 1.5,
    };
    let direction = match draws.below(4) {
        0 => draws.aligned(),
        1 => vertex(draws) - origin,
        2 => vertex(draws).lerp(vertex(draws), draws.unit()) - origin,
        _ => draws.direction(),
    };
    Ray::new(origin, if direction == DVec3::ZERO { DVec3::X } else { direction })
}

fn bits(hit: Option<Hit>) -> Option<(u64, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.triangle))
}

#[test]
fn hierarchy_and_brute_force_give_the_same_bits() {
    for (seed, (name, mesh)) in (200..).zip(meshes()) {
        let mut draws = Draws::new(seed);
        let light = |t| Target { shape: Shape::Triangle(t), sides: Sides::Both };
        let targets: Vec<Target> = (0..mesh.len() as u32).step_by(3).map(light).collect();
        let fast = Geometry::new(mesh.clone(), targets.clone());
        let slow = Geometry::brute_force(mesh.clone(), targets.clone());
        for _ in 0..20_000 {
            let ray = ray(&mesh, &mut draws);
            let hit = slow.vp(&ray);
            assert_eq!(bits(fast.vp(&ray)), bits(hit), "{name}, {ray:?}");
            let target = draws.below(targets.len()) as u32;
            let at_hit = hit.map_or(1.0, |hit| hit.t);
            for before in [at_hit, at_hit * (1.0 + f64::EPSILON), draws.between(0.0, 2.0) * at_hit, f64::INFINITY] {
                let (one, other) = (fast.visible(&ray, before, target), slow.visible(&ray, before, target));
                assert_eq!(one, other, "{name}, {ray:?} before {before}");
            }
        }
    }
}

#[test]
fn both_relate_targets_to_the_same_coplanar_triangles() {
    for (name, mesh) in meshes() {
        let light = |t| Target { shape: Shape::Triangle(t), sides: Sides::Front };
        let targets: Vec<Target> = (0..mesh.len() as u32).step_by(5).map(light).collect();
        let fast = Geometry::new(mesh.clone(), targets.clone());
        let slow = Geometry::brute_force(mesh.clone(), targets.clone());
        for target in 0..targets.len() as u32 {
            for triangle in 0..mesh.len() as u32 {
                let (one, other) = (fast.may_block(triangle, target), slow.may_block(triangle, target));
                assert_eq!(one, other, "{name}: may {triangle} block {target}?");
            }
        }
    }
}
