//! Points on surfaces do not meet the surface they lie on, and corners do not leak.

use glam::DVec3;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::ray::Ray;

use crate::draws::Draws;
use crate::meshes::{add_blocks, ball, carried, room, slivers, soup, turns};

fn meshes() -> Vec<(&'static str, Mesh)> {
    let mut draws = Draws::new(400);
    let mut furnished = room();
    add_blocks(&mut furnished);
    let turned = carried(&furnished, |v| turns()[1] * v + DVec3::new(30.0, -7.0, 0.3));
    vec![
        ("soup", soup(&mut draws, 300, 0.5)),
        ("slivers", slivers(&mut draws, 300, 1e-3)),
        ("star", ball(4, || draws.between(0.3, 1.7))),
        ("ball", ball(4, || 1.0)),
        ("room", furnished),
        ("room turned and moved", turned),
    ]
}

#[test]
fn a_point_on_a_triangle_never_meets_that_triangle() {
    for (seed, (name, mesh)) in (410..).zip(meshes()) {
        let geometry = Geometry::new(mesh, Vec::new());
        let mut draws = Draws::new(seed);
        for _ in 0..50_000 {
            let own = draws.below(geometry.mesh().len()) as u32;
            let triangle = geometry.mesh().triangle(own);
            let weights = draws.barycentric();
            let x: DVec3 = weights.iter().zip(triangle.vertices()).map(|(&w, v)| w * v).sum();
            let n = triangle.cross().normalize();
            for n in [n, -n] {
                for from in [x, x.as_vec3().as_dvec3()] {
                    let hit = geometry.vp(&Ray::new(from, draws.direction_above(n, 0.0)));
                    assert!(hit.is_none_or(|hit| hit.triangle != own), "{name}: {own} met from itself, {hit:?}");
                }
            }
        }
    }
}

#[test]
fn a_hit_point_never_meets_the_triangle_that_was_hit() {
    for (seed, (name, mesh)) in (420..).zip(meshes()) {
        let geometry = Geometry::new(mesh, Vec::new());
        let mut draws = Draws::new(seed);
        for _ in 0..50_000 {
            let vertex = geometry.mesh().vertices[draws.below(geometry.mesh().vertices.len())].as_dvec3();
            let from = vertex + draws.in_cube();
            let aside = if draws.chance(0.5) { draws.in_cube() * 1e-3 } else { DVec3::ZERO };
            let ray = Ray::new(from, vertex - from + aside);
            let Some(first) = geometry.vp(&ray) else { continue };
            let x = ray.at(first.t);
            for direction in [draws.direction(), ray.direction, -ray.direction] {
                let hit = geometry.vp(&Ray::new(x, direction));
                assert!(hit.is_none_or(|hit| hit.triangle != first.triangle), "{name}: {first:?} met again, {hit:?}");
            }
        }
    }
}

/// On the floor beside the wall x = 0: toward the wall the wall is met, as near as its plane does not hold x.
#[test]
fn the_floor_beside_a_wall_sees_the_wall() {
    let geometry = Geometry::new(room(), Vec::new());
    let tolerance = 4.0 / 16_777_216.0 * 0.5592;
    let mut draws = Draws::new(430);
    for exponent in 3..=12 {
        let gap = 10.0_f64.powi(-exponent);
        for _ in 0..5_000 {
            let x = DVec3::new(gap, 0.0, draws.between(0.1, 0.45));
            let up = draws.direction_above(DVec3::Y, 1e-6);
            let hit = geometry.vp(&Ray::new(x, up));
            if gap > tolerance || up.x > 0.0 {
                assert!(hit.is_some(), "from {gap} m beside the wall along {up} out of the room");
            }
            if gap <= tolerance {
                let wall =
                    hit.is_some_and(|hit| geometry.mesh().triangle(hit.triangle).vertices().iter().all(|v| v.x == 0.0));
                assert!(!wall, "a wall whose plane holds x was met");
            }
        }
    }
}

/// The corner where floor and two walls meet.
#[test]
fn the_corner_of_a_room_does_not_leak() {
    let geometry = Geometry::new(room(), Vec::new());
    let mut draws = Draws::new(431);
    for exponent in 3..=6 {
        let gap = 10.0_f64.powi(-exponent);
        for _ in 0..20_000 {
            let x = DVec3::new(gap * draws.between(1.0, 2.0), 0.0, gap * draws.between(1.0, 2.0));
            let toward_corner = DVec3::new(0.0, draws.unit() * gap, 0.0) - x;
            for direction in [draws.direction_above(DVec3::Y, 1e-6), toward_corner] {
                assert!(geometry.vp(&Ray::new(x, direction)).is_some(), "from {x} along {direction} out of the room");
            }
        }
    }
}
