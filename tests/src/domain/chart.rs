//! A target as a map from the unit square.

use glam::{DVec2, DVec3};
use twoforms_estimator::measure::Aim;
use twoforms_geometry::blocking;
use twoforms_geometry::segment::SurfacePoint;
use twoforms_geometry::target::Sides;
use twoforms_geometry::vector::{Direction, Vector, round};
use twoforms_geometry::view::View;

/// A target in the frame of x, with coordinates (u, v) in the unit square that keep areas in proportion.
#[derive(Clone, Debug)]
pub struct Chart {
    index: u32,
    corners: Vec<DVec3>,
    /// N_y·(x − y) on the side that emits.
    depth: f64,
}

impl Chart {
    /// The chart of target `index` as `view` meets it.
    pub fn new(view: &View, index: u32) -> Self {
        let geometry = view.geometry();
        let target = &geometry.targets()[index as usize];
        let world = target.corners(geometry.mesh());
        let corners: Vec<DVec3> = world.as_slice().iter().map(|c| view.frame().localize(c.as_dvec3())).collect();
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        let distance = -normal.dot(corners[0]);
        let triangle = target.triangles().map(|t| geometry.mesh().triangle(t)).next().expect("a target has a triangle");
        let depth = match target.sides {
            _ if blocking::plane_holds(&triangle, view.frame().x()) => 0.0,
            Sides::Front => distance,
            Sides::Both => distance.abs(),
        };
        Self { index, corners, depth }
    }

    /// The point at (u, v): bilinear on a parallelogram; on a triangle a + √u ((b − a) + v (c − b)).
    pub fn point(&self, [u, v]: [f64; 2]) -> DVec3 {
        let [a, b, c] = [self.corners[0], self.corners[1], self.corners[2]];
        match self.corners.get(3) {
            None => a + ((b - a) + (c - b) * v) * libm::sqrt(u),
            Some(&d) => a.lerp(b, u).lerp(d.lerp(c, u), v),
        }
    }

    /// (u, v) of a point on the target.
    pub fn coordinates(&self, point: DVec3) -> [f64; 2] {
        let last = self.corners.len() - 1;
        let (e, f) = (self.corners[1] - self.corners[0], self.corners[last] - self.corners[0]);
        let (n, p) = (e.cross(f), point - self.corners[0]);
        let DVec2 { x: s, y: t } = DVec2::new(p.cross(f).dot(n), e.cross(p).dot(n)) / n.length_squared();
        if last == 3 { [s, t] } else { [(s + t) * (s + t), t / (s + t)] }
    }

    /// A local position as a point of this target.
    pub fn surface_point(&self, position: DVec3) -> SurfacePoint<f32> {
        SurfacePoint { position: Vector::from(round(position)), depth: self.depth as f32, target: self.index }
    }

    /// The direction to a local position, aimed at this target.
    pub fn aim(&self, position: DVec3) -> Aim<f32> {
        Aim { psi: Direction::of(Vector::from(round(position.normalize())), 1.0), target: self.index, alone: true }
    }

    /// Where a direction meets the target's plane.
    pub fn along(&self, psi: Direction<f32>) -> DVec3 {
        let psi = DVec3::from_array(psi.vector().to_array().map(f64::from));
        let normal = (self.corners[1] - self.corners[0]).cross(self.corners[2] - self.corners[0]);
        psi * (normal.dot(self.corners[0]) / normal.dot(psi))
    }

    /// Which target it is.
    pub fn index(&self) -> u32 {
        self.index
    }

    /// Area in square metres of the part that faces x: above x's horizon, if x is on a side that emits.
    pub fn facing_area(&self) -> f64 {
        if self.depth > 0.0 { self.open_area() } else { 0.0 }
    }

    /// The same whichever side it shows; zero where x lies in its plane.
    pub fn open_area(&self) -> f64 {
        if self.depth == 0.0 { 0.0 } else { fan_area(&above_horizon(&self.corners)) }
    }

    /// How far beside the target a direction passes, in its coordinates; at most zero where it meets it.
    pub fn miss(&self, psi: Direction<f32>) -> f64 {
        let at = self.along(psi);
        let ahead = at.dot(DVec3::from_array(psi.vector().to_array().map(f64::from))) > 0.0;
        let miss = self.coordinates(at).into_iter().map(|c| (-c).max(c - 1.0)).fold(f64::NEG_INFINITY, f64::max);
        if ahead && self.depth != 0.0 && miss.is_finite() { miss } else { f64::INFINITY }
    }
}

/// Area of a flat convex polygon.
pub fn fan_area(polygon: &[DVec3]) -> f64 {
    let cross = |w: &[DVec3]| (w[0] - polygon[0]).cross(w[1] - polygon[0]).length();
    polygon.windows(2).map(cross).sum::<f64>() / 2.0
}

/// Solid angle of a flat convex polygon from the origin: a fan of triangles, each by Van Oosterom and Strackee 1983,
/// tan(Ω/2) = a·(b × c) / (abc + (a·b) c + (b·c) a + (c·a) b).
pub fn fan_solid_angle(polygon: &[DVec3]) -> f64 {
    let a = polygon[0];
    let triangle = |w: &[DVec3]| {
        let (b, c) = (w[0], w[1]);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * libm::atan2(a.dot(b.cross(c)).abs(), denominator)
    };
    polygon[1..].windows(2).map(triangle).sum()
}

/// The part of a convex polygon with z > 0.
fn above_horizon(polygon: &[DVec3]) -> Vec<DVec3> {
    let mut kept = Vec::new();
    for (&from, &to) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        if from.z > 0.0 {
            kept.push(from);
        }
        if (from.z > 0.0) != (to.z > 0.0) {
            kept.push(from.lerp(to, from.z / (from.z - to.z)));
        }
    }
    if kept.is_empty() { vec![DVec3::ZERO] } else { kept }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn chart(corners: &[[f64; 3]]) -> Chart {
        Chart { index: 0, corners: corners.iter().map(|&c| DVec3::from(c)).collect(), depth: 1.0 }
    }

    #[test]
    fn coordinates_undo_the_map() {
        let triangle = chart(&[[0.0, 0.0, 1.0], [2.0, 0.0, 1.5], [0.5, 1.0, 1.0]]);
        let parallelogram = chart(&[[0.0, 0.0, 1.0], [2.0, 0.0, 1.5], [2.5, 1.0, 1.5], [0.5, 1.0, 1.0]]);
        for chart in [triangle, parallelogram] {
            for at in [[0.25, 0.75], [0.9, 0.1], [1.0, 1.0]] {
                let found = chart.coordinates(chart.point(at));
                assert!((found[0] - at[0]).abs() < 1e-14 && (found[1] - at[1]).abs() < 1e-14, "{found:?}");
            }
        }
    }

    /// A face of a cube as its centre sees it, whole and cut by the horizon.
    #[test]
    fn areas_and_solid_angles_of_a_cube() {
        let face = chart(&[[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]]);
        assert!((fan_solid_angle(&face.corners) - 4.0 * PI / 6.0).abs() < 1e-14);
        assert_eq!(face.facing_area(), 4.0);
        let side = chart(&[[1.0, -1.0, -1.0], [1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [1.0, -1.0, 1.0]]);
        assert_eq!(side.facing_area(), 2.0);
        let floor = chart(&[[-1.0, -1.0, -1.0], [1.0, -1.0, -1.0], [1.0, 1.0, -1.0]]);
        assert_eq!(floor.facing_area(), 0.0);
    }
}
