//! What is found for many targets at once, against what is found for each alone.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};
use twoforms_geometry::frame::Frame;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::target::{Shape, Sides, Target};
use twoforms_geometry::view::{Need, Prospect, Standing, prospects};

use crate::draws::Draws;
use crate::meshes::{ball, push_quad, push_triangle, room, soup};

/// The prospect of every target that is met, by number, with all of its blockers.
fn all_at_once(geometry: &Geometry, frame: &Frame) -> BTreeMap<u32, Prospect> {
    let (mut met, mut first) = (BTreeMap::new(), BTreeMap::new());
    prospects(geometry, frame, |prospect| {
        if !prospect.complete {
            assert!(first.insert(prospect.target, prospect).is_none(), "shown in part twice");
            return Need::Complete;
        }
        let some = first.get(&prospect.target).map_or(&[][..], |p: &Prospect| &p.blockers);
        assert!(prospect.blockers.starts_with(some), "shown in part what is not in the whole");
        assert!(met.insert(prospect.target, prospect).is_none(), "met twice");
        Need::Nothing
    });
    met
}

fn one_by_one(geometry: &Geometry, frame: &Frame) -> BTreeMap<u32, Prospect> {
    let targets = 0..geometry.targets().len() as u32;
    let each = targets.map(|k| (k, Prospect::new(geometry, frame, k)));
    each.filter(|(_, p)| matches!(p.standing, Standing::Lit | Standing::On)).collect()
}

/// Checks that two prospects are of one target that stands alike, and that a triangle which one of them alone takes for a
/// blocker hides nothing: it passes by the pyramid, or stands before it beyond the target's plane.
fn check(one: &Prospect, other: &Prospect, draws: &mut Draws) {
    assert_eq!((one.target, one.standing, &one.corners), (other.target, other.standing, &other.corners));
    for (one, other) in [(one, other), (other, one)] {
        for lone in one.blockers.iter().filter(|b| !other.blockers.contains(b)) {
            for _ in 0..100 {
                let y = draws.barycentric().iter().zip(&one.corners).map(|(&w, &v)| w * v).sum::<DVec3>();
                assert!(y.z <= 0.0 || !stands_before(lone, y), "{lone:?} before {y}");
            }
        }
    }
}

/// Whether a triangle stands between x, at the origin, and y.
fn stands_before([a, b, c]: &[DVec3; 3], y: DVec3) -> bool {
    let sides = [a.cross(*b), b.cross(*c), c.cross(*a)].map(|side| side.dot(y));
    let normal = (b - a).cross(c - a);
    let along = normal.dot(*a) / normal.dot(y);
    let inside = sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0);
    inside && along > 0.0 && along < 1.0 - 1e-12
}

/// Checks both ways at one receiver; how many targets it meets, with how many blockers.
fn compare(geometry: &Geometry, frame: &Frame, draws: &mut Draws) -> [usize; 2] {
    let (all, each) = (all_at_once(geometry, frame), one_by_one(geometry, frame));
    assert!(all.keys().eq(each.keys()), "not the same targets are met from {frame:?}");
    all.values().zip(each.values()).for_each(|(one, other)| check(one, other, draws));
    [all.len(), all.values().map(|prospect| prospect.blockers.len()).sum()]
}

fn emitting(mesh: &Mesh, share: f64, draws: &mut Draws) -> Vec<Target> {
    let emits: Vec<u32> = (0..mesh.len() as u32).filter(|_| draws.chance(share)).collect();
    let sides = |draws: &mut Draws| if draws.chance(0.8) { Sides::Front } else { Sides::Both };
    emits.into_iter().map(|t| Target { shape: Shape::Triangle(t), sides: sides(draws) }).collect()
}

fn worlds(draws: &mut Draws) -> Vec<Geometry> {
    let lamp = |draws: &mut Draws| {
        let mut mesh = ball(4, || 0.5 + 0.2 * draws.unit());
        let inner = mesh.len();
        let others = soup(draws, 300, 0.3);
        others.triangles.iter().for_each(|t| _ = push_triangle(&mut mesh, t.map(|i| others.vertices[i as usize])));
        let targets = (0..inner as u32).map(|t| Target { shape: Shape::Triangle(t), sides: Sides::Front }).collect();
        Geometry::new(mesh, targets)
    };
    let some = |mesh: Mesh, share: f64, draws: &mut Draws| {
        let targets = emitting(&mesh, share, draws);
        Geometry::new(mesh, targets)
    };
    let sparse = soup(draws, 2000, 0.1);
    let dense = soup(draws, 200, 0.8);
    vec![lamp(draws), some(sparse, 0.1, draws), some(dense, 1.0, draws), some(room(), 0.5, draws)]
}

#[test]
fn what_is_found_at_once_is_what_is_found_one_by_one() {
    let mut draws = Draws::new(700);
    let mut sum = [0; 2];
    for geometry in worlds(&mut draws) {
        for _ in 0..60 {
            let scale = if draws.chance(0.3) { 20.0 } else { 1.0 };
            let frame = Frame::new(draws.in_cube() * scale, draws.direction());
            let met = compare(&geometry, &frame, &mut draws);
            sum = [sum[0] + met[0], sum[1] + met[1]];
        }
    }
    assert!(sum[0] > 10_000 && sum[1] > 100_000, "hardly anything was met: {sum:?}");
}

/// Receivers on the surfaces themselves, as pixels are.
#[test]
fn receivers_on_the_triangles_meet_the_same() {
    let mut draws = Draws::new(701);
    for geometry in worlds(&mut draws) {
        for _ in 0..60 {
            let triangle = geometry.mesh().triangle(draws.below(geometry.mesh().len()) as u32);
            let weights = draws.barycentric();
            let x = weights.iter().zip(triangle.vertices()).map(|(&w, v)| w * v).sum::<DVec3>();
            let side = if draws.chance(0.5) { 1.0 } else { -1.0 };
            let frame = Frame::new(x, side * triangle.cross().normalize());
            compare(&geometry, &frame, &mut draws);
        }
    }
}

/// A square light at height 1 that shines downward.
fn under_square(sides: Sides) -> Geometry {
    let mut mesh = Mesh::default();
    let at = |x: f32, y: f32| Vec3::new(x, y, 1.0);
    let (triangles, corners) = push_quad(&mut mesh, [at(-1.0, -1.0), at(-1.0, 1.0), at(1.0, 1.0), at(1.0, -1.0)]);
    Geometry::new(mesh, vec![Target { shape: Shape::Parallelogram { triangles, corners }, sides }])
}

#[test]
fn on_a_light_it_is_dark_where_x_looks_out_and_nowhere_else() {
    use Standing::{Dark, Lit, On, OnBack};
    let (down, up) = (DVec3::NEG_Z, DVec3::Z);
    let (inside, edge, beside) = (DVec3::new(0.3, 0.2, 1.0), DVec3::new(1.0, 0.2, 1.0), DVec3::new(1.1, 0.2, 1.0));
    let tilted = |n: DVec3| (n + 0.1 * DVec3::X).normalize();
    for (x, n_x, one_sided, two_sided) in [
        (inside, down, Dark, Dark),
        (inside, up, OnBack, Dark),
        (inside, tilted(down), On, On),
        (inside, tilted(up), OnBack, On),
        (inside, DVec3::X, On, On),
        (edge, down, Dark, Dark),
        (edge, DVec3::NEG_X, On, On),
        (edge, DVec3::X, Dark, Dark),
        (beside, DVec3::NEG_X, Dark, Dark),
        (beside, tilted(down), Dark, Dark),
        (inside - 1e-6 * up, up, Lit, Lit),
        (inside - 1e-6 * up, DVec3::X, Lit, Lit),
        (inside + 1e-6 * up, down, Dark, Lit),
        (inside + 1e-7 * up, down, Dark, Dark),
        (inside - 1e-7 * up, tilted(down), On, On),
    ] {
        for (sides, standing) in [(Sides::Front, one_sided), (Sides::Both, two_sided)] {
            let found = Prospect::new(&under_square(sides), &Frame::new(x, n_x), 0).standing;
            assert_eq!(found, standing, "{sides:?}, at {x} facing {n_x}");
        }
    }
}

/// Where a corner lies on x's horizon exactly, what is above the horizon is cut there twice, at the same point.
#[test]
fn a_light_that_stands_on_the_horizon_by_a_corner_is_blocked() {
    let mut mesh = Mesh::default();
    let corners = [[2.0, 0.0, 0.0], [2.0, -1.0, 1.0], [2.0, 0.0, 2.0], [2.0, 1.0, 1.0]];
    let (triangles, corners) = push_quad(&mut mesh, corners.map(Vec3::from));
    let blocker = [[1.0, -1.0, 0.1], [1.0, 1.0, 0.1], [1.0, 0.0, 2.0]];
    push_triangle(&mut mesh, blocker.map(Vec3::from));
    let light = Target { shape: Shape::Parallelogram { triangles, corners }, sides: Sides::Both };
    let geometry = Geometry::new(mesh, vec![light]);
    let frame = Frame::new(DVec3::ZERO, DVec3::Z);
    let prospect = Prospect::new(&geometry, &frame, 0);
    assert_eq!((prospect.standing, prospect.blockers.len()), (Standing::Lit, 1));
    assert_eq!(one_by_one(&geometry, &frame), all_at_once(&geometry, &frame));
}
