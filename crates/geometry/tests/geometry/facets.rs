//! Points on targets, and the segment that joins them to x.

use glam::{DVec3, Vec3};
use twoforms_geometry::frame::Frame;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::target::{Shape, Sides, Target};
use twoforms_geometry::view::{Effort, View};

use crate::draws::Draws;
use crate::meshes::{push_quad, push_triangle};

/// One two-sided target: corner, and its two edges from there.
struct Lone {
    corner: DVec3,
    e: DVec3,
    f: DVec3,
    geometry: Geometry,
}

impl Lone {
    /// A triangle or parallelogram with corners in about [-1, 1]³ around `centre`.
    fn new(draws: &mut Draws, parallelogram: bool, centre: DVec3) -> Self {
        let (a, e, f) = (centre + draws.in_cube(), draws.in_cube(), draws.in_cube());
        let mut mesh = Mesh::default();
        let corners = [a, a + e, a + e + f, a + f].map(DVec3::as_vec3);
        let shape = if parallelogram {
            let (triangles, corners) = push_quad(&mut mesh, corners);
            Shape::Parallelogram { triangles, corners }
        } else {
            Shape::Triangle(push_triangle(&mut mesh, [corners[0], corners[1], corners[3]]))
        };
        let [corner, along_e, _, along_f] = corners.map(|v: Vec3| v.as_dvec3());
        let geometry = Geometry::new(mesh, vec![Target { shape, sides: Sides::Both }]);
        Self { corner, e: along_e - corner, f: along_f - corner, geometry }
    }

    /// Coordinates of a world point along the two edges, and its distance from the plane.
    fn coordinates(&self, y: DVec3) -> ([f64; 2], f64) {
        let normal = self.e.cross(self.f);
        let v = y - self.corner;
        let along = |edge: DVec3| edge.dot(normal) / normal.length_squared();
        ([along(v.cross(self.f)), along(self.e.cross(v))], v.dot(normal.normalize()))
    }
}

fn world(frame: &Frame, y: &SurfacePoint<f32>) -> DVec3 {
    frame.x() + frame.to_world(local(y))
}

fn local(y: &SurfacePoint<f32>) -> DVec3 {
    DVec3::from_array(y.position.to_array().map(f64::from))
}

#[test]
fn points_lie_on_the_target() {
    let mut draws = Draws::new(700);
    for round in 0..2000 {
        let lone = Lone::new(&mut draws, round % 2 == 0, DVec3::ZERO);
        let frame = Frame::new(draws.in_cube() * 3.0, draws.direction());
        let view = View::new(&lone.geometry, frame, Effort::Cast);
        let facet = view.from_x::<f32>().facet(0);
        for _ in 0..50 {
            let y = facet.point([draws.unit_f32(), draws.unit_f32()], 0);
            let ([s, t], lift) = lone.coordinates(world(&frame, &y));
            // A few units in the last place of the largest number that went into the sum.
            let ulps = 4.0 * f64::from(f32::EPSILON) * (frame.x() - lone.corner).length().max(2.0);
            assert!(lift.abs() < ulps, "{lift} m off the plane, {ulps} allowed");
            let slack = ulps * (lone.e.length() + lone.f.length()) / lone.e.cross(lone.f).length();
            let past = if round % 2 == 0 { s.max(t) - 1.0 } else { s + t - 1.0 };
            assert!(s.min(t) > -slack && past < slack, "beyond an edge: {s}, {t}, slack {slack}");
        }
    }
}

/// Cells of equal area: 8 × 8 of a parallelogram, the 64 small triangles of a triangle.
fn cell([s, t]: [f64; 2], parallelogram: bool) -> usize {
    let index = |v: f64| ((v * 8.0).floor().max(0.0) as usize).min(7);
    let (i, j) = (index(s), index(t));
    if parallelogram {
        return i * 8 + j;
    }
    // Row i has 2 (8 − i) − 1 triangles; the second of each pair lies beyond the small diagonal.
    let beyond = usize::from((s * 8.0).fract() + (t * 8.0).fract() > 1.0);
    let before: usize = (0..i).map(|row| 2 * (8 - row) - 1).sum();
    (before + 2 * j + beyond).min(63)
}

/// Pearson's χ² on 64 cells of equal area against its quantile at level 10⁻⁴ for 63 degrees of freedom, 113.5.
#[test]
fn points_are_uniform_over_the_area() {
    let mut draws = Draws::new(701);
    for round in 0..20 {
        let parallelogram = round % 2 == 0;
        let lone = Lone::new(&mut draws, parallelogram, DVec3::ZERO);
        let frame = Frame::new(draws.in_cube() * 2.0, draws.direction());
        let facet = View::new(&lone.geometry, frame, Effort::Cast).from_x::<f32>().facet(0);
        let points = 20_000;
        let mut counts = [0_u32; 64];
        for _ in 0..points {
            let y = facet.point([draws.unit_f32(), draws.unit_f32()], 0);
            counts[cell(lone.coordinates(world(&frame, &y)).0, parallelogram)] += 1;
        }
        let expected = f64::from(points) / 64.0;
        let chi2: f64 = counts.iter().map(|&n| (f64::from(n) - expected).powi(2) / expected).sum();
        assert!(chi2 < 113.5, "round {round}: χ² = {chi2}, {counts:?}");
    }
}

#[test]
fn the_point_along_psi_is_the_same_point() {
    let mut draws = Draws::new(702);
    for round in 0..2000 {
        let lone = Lone::new(&mut draws, round % 2 == 0, DVec3::ZERO);
        let frame = Frame::new(draws.in_cube() * 3.0, draws.direction());
        let facet = View::new(&lone.geometry, frame, Effort::Cast).from_x::<f32>().facet(0);
        for _ in 0..50 {
            let y = facet.point([draws.unit_f32(), draws.unit_f32()], 0);
            let xy = Segment::to(&y);
            let back = facet.point_along(xy.psi, 0);
            // The plane is met under cosθ_y, which magnifies the rounding of Ψ and of the point.
            let allowed = 4.0 * f32::EPSILON * xy.r.max(2.0) / xy.cos_y;
            let gap = (back.position - y.position).length();
            assert!(gap <= allowed, "{gap} m apart, {allowed} allowed, cosθ_y = {}", xy.cos_y);
            assert_eq!((back.depth, back.target), (y.depth, y.target));
        }
    }
}

#[test]
fn a_segment_says_the_same_as_its_points() {
    let mut draws = Draws::new(703);
    for round in 0..2000 {
        let lone = Lone::new(&mut draws, round % 2 == 0, DVec3::ZERO);
        let frame = Frame::new(draws.in_cube() * 3.0, draws.direction());
        let y = View::new(&lone.geometry, frame, Effort::Cast)
            .from_x::<f32>()
            .facet(0)
            .point([draws.unit_f32(), draws.unit_f32()], 0);
        let xy = Segment::to(&y);
        let v = world(&frame, &y) - frame.x();
        let normal = lone.e.cross(lone.f).normalize();
        let (r, cos_x, cos_y) = (v.length(), frame.n_x().dot(v) / v.length(), normal.dot(v).abs() / v.length());
        let near = |one: f32, other: f64, error: f64| (f64::from(one) - other).abs() <= error;
        assert!(near(xy.r, r, 3e-7 * r) && near(xy.cos_x, cos_x, 3e-7) && near(xy.cos_y, cos_y, 1e-6), "{xy:?}");
        let d_omega = f64::from(xy.cos_y) / (r * r);
        assert!(near(xy.d_omega_d_area(), d_omega, 1e-6 * d_omega));
        assert!(near(xy.g(), f64::from(xy.cos_x) * d_omega, 1e-6 * d_omega));
        assert_eq!(xy.facing(), xy.cos_x > 0.0 && xy.cos_y > 0.0);
    }
}

/// Solid angle of a triangle: tan(Ω/2) = |abc| / (1 + a·b + b·c + c·a) for unit vectors. Van Oosterom and Strackee 1983,
/// "The Solid Angle of a Plane Triangle" (IEEE Trans. Biomed. Eng. 30(2)).
fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(DVec3::normalize);
    let volume = a.dot(b.cross(c)).abs();
    2.0 * volume.atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}

/// ∫ dω/dA dA over the target is the solid angle of its triangles, by the midpoint rule.
#[test]
fn the_jacobian_adds_up_to_the_solid_angle() {
    let mut draws = Draws::new(704);
    let steps = 64;
    for round in 0..200 {
        let lone = Lone::new(&mut draws, round % 2 == 0, DVec3::new(0.0, 0.0, 3.0));
        let frame = Frame::new(draws.in_cube(), draws.direction());
        let facet = View::new(&lone.geometry, frame, Effort::Cast).from_x::<f32>().facet(0);
        let middle = |k: u32| (k as f32 + 0.5) / steps as f32;
        let cells = (0..steps * steps).map(|k| [middle(k / steps), middle(k % steps)]);
        let sum: f64 = cells.map(|uv| f64::from(Segment::to(&facet.point(uv, 0)).d_omega_d_area())).sum();
        let mesh = lone.geometry.mesh();
        let target = lone.geometry.targets()[0];
        let integral = sum / f64::from(steps * steps) * target.area(mesh);
        let seen = target.triangles().map(|t| solid_angle(mesh.triangle(t).vertices().map(|v| v - frame.x())));
        let exact: f64 = seen.sum();
        assert!((integral - exact).abs() < 1e-3 * exact, "round {round}: {integral} sr, exactly {exact} sr");
    }
}
