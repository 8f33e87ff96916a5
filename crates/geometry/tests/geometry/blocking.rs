//! The one rule for what blocks, met through rays and through the view.

use glam::{DQuat, DVec3, Vec3};
use twoforms_geometry::blocking::{TOLERANCE, coplanar, plane_holds};
use twoforms_geometry::frame::Frame;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::mesh::{Mesh, Triangle};
use twoforms_geometry::ray::Ray;
use twoforms_geometry::target::{Shape, Sides, Target};
use twoforms_geometry::view::{Effort, View};

use crate::draws::Draws;
use crate::meshes::{carried, push_quad, push_triangle, turns};

/// A square of twice `half` a side with its front toward −z, at this height.
fn square(half: f32, height: f32) -> [Vec3; 4] {
    [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]].map(|[x, y]: [f32; 2]| Vec3::new(x * half, y * half, height))
}

fn push_light(mesh: &mut Mesh, corners: [Vec3; 4]) -> Target {
    let (triangles, corners) = push_quad(mesh, corners);
    Target { shape: Shape::Parallelogram { triangles, corners }, sides: Sides::Front }
}

/// A light at height 1 and whatever else is there.
fn under_light(others: impl FnOnce(&mut Mesh)) -> Geometry {
    let mut mesh = Mesh::default();
    let light = push_light(&mut mesh, square(0.2, 1.0));
    others(&mut mesh);
    Geometry::new(mesh, vec![light])
}

/// V(x, y) with y on target 0, by ray and by both efforts of the view, which have to agree.
fn seen(geometry: &Geometry, x: DVec3, y: DVec3) -> bool {
    let by_ray = geometry.visible(&Ray::new(x, y - x), 1.0, 0);
    let frame = Frame::new(x, (y - x).normalize());
    for effort in [Effort::Gather, Effort::Cast] {
        let view = View::new(geometry, frame, effort);
        let psi = twoforms_geometry::vector::Direction::polar(1.0, 0.0, 0.0);
        let (point, reached) = view.from_x::<f32>().vp(psi).parts();
        assert_eq!(reached, by_ray, "vp against V from {x} to {y}, {effort:?}");
        assert!(!reached || view.from_x::<f32>().visible(&point, true), "V against vp from {x} to {y}, {effort:?}");
    }
    by_ray
}

/// What a ceiling through the light is made of.
fn ceilings() -> [fn(&mut Mesh); 3] {
    [
        |mesh| {
            push_quad(mesh, square(1.0, 1.0));
        },
        |mesh| {
            push_triangle(mesh, [Vec3::new(-3.0, -2.0, 1.0), Vec3::new(0.05, 4.0, 1.0), Vec3::new(2.5, -1.5, 1.0)]);
        },
        |mesh| {
            for cell in 0..64 {
                let (s, t) = ((cell % 8) as f32 * 0.25 - 1.0, (cell / 8) as f32 * 0.25 - 1.0);
                let at = |x: f32, y: f32| Vec3::new(x, y, 1.0);
                push_quad(mesh, [at(s, t), at(s, t + 0.25), at(s + 0.25, t + 0.25), at(s + 0.25, t)]);
            }
        },
    ]
}

/// The light lies in the ceiling's plane, and the ceiling has no hole: every ray to the light's interior gives the light.
#[test]
fn a_light_in_the_ceiling_is_seen_from_every_angle() {
    let mut draws = Draws::new(500);
    for (ceiling, turn, light_first) in every_ceiling() {
        let moved = |v: DVec3| turn * v + DVec3::new(0.3, -0.2, 0.4);
        let (mesh, light) = lit_ceiling(ceiling, light_first);
        let geometry = Geometry::new(carried(&mesh, moved), vec![light]);
        for depth in [1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5] {
            for _ in 0..500 {
                let x = moved(DVec3::new(draws.between(-0.9, 0.9), draws.between(-0.9, 0.9), 1.0 - depth));
                let triangle = light.triangles().nth(draws.below(2)).map(|t| geometry.mesh().triangle(t).vertices());
                let weights = draws.barycentric().map(|w| 0.02 + 0.94 * w);
                let y = weights.iter().zip(triangle.expect("a square has two")).map(|(&w, v)| w * v).sum::<DVec3>();
                let hit = geometry.vp(&Ray::new(x, y - x)).expect("the light is there");
                assert_eq!(geometry.target_of(hit.triangle), Some(0), "from {x}, {depth} below, to {y}");
                assert!(geometry.visible(&Ray::new(x, y - x), hit.t, 0), "from {x}, {depth} below, to {y}");
            }
        }
    }
}

fn every_ceiling() -> impl Iterator<Item = (fn(&mut Mesh), DQuat, bool)> {
    let with_turns = ceilings().into_iter().flat_map(|c| turns().map(|turn| (c, turn)));
    with_turns.flat_map(|(c, turn)| [(c, turn, true), (c, turn, false)])
}

fn lit_ceiling(ceiling: fn(&mut Mesh), light_first: bool) -> (Mesh, Target) {
    let mut mesh = Mesh::default();
    if light_first {
        let light = push_light(&mut mesh, square(0.2, 1.0));
        ceiling(&mut mesh);
        (mesh, light)
    } else {
        ceiling(&mut mesh);
        let light = push_light(&mut mesh, square(0.2, 1.0));
        (mesh, light)
    }
}

#[test]
fn beside_the_light_the_ceiling_is_met() {
    let geometry = under_light(|mesh| {
        push_quad(mesh, square(1.0, 1.0));
    });
    let mut draws = Draws::new(501);
    for _ in 0..10_000 {
        let y = DVec3::new(draws.between(-0.9, 0.9), draws.between(0.201, 0.9), 1.0);
        let hit = geometry.vp(&Ray::new(DVec3::ZERO, y)).expect("the ceiling is there");
        assert_eq!(geometry.target_of(hit.triangle), None, "toward {y}");
    }
}

#[test]
fn a_tenth_of_a_millimetre_before_the_light_blocks_and_behind_it_does_not() {
    let mut draws = Draws::new(502);
    for (height, blocks) in [(0.9999, true), (0.5, true), (1.0001, false), (1.5, false), (1.0, false)] {
        let geometry = under_light(|mesh| {
            push_quad(mesh, square(0.4, height));
        });
        for _ in 0..1000 {
            let x = DVec3::new(draws.between(-0.1, 0.1), draws.between(-0.1, 0.1), draws.between(-1.0, 0.3));
            let y = DVec3::new(draws.between(-0.2, 0.2), draws.between(-0.2, 0.2), 1.0);
            assert_eq!(seen(&geometry, x, y), !blocks, "height {height}, from {x} to {y}");
        }
    }
}

/// A screen that stands in the plane x = 0, partly before and partly behind the light: from x on one side it hides what
/// lies on the other, by its part before the light alone.
#[test]
fn what_crosses_the_light_blocks_only_before_it() {
    let screen = |low: f32, high: f32| {
        let at = |y: f32, z: f32| Vec3::new(0.0, y, z);
        under_light(|mesh| {
            push_quad(mesh, [at(-2.0, low), at(2.0, low), at(2.0, high), at(-2.0, high)]);
        })
    };
    let (through, above) = (screen(0.5, 1.5), screen(1.0, 1.5));
    let mut draws = Draws::new(503);
    for _ in 0..5000 {
        let x = DVec3::new(draws.between(0.3, 0.5), draws.between(-0.5, 0.5), 0.0);
        let y = DVec3::new(draws.between(-0.2, 0.2), draws.between(-0.2, 0.2), 1.0);
        // Where the segment passes the plane x = 0, it is this high.
        let crossing = x.x / (x.x - y.x);
        assert_eq!(seen(&through, x, y), y.x >= 0.0 || crossing < 0.5, "from {x} to {y}");
        assert!(seen(&above, x, y), "blocked by what stands behind, from {x} to {y}");
    }
}

/// A skirt hangs from an edge of the light: it hides the light from one side and from the other nothing.
#[test]
fn a_skirt_on_the_edge_of_the_light_hides_one_side() {
    for turn in turns() {
        let mut mesh = Mesh::default();
        let light = push_light(&mut mesh, square(0.2, 1.0));
        let at = |y: f32, z: f32| Vec3::new(0.2, y, z);
        push_quad(&mut mesh, [at(-9.0, 0.0), at(9.0, 0.0), at(9.0, 1.0), at(-9.0, 1.0)]);
        let geometry = Geometry::new(carried(&mesh, |v| turn * v), vec![light]);
        let mut draws = Draws::new(504);
        for _ in 0..5000 {
            let outside = draws.chance(0.5);
            let x = DVec3::new(if outside { 0.5 } else { -0.5 }, draws.between(-0.5, 0.5), draws.between(0.1, 0.9));
            let y = DVec3::new(draws.between(-0.199, 0.199), draws.between(-0.199, 0.199), 1.0);
            assert_eq!(seen(&geometry, turn * x, turn * y), !outside, "from {x} to {y}");
        }
    }
}

#[test]
fn a_triangle_whose_plane_holds_x_blocks_nothing() {
    let wall = |offset: f32| {
        under_light(|mesh| {
            let at = |y: f32, z: f32| Vec3::new(offset, y, z);
            push_quad(mesh, [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 0.9), at(-1.0, 0.9)]);
        })
    };
    let tolerance = TOLERANCE as f32;
    for (offset, blocks) in [(0.0, false), (0.9 * tolerance, false), (1.1 * tolerance, true), (1e-4, true)] {
        let geometry = wall(offset);
        let [behind, beside] = [0.2, -0.2].map(|x| DVec3::new(x, 0.01, 1.0));
        assert_eq!(seen(&geometry, DVec3::ZERO, behind), !blocks, "{offset} m before the wall");
        assert!(seen(&geometry, DVec3::ZERO, beside));
    }
}

#[test]
fn tolerances_grow_with_the_coordinates() {
    let triangle = |z: f32, far: f32| Triangle {
        a: Vec3::new(far, 0.0, z),
        b: Vec3::new(far + 1.0, 0.0, z),
        c: Vec3::new(far, 1.0, z),
    };
    for far in [1.0, 64.0, 1000.0_f32] {
        let tolerance = TOLERANCE * f64::from(far + 1.0);
        let near = |factor: f64| DVec3::new(0.3, 0.2, factor * tolerance);
        assert!(plane_holds(&triangle(0.0, far), near(0.99)));
        assert!(!plane_holds(&triangle(0.0, far), near(1.01)));
        let lifted = |factor: f64| triangle((factor * tolerance) as f32, far);
        assert!(coplanar(&triangle(0.0, far), &lifted(0.99)) && coplanar(&lifted(0.99), &triangle(0.0, far)));
        assert!(!coplanar(&triangle(0.0, far), &lifted(1.01)) && !coplanar(&lifted(1.01), &triangle(0.0, far)));
    }
}

#[test]
fn the_dark_side_of_a_light_blocks_and_gives_nothing() {
    let mut mesh = Mesh::default();
    let upward = square(0.4, 0.5).map(|v| Vec3::new(v.y, v.x, v.z));
    let lights = [square(0.2, 1.0), upward].map(|corners| push_light(&mut mesh, corners));
    let geometry = Geometry::new(mesh, lights.to_vec());
    assert!(!seen(&geometry, DVec3::ZERO, DVec3::Z));
    assert!(seen(&geometry, DVec3::Z * 0.75, DVec3::Z));
}
