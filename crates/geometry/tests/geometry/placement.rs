//! The same scene elsewhere and at another scale.

use glam::DVec3;
use twoforms_geometry::frame::Frame;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::ray::Ray;
use twoforms_geometry::segment::Segment;
use twoforms_geometry::target::{Shape, Sides, Target};
use twoforms_geometry::vector::Direction;
use twoforms_geometry::view::{Effort, View};

use crate::draws::Draws;
use crate::meshes::{add_blocks, carried, light_corners, push_quad, room};

/// The Cornell box with a wall in front and its light in the ceiling's plane.
fn cornell() -> (Mesh, Vec<Target>) {
    let mut mesh = room();
    add_blocks(&mut mesh);
    let (triangles, corners) = push_quad(&mut mesh, light_corners(0.5488));
    (mesh, vec![Target { shape: Shape::Parallelogram { triangles, corners }, sides: Sides::Front }])
}

fn inside(draws: &mut Draws) -> DVec3 {
    DVec3::new(draws.between(0.005, 0.54), draws.between(0.005, 0.54), draws.between(0.005, 0.55))
}

#[test]
fn scaled_by_a_power_of_two_rays_meet_the_same_bits() {
    let (mesh, targets) = cornell();
    let scale = 1.0 / 1024.0;
    let small = Geometry::new(carried(&mesh, |v| v * scale), targets.clone());
    let large = Geometry::new(mesh, targets);
    let mut draws = Draws::new(300);
    for _ in 0..100_000 {
        let (from, direction) = (inside(&mut draws), draws.direction());
        let hit = large.vp(&Ray::new(from, direction)).expect("the room is closed");
        let there = small.vp(&Ray::new(from * scale, direction)).expect("the small room is closed");
        assert_eq!((there.t, there.triangle), (hit.t * scale, hit.triangle));
    }
}

#[test]
fn scaled_by_a_power_of_two_the_view_gives_the_same_bits() {
    let (mesh, targets) = cornell();
    let (scale, scale_f32) = (1.0 / 1024.0, 1.0_f32 / 1024.0);
    let small = Geometry::new(carried(&mesh, |v| v * scale), targets.clone());
    let large = Geometry::new(mesh, targets);
    let mut draws = Draws::new(301);
    for effort in [Effort::Gather, Effort::Cast] {
        for _ in 0..300 {
            let (x, n) = (inside(&mut draws), draws.direction());
            let view = View::new(&large, Frame::new(x, n), effort);
            let view_there = View::new(&small, Frame::new(x * scale, n), effort);
            for _ in 0..50 {
                let uv = [draws.unit_f32(), draws.unit_f32()];
                let y = view.from_x::<f32>().facet(0).point(uv, 0);
                let y_there = view_there.from_x::<f32>().facet(0).point(uv, 0);
                assert_eq!(y.position * scale_f32, y_there.position);
                assert_eq!(view.from_x::<f32>().visible(&y, true), view_there.from_x::<f32>().visible(&y_there, true));
                let psi = Segment::to(&y).psi;
                assert_eq!(psi, Segment::to(&y_there).psi);
                same_reached(&view, &view_there, psi, scale_f32);
                same_reached(
                    &view,
                    &view_there,
                    Direction::polar(uv[0], (1.0 - uv[0] * uv[0]).sqrt(), uv[1]),
                    scale_f32,
                );
            }
        }
    }
}

fn same_reached(view: &View, view_there: &View, psi: Direction<f32>, scale: f32) {
    let ((y, some), (y_there, some_there)) =
        (view.from_x::<f32>().vp(psi).parts(), view_there.from_x::<f32>().vp(psi).parts());
    assert_eq!(some, some_there);
    if some {
        assert_eq!((y.position * scale, y.depth * scale), (y_there.position, y_there.depth));
    }
}

/// Distance between a ray's line and the nearest edge of a triangle, in metres.
fn nearest_edge(mesh: &Mesh, triangle: u32, ray: &Ray) -> f64 {
    let [a, b, c] = mesh.triangle(triangle).vertices();
    let direction = ray.direction.normalize();
    let gap = |(p, q): (DVec3, DVec3)| {
        let normal = direction.cross(q - p);
        (p - ray.origin).dot(normal.normalize_or_zero()).abs()
    };
    [(a, b), (b, c), (c, a)].map(gap).into_iter().fold(f64::INFINITY, f64::min)
}

/// Vertices move by half a unit in the last place of 1001 in each coordinate: 3.1e-5 m, 5.3e-5 m in all.
#[test]
fn a_kilometre_away_nothing_leaks_and_hits_agree_to_the_rounding_of_vertices() {
    let moved_by_rounding = 5.3e-5;
    let (mesh, targets) = cornell();
    let away = Geometry::new(carried(&mesh, |v| v + 1000.0), targets.clone());
    let here = Geometry::new(mesh, targets);
    let mut draws = Draws::new(302);
    let mut others = 0;
    for _ in 0..200_000 {
        let (from, direction) = (inside(&mut draws), draws.direction());
        if !clear_of_planes(here.mesh(), from) {
            continue;
        }
        let ray = Ray::new(from, direction);
        let hit = here.vp(&ray).expect("the room is closed");
        let there = away.vp(&Ray::new(from + 1000.0, direction)).expect("the room is closed a kilometre away");
        if hit.triangle == there.triangle {
            let triangle = here.mesh().triangle(hit.triangle);
            let cos = triangle.cross().normalize().dot(direction).abs();
            // A plane through three moved vertices lies within the same distance of the old one inside the triangle.
            let allowed = 3.0 * moved_by_rounding / cos;
            assert!((hit.t - there.t).abs() <= allowed, "{} and {}, allowed {allowed}", hit.t, there.t);
        } else {
            others += 1;
            let gap =
                nearest_edge(here.mesh(), hit.triangle, &ray).min(nearest_edge(here.mesh(), there.triangle, &ray));
            assert!(gap <= 2.0 * moved_by_rounding, "another triangle {gap} m from an edge: {hit:?}, {there:?}");
        }
    }
    assert!(others < 2000, "{others} of 200000 rays met another triangle");
}

/// Whether no plane of the mesh comes nearer than a millimetre, so that the blocking rule spares nothing here or there.
fn clear_of_planes(mesh: &Mesh, from: DVec3) -> bool {
    (0..mesh.len() as u32).all(|t| {
        let triangle = mesh.triangle(t);
        triangle.cross().normalize().dot(from - triangle.vertices()[0]).abs() > 1e-3
    })
}
