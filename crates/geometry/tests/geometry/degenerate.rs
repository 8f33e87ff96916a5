//! Triangles without area, points in awkward places: no panic, no NaN, no hit.

use glam::{DVec3, Vec3};
use twoforms_geometry::frame::Frame;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::ray::Ray;
use twoforms_geometry::segment::Segment;
use twoforms_geometry::target::{Shape, Sides, Target};
use twoforms_geometry::vector::Direction;
use twoforms_geometry::view::{Effort, View};

use crate::draws::Draws;
use crate::meshes::{cuboid, push_quad, push_triangle, soup};

/// Triangles that are a point, a doubled edge or a line.
fn flat(draws: &mut Draws) -> [Vec3; 3] {
    // Few binary digits, so that the third vertex of a line lies on it exactly.
    let mut vertex = || (draws.in_cube() * 256.0).round().as_vec3() / 256.0;
    let (a, b) = (vertex(), vertex());
    match draws.below(3) {
        0 => [a, a, a],
        1 => [a, b, b],
        _ => [a, a + (b - a).signum() * 0.25, a + (b - a).signum() * 0.5],
    }
}

#[test]
fn triangles_without_area_are_never_met() {
    let mut draws = Draws::new(900);
    let mut mesh = Mesh::default();
    for _ in 0..200 {
        let corners = flat(&mut draws);
        push_triangle(&mut mesh, corners);
    }
    let flat_ones = mesh.clone();
    mesh.vertices.extend(cuboid(Vec3::splat(-2.0), Vec3::splat(2.0)).vertices);
    let first = flat_ones.vertices.len() as u32;
    mesh.triangles.extend(cuboid(Vec3::NEG_ONE, Vec3::ONE).triangles.iter().map(|t| t.map(|i| i + first)));
    let geometry = Geometry::new(mesh, Vec::new());
    for _ in 0..50_000 {
        let x = draws.in_cube();
        let toward = flat_ones.vertices[draws.below(flat_ones.vertices.len())].as_dvec3() - x;
        let hit = geometry.vp(&Ray::new(x, toward)).expect("a box stands around");
        assert!(hit.triangle >= flat_ones.len() as u32, "{hit:?}");
    }
}

#[test]
fn meshes_of_one_point_or_of_nothing_answer() {
    let repeated = |count: usize| Mesh { vertices: vec![Vec3::ONE; 3], triangles: vec![[0, 1, 2]; count] };
    for mesh in [Mesh::default(), repeated(1), repeated(2), repeated(5000)] {
        let geometry = Geometry::new(mesh, Vec::new());
        assert_eq!(geometry.vp(&Ray::new(DVec3::ZERO, DVec3::ONE)), None);
        let view = View::new(&geometry, Frame::new(DVec3::ZERO, DVec3::Z), Effort::Gather);
        assert!(view.sights().is_some_and(<[_]>::is_empty));
        assert!(!view.from_x::<f32>().vp(Direction::polar(1.0, 0.0, 0.0)).some());
    }
}

#[test]
fn a_heap_of_equal_triangles_is_met_at_its_first() {
    let mut mesh = Mesh::default();
    for _ in 0..5000 {
        push_triangle(&mut mesh, [Vec3::new(-1.0, -1.0, 1.0), Vec3::new(1.0, -1.0, 1.0), Vec3::new(0.0, 1.0, 1.0)]);
    }
    let hit = Geometry::new(mesh, Vec::new()).vp(&Ray::new(DVec3::ZERO, DVec3::Z));
    assert_eq!(hit.map(|hit| (hit.t, hit.triangle)), Some((1.0, 0)));
}

/// Every answer about points on the targets is finite where it counts.
fn questions(geometry: &Geometry, frame: Frame, draws: &mut Draws) {
    for effort in [Effort::Gather, Effort::Cast] {
        let view = View::new(geometry, frame, effort);
        for k in 0..geometry.targets().len() as u32 {
            let y = view.from_x::<f32>().facet(k).point([draws.unit_f32(), draws.unit_f32()], k);
            let xy = Segment::to(&y);
            if xy.facing() {
                assert!(xy.g().is_finite() && xy.d_omega_d_area().is_finite(), "{xy:?}");
                let _ = view.from_x::<f32>().visible(&y, true);
            }
            for _ in 0..4 {
                let cos = draws.unit_f32();
                let psi = Direction::polar(cos, (1.0 - cos * cos).sqrt(), draws.unit_f32());
                let (y, reached) = view.from_x::<f32>().vp(psi).parts();
                assert!(!reached || Segment::to(&y).g().is_finite(), "{y:?}");
                assert!(!reached || y.depth > 0.0, "{y:?}");
            }
        }
    }
}

#[test]
fn targets_without_area_and_x_on_lights_give_no_nan() {
    let mut draws = Draws::new(901);
    for _ in 0..300 {
        let mut mesh = soup(&mut draws, 5, 0.7);
        for _ in 0..3 {
            let corners = flat(&mut draws);
            push_triangle(&mut mesh, corners);
        }
        let light = |k| Target { shape: Shape::Triangle(k), sides: [Sides::Front, Sides::Both][k as usize % 2] };
        let (triangles, corners) = push_quad(&mut mesh, [draws.in_cube().as_vec3(); 4]);
        let mut targets: Vec<Target> = (0..8).map(light).collect();
        targets.push(Target { shape: Shape::Parallelogram { triangles, corners }, sides: Sides::Both });
        let geometry = Geometry::new(mesh, targets);
        let triangle = geometry.mesh().triangle(draws.below(8) as u32);
        let [a, b, c] = triangle.vertices();
        let normal = triangle.cross().normalize_or(DVec3::Y);
        for x in [a, a.lerp(b, 0.5), (a + b + c) / 3.0, (a + b + c) / 3.0 + normal * 1e-7, b + (b - a), DVec3::ZERO] {
            for n_x in [normal, -normal, draws.direction()] {
                questions(&geometry, Frame::new(x, n_x), &mut draws);
            }
        }
    }
}

/// x in the plane of a light sees nothing of it, however near.
#[test]
fn x_in_the_plane_of_a_light_gets_nothing_from_it() {
    let mut draws = Draws::new(902);
    for _ in 0..2000 {
        let mesh = soup(&mut draws, 1, 0.7);
        let [a, b, c] = mesh.triangle(0).vertices();
        let target = Target { shape: Shape::Triangle(0), sides: Sides::Both };
        let geometry = Geometry::new(mesh, vec![target]);
        let x = a + (b - a) * draws.between(-2.0, 2.0) + (c - a) * draws.between(-2.0, 2.0);
        let view = View::new(&geometry, Frame::new(x, draws.direction()), Effort::Gather);
        let y = view.from_x::<f32>().facet(0).point([draws.unit_f32(), draws.unit_f32()], 0);
        assert!(!Segment::to(&y).facing(), "{y:?} from {x}");
        assert!(!view.from_x::<f32>().vp(Segment::to(&y).psi).some());
    }
}

#[test]
fn hits_from_far_and_near_are_finite() {
    let mut draws = Draws::new(903);
    let mesh = soup(&mut draws, 100, 0.7);
    let geometry = Geometry::new(mesh, Vec::new());
    for k in 0..20_000 {
        let x = draws.in_cube() * 10.0_f64.powi(k % 12 - 6);
        let scale = 10.0_f64.powi(k % 40 - 20);
        let ray = Ray::new(x, (draws.in_cube() - x) * scale);
        if let Some(hit) = geometry.vp(&ray) {
            assert!(hit.t > 0.0 && hit.t.is_finite());
            let triangle = geometry.mesh().triangle(hit.triangle);
            let lift = triangle.cross().normalize().dot(ray.at(hit.t) - triangle.vertices()[0]);
            assert!(lift.abs() < 1e-9 * x.length().max(1.0), "{lift} m off the triangle, {ray:?}");
        }
    }
}

#[test]
fn rays_that_lead_nowhere_meet_nothing() {
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    let nowhere = [[0.0; 3], [-0.0; 3], [nan; 3], [nan, 1.0, 0.0], [0.0, 1.0, nan], [0.0, inf, 0.0], [1.0, -inf, nan]];
    let mesh = soup(&mut Draws::new(905), 500, 0.3);
    for geometry in [Geometry::new(mesh.clone(), Vec::new()), Geometry::brute_force(mesh, Vec::new())] {
        let somewhere = Ray::new(DVec3::splat(-9.0), DVec3::ONE);
        let mut rays: Vec<Ray> = nowhere.map(|d| Ray::new(DVec3::splat(0.1), d.into())).to_vec();
        for ray in &rays {
            assert_eq!(geometry.vp(ray), None, "{ray:?}");
            assert!(!geometry.blocked(ray, f64::INFINITY), "{ray:?}");
        }
        rays.push(somewhere);
        let mut hits = vec![geometry.vp(&somewhere); rays.len()];
        geometry.vp_of(&rays, &mut hits);
        assert!(hits[..nowhere.len()].iter().all(Option::is_none), "{hits:?}");
        assert_eq!(hits[nowhere.len()], geometry.vp(&somewhere));
        assert!(geometry.vp(&somewhere).is_some(), "soup on the way");
    }
}
