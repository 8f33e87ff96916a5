//! No ray leaves a closed mesh.

use glam::{DVec3, Vec3};
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::ray::Ray;

use crate::draws::Draws;
use crate::meshes::{add_blocks, ball, carried, cuboid, room, turns};

/// A closed mesh, fronts outward, and a point that sees all of it.
struct Closed {
    name: &'static str,
    mesh: Mesh,
    centre: DVec3,
}

fn closed_meshes() -> Vec<Closed> {
    let mut draws = Draws::new(1);
    let centred = |name, mesh: Mesh| Closed { name, mesh, centre: DVec3::ZERO };
    let crooked = Vec3::new(0.1, -0.3, 7.7);
    let box_there = cuboid(crooked, crooked + Vec3::new(0.3, 1.1, 0.7));
    let within = box_there.vertices.iter().map(|v| v.as_dvec3()).sum::<DVec3>() / 8.0;
    vec![
        centred("cube", cuboid(Vec3::NEG_ONE, Vec3::ONE)),
        Closed { name: "box off the origin", mesh: box_there, centre: within },
        centred("turned cube", carried(&cuboid(Vec3::NEG_ONE, Vec3::ONE), |v| turns()[1] * v)),
        centred("ball", ball(5, || 1.0)),
        centred("star", ball(4, || draws.between(0.3, 1.7))),
        Closed { name: "room", mesh: room(), centre: DVec3::new(0.27, 0.27, 0.28) },
    ]
}

/// Where rays start: the centre, or between it and the surface.
fn start(closed: &Closed, draws: &mut Draws) -> DVec3 {
    let toward = on_triangle(&closed.mesh, draws.barycentric(), draws);
    closed.centre.lerp(toward, 0.99 * draws.unit())
}

fn on_triangle(mesh: &Mesh, weights: [f64; 3], draws: &mut Draws) -> DVec3 {
    let vertices = mesh.triangle(draws.below(mesh.len()) as u32).vertices();
    weights.iter().zip(vertices).map(|(&w, v)| w * v).sum()
}

/// Directions of every kind: random, along the axes, at edges, at vertices, and from the exact centre.
fn attack(closed: &Closed, kind: usize, draws: &mut Draws) -> Ray {
    let edge = |draws: &mut Draws| {
        let s = if draws.chance(0.1) { 0.5 } else { draws.unit() };
        [1.0 - s, s, 0.0]
    };
    let mesh = &closed.mesh;
    let from = start(closed, draws);
    match kind {
        0 => Ray::new(from, draws.direction()),
        1 => Ray::new(if draws.chance(0.5) { closed.centre } else { from }, draws.aligned()),
        2 => Ray::new(from, on_triangle(mesh, edge(draws), draws) - from),
        3 => Ray::new(from, on_triangle(mesh, [1.0, 0.0, 0.0], draws) - from),
        4 => Ray::new(closed.centre, on_triangle(mesh, edge(draws), draws) - closed.centre),
        _ => {
            let s = draws.unit();
            Ray::new(closed.centre, on_triangle(mesh, [1.0 - s, 0.0, s], draws) - closed.centre)
        }
    }
}

/// Rays that meet nothing, or meet a front from outside before any back from inside: those got out.
fn escapes(closed: &Closed, geometry: &Geometry, rays: usize, seed: u64) -> Vec<Ray> {
    let mut draws = Draws::new(seed);
    let got_out = |ray: &Ray| {
        geometry.vp(ray).is_none_or(|hit| {
            outward(geometry.mesh(), hit.triangle, ray) < 0.0 && first_back(geometry.mesh(), ray) > hit.t
        })
    };
    (0..rays).map(|k| attack(closed, k % 6, &mut draws)).filter(got_out).collect()
}

/// Positive where a ray leaves through a triangle, negative where it enters.
fn outward(mesh: &Mesh, triangle: u32, ray: &Ray) -> f64 {
    mesh.triangle(triangle).cross().dot(ray.direction)
}

/// Distance of the first triangle met from its back, with the rounding of an edge that a ray grazes.
fn first_back(mesh: &Mesh, ray: &Ray) -> f64 {
    let backs = (0..mesh.len() as u32).filter(|&t| outward(mesh, t, ray) >= 0.0);
    let nearest = backs.filter_map(|t| ray.distance(&mesh.triangle(t))).fold(f64::INFINITY, f64::min);
    nearest * (1.0 - 1e-12)
}

#[test]
fn none_of_four_million_rays_escapes() {
    let rays = 4_000_000 / 6 + 1;
    for (seed, closed) in (10..).zip(closed_meshes()) {
        let out = escapes(&closed, &Geometry::new(closed.mesh.clone(), Vec::new()), rays, seed);
        assert!(out.is_empty(), "{} of {rays} left the {}, the first {:?}", out.len(), closed.name, out[0]);
    }
}

#[test]
fn none_escapes_without_a_hierarchy() {
    let rays = 30_000;
    for (seed, closed) in (20..).zip(closed_meshes()).filter(|(_, closed)| closed.mesh.len() < 100) {
        let out = escapes(&closed, &Geometry::brute_force(closed.mesh.clone(), Vec::new()), rays, seed);
        assert!(out.is_empty(), "{} of {rays} left the {}, the first {:?}", out.len(), closed.name, out[0]);
    }
}

#[test]
fn none_leaves_a_furnished_room() {
    let mut mesh = room();
    let walls = mesh.len() as u32;
    add_blocks(&mut mesh);
    let geometry = Geometry::new(mesh, Vec::new());
    let mut draws = Draws::new(30);
    for _ in 0..200_000 {
        let from = DVec3::new(draws.between(0.001, 0.548), draws.between(0.001, 0.547), draws.between(0.001, 0.558));
        let triangle = geometry.mesh().triangle(draws.below(walls as usize) as u32).vertices();
        let at_edge = triangle[0].lerp(triangle[1], draws.unit());
        for direction in [draws.direction(), draws.aligned(), at_edge - from, triangle[2] - from] {
            let ray = Ray::new(from, direction);
            assert!(geometry.vp(&ray).is_some(), "{ray:?} left the room");
        }
    }
}
