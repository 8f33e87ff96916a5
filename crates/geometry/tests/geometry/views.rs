//! The view's two ways, by planes and by rays, against each other and against brute force.

use glam::{DVec3, Vec3};
use twoforms_geometry::frame::Frame;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::target::{Shape, Sides, Target};
use twoforms_geometry::vector::{Direction, Vector};
use twoforms_geometry::view::{Between, Effort, View};

use crate::draws::Draws;
use crate::meshes::{push_quad, push_triangle};
use crate::oracle;

/// A few units in the last place of a binary32 direction, in radians.
const NEAR: f64 = 8.0 * f32::EPSILON as f64;

/// Appends a target of one or two triangles somewhere in [-1, 1]³.
fn push_target(mesh: &mut Mesh, draws: &mut Draws) -> Target {
    let size = draws.between(0.05, 0.8);
    let (a, e, f) = (draws.in_cube(), draws.in_cube() * size, draws.in_cube() * size);
    let shape = if draws.chance(0.5) {
        Shape::Triangle(push_triangle(mesh, [a, a + e, a + f].map(DVec3::as_vec3)))
    } else {
        let (triangles, corners) = push_quad(mesh, [a, a + e, a + e + f, a + f].map(DVec3::as_vec3));
        Shape::Parallelogram { triangles, corners }
    };
    Target { shape, sides: if draws.chance(0.5) { Sides::Front } else { Sides::Both } }
}

/// A triangle that x may see before, across, beside or behind a target.
fn blocker(mesh: &Mesh, target: &Target, frame: &Frame, draws: &mut Draws) -> [Vec3; 3] {
    let corners = target.corners(mesh);
    let corner = |k: usize| corners.as_slice()[k].as_dvec3();
    let (e, f) = (corner(1) - corner(0), corner(2) - corner(0));
    let normal = e.cross(f).normalize();
    let [s, t] = [draws.unit(), draws.unit()];
    let on_light = corner(0) + (e * (1.0 - s.sqrt())) + f * (s.sqrt() * t);
    let size = 10.0_f64.powf(draws.between(-3.0, -0.2));
    let around = |centre: DVec3, draws: &mut Draws| [(); 3].map(|()| centre + draws.in_cube() * size);
    let in_plane = |lift: f64, draws: &mut Draws| {
        [(); 3].map(|()| on_light + e * draws.between(-1.0, 1.0) + f * draws.between(-1.0, 1.0) + normal * lift)
    };
    let through_x = |draws: &mut Draws| {
        let (s, t) = (draws.in_cube(), draws.in_cube());
        [frame.x() + s, frame.x() + t, frame.x() - (s + t) * draws.unit()]
    };
    let at_foot = |draws: &mut Draws| around(frame.x() + draws.direction() * size, draws);
    let vertices = match draws.below(11) {
        0 => around(draws.in_cube(), draws),
        1 => around(on_light, draws),
        2 => [corner(0), corner(1), draws.in_cube()],
        3 => [corner(0), draws.in_cube(), draws.in_cube()],
        4 => around(frame.x() + (draws.direction() - frame.n_x() * 0.1) * size, draws),
        5 => in_plane(0.0, draws),
        6 => in_plane(10.0_f64.powf(draws.between(-4.0, -1.0)), draws),
        7 => around(on_light + (on_light - frame.x()) * draws.unit(), draws),
        8 => through_x(draws),
        9 => at_foot(draws),
        _ => around(frame.x().lerp(on_light, draws.unit()), draws),
    };
    vertices.map(DVec3::as_vec3)
}

fn frame(draws: &mut Draws) -> Frame {
    let n_x = if draws.chance(0.3) { DVec3::NEG_Y } else { draws.direction() };
    let x = draws.in_cube();
    Frame::new(if draws.chance(0.5) { x.as_vec3().as_dvec3() } else { x }, n_x)
}

/// Targets and triangles around them, as x meets them.
fn scene(draws: &mut Draws, frame: &Frame, targets: usize, blockers: usize) -> (Mesh, Vec<Target>) {
    let mut mesh = Mesh::default();
    let targets: Vec<Target> = (0..targets).map(|_| push_target(&mut mesh, draws)).collect();
    for _ in 0..blockers {
        let target = targets[draws.below(targets.len())];
        let corners = blocker(&mesh, &target, frame, draws);
        push_triangle(&mut mesh, corners);
    }
    (mesh, targets)
}

/// Two ways to answer, how often they were asked the same, and how often they differed.
#[derive(Debug, Default)]
struct Tally {
    samples: u64,
    positive: u64,
    differ: u64,
    farthest: f64,
}

impl Tally {
    /// Counts an answer; a difference is looked up for how near to an edge it stands.
    fn count(&mut self, one: Option<u32>, other: Option<u32>, nearest_change: impl FnOnce() -> f64) {
        self.samples += 1;
        self.positive += u64::from(other.is_some());
        if one != other {
            self.differ += 1;
            self.farthest = self.farthest.max(nearest_change());
        }
    }

    fn check(&self, name: &str) {
        println!("{name}: {self:?}");
        assert!(self.farthest <= NEAR, "{name}: a difference far from every edge, {self:?}");
        assert!(self.differ <= self.samples.div_ceil(1_000_000), "{name}: too many differences, {self:?}");
        assert!(self.positive > self.samples / 100, "{name}: hardly anything was seen, {self:?}");
    }
}

fn wide(v: Vector<f32>) -> DVec3 {
    DVec3::from_array(v.to_array().map(f64::from))
}

/// Points on the targets that x and they face each other at.
fn facing_points(view: &View, draws: &mut Draws, each: usize) -> Vec<SurfacePoint<f32>> {
    let count = view.geometry().targets().len() as u32;
    let mut point = |k| view.from_x::<f32>().facet(k).point([draws.unit_f32(), draws.unit_f32()], k);
    let points = (0..count).flat_map(|k| vec![k; each]).map(&mut point);
    points.filter(|y| Segment::to(y).facing()).collect()
}

/// Directions over the hemisphere, and toward the points.
fn directions(points: &[SurfacePoint<f32>], draws: &mut Draws, spread: usize) -> Vec<Direction<f32>> {
    let over_hemisphere = (0..spread).map(|_| {
        let cos = draws.unit_f32();
        Direction::polar(cos, (1.0 - cos * cos).sqrt(), draws.unit_f32())
    });
    over_hemisphere.chain(points.iter().map(|y| Segment::to(y).psi)).collect()
}

fn reached(view: &View, psi: Direction<f32>) -> Option<u32> {
    let (y, some) = view.from_x::<f32>().vp(psi).parts();
    some.then_some(y.target)
}

/// What brute force reaches, if on a side that emits.
fn reached_brute(brute: &Geometry, view: &View, psi: Direction<f32>) -> Option<u32> {
    let direction = view.frame().to_world(wide(psi.vector()));
    let lit = |&k: &u32| view.from_x::<f32>().facet(k).point_along(psi, k).depth > 0.0;
    oracle::reached(brute, view.frame().x(), direction).filter(lit)
}

fn compare(view: &View, other: &View, brute: &Geometry, draws: &mut Draws, tallies: &mut [Tally; 4]) {
    let x = view.frame().x();
    let change = |local: Vector<f32>| oracle::nearest_change(brute, x, view.frame().to_world(wide(local)));
    let points = facing_points(view, draws, 100);
    for y in &points {
        let as_option = |seen: bool| seen.then_some(y.target);
        let seen = as_option(view.from_x::<f32>().visible(y, true));
        let truth = oracle::visible(brute, x, x + view.frame().to_world(wide(y.position)), y.target);
        tallies[0].count(seen, as_option(other.from_x::<f32>().visible(y, true)), || change(y.position));
        tallies[1].count(seen, as_option(truth), || change(y.position));
    }
    for psi in directions(&points, draws, 200) {
        let found = reached(view, psi);
        tallies[2].count(found, reached(other, psi), || change(psi.vector()));
        tallies[3].count(found, reached_brute(brute, view, psi), || change(psi.vector()));
    }
}

fn check(tallies: &[Tally; 4]) {
    for (tally, name) in tallies.iter().zip(["V, view", "V, volumes", "vp, view", "vp, brute force"]) {
        tally.check(name);
    }
}

#[test]
fn planes_and_rays_see_alike() {
    let mut draws = Draws::new(600);
    let mut tallies = <[Tally; 4]>::default();
    for _ in 0..4000 {
        let frame = frame(&mut draws);
        let (targets, blockers) = (1 + draws.below(6), draws.below(41));
        let (mesh, targets) = scene(&mut draws, &frame, targets, blockers);
        let geometry = Geometry::new(mesh.clone(), targets.clone());
        let brute = Geometry::brute_force(mesh, targets);
        let (gathered, cast) = (View::new(&geometry, frame, Effort::Gather), View::new(&geometry, frame, Effort::Cast));
        compare(&gathered, &cast, &brute, &mut draws, &mut tallies);
    }
    check(&tallies);
}

#[test]
fn many_targets_are_found_by_rays() {
    let mut draws = Draws::new(601);
    let mut tallies = <[Tally; 4]>::default();
    for _ in 0..20 {
        let frame = frame(&mut draws);
        let targets = 65 + draws.below(40);
        let (mesh, targets) = scene(&mut draws, &frame, targets, 20);
        let geometry = Geometry::new(mesh.clone(), targets.clone());
        let brute = Geometry::brute_force(mesh, targets);
        let (one, other) = (View::new(&geometry, frame, Effort::Gather), View::new(&brute, frame, Effort::Gather));
        assert!(one.sights().is_none());
        compare(&one, &other, &brute, &mut draws, &mut tallies);
    }
    check(&tallies);
}

/// A light above x and, between them, leaves in many directions.
fn behind_leaves(leaves: usize, draws: &mut Draws) -> (Mesh, Vec<Target>) {
    let mut mesh = Mesh::default();
    let square = [[-0.5, -0.5], [-0.5, 0.5], [0.5, 0.5], [0.5, -0.5]];
    let (triangles, corners) = push_quad(&mut mesh, square.map(|[x, y]| Vec3::new(x, y, 1.0)));
    for _ in 0..leaves {
        let centre = DVec3::new(draws.between(-0.2, 0.2), draws.between(-0.2, 0.2), 0.5);
        push_triangle(&mut mesh, [(); 3].map(|()| (centre + draws.in_cube() * 0.04).as_vec3()));
    }
    (mesh, vec![Target { shape: Shape::Parallelogram { triangles, corners }, sides: Sides::Front }])
}

#[test]
fn too_many_blockers_are_left_to_rays() {
    let mut draws = Draws::new(602);
    let mut tallies = <[Tally; 4]>::default();
    for (leaves, gathers) in [(50, true), (64, true), (65, false), (100, false), (600, false)] {
        let (mesh, targets) = behind_leaves(leaves, &mut draws);
        let geometry = Geometry::new(mesh.clone(), targets.clone());
        let brute = Geometry::brute_force(mesh, targets);
        for _ in 0..50 {
            let x = DVec3::new(draws.between(-0.01, 0.01), draws.between(-0.01, 0.01), 0.0);
            let view = View::new(&geometry, Frame::new(x, DVec3::Z), Effort::Gather);
            let other = View::new(&brute, Frame::new(x, DVec3::Z), Effort::Cast);
            let between = view.sights().expect("one target is looked at")[0].between();
            assert_eq!(matches!(between, Between::Gathered(_)), gathers, "{leaves} leaves");
            compare(&view, &other, &brute, &mut draws, &mut tallies);
        }
    }
    check(&tallies);
}

/// Lights that share a vertex and edges, and blockers that tile the pyramid: neither gaps nor overlaps.
#[test]
fn tiled_blockers_let_nothing_through() {
    let mut draws = Draws::new(603);
    for _ in 0..200 {
        let mut mesh = Mesh::default();
        let square = [[-0.5, -0.5], [-0.5, 0.5], [0.5, 0.5], [0.5, -0.5]];
        let (triangles, corners) = push_quad(&mut mesh, square.map(|[x, y]| Vec3::new(x, y, 1.0)));
        let centre = Vec3::new(draws.between(-0.2, 0.2) as f32, draws.between(-0.2, 0.2) as f32, 0.6);
        let rim: Vec<Vec3> = (0..12)
            .map(|k| (f64::from(k) / 12.0 * std::f64::consts::TAU).sin_cos())
            .map(|(s, c)| DVec3::new(s, c, draws.between(0.4, 0.7)).as_vec3())
            .collect();
        for k in 0..12 {
            push_triangle(&mut mesh, [centre, rim[k], rim[(k + 1) % 12]]);
        }
        let targets = vec![Target { shape: Shape::Parallelogram { triangles, corners }, sides: Sides::Front }];
        let geometry = Geometry::new(mesh, targets);
        let x = DVec3::new(draws.between(-0.1, 0.1), draws.between(-0.1, 0.1), 0.0);
        let view = View::new(&geometry, Frame::new(x, DVec3::Z), Effort::Gather);
        assert!(matches!(view.sights().expect("one target")[0].between(), Between::Gathered(c) if !c.is_empty()));
        for y in facing_points(&view, &mut draws, 2000) {
            assert!(!view.from_x::<f32>().visible(&y, true), "seen through the joint at {:?} from {x}", y.position);
            assert_eq!(reached(&view, Segment::to(&y).psi), None);
        }
    }
}
