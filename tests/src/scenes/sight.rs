//! What a point sees of a triangle that emits: exact up to rounding, by cutting polygons.

use glam::DVec3;

use super::Part;

/// The part of one emitting triangle that x sees, with x moved to the origin.
#[derive(Clone, Debug)]
pub struct Sight {
    /// Unit normal of the triangle's plane, pointing away from x.
    pub m: DVec3,
    /// Distance of the plane from x, in metres, positive.
    pub s: f64,
    /// Area above the horizon, in square metres, if nothing stood in between.
    pub unoccluded_area: f64,
    /// What is left: convex polygons that do not overlap, each running so that its normal is `m`.
    pub pieces: Vec<Vec<DVec3>>,
}

impl Sight {
    /// What x with normal `n` sees of a triangle of `light`, all triangles of `parts` being opaque.
    /// None if x is behind a one-sided light or in the triangle's plane, or the triangle is below
    /// the horizon.
    pub fn new(x: DVec3, n: DVec3, triangle: [DVec3; 3], light: &Part, parts: &[Part]) -> Option<Self> {
        if plane_holds(triangle, x, x) {
            return None;
        }
        let mut polygon = triangle.map(|v| v - x).to_vec();
        let front = front_normal(triangle);
        if front.dot(polygon[0]) < 0.0 {
            polygon.reverse();
        } else if !light.material.double_sided {
            return None;
        }
        let m = front * front.dot(polygon[0]).signum();
        let s = m.dot(polygon[0]);
        let above = clip(&polygon, n, 0.0);
        let unoccluded_area = area(&above);
        if unoccluded_area == 0.0 {
            return None;
        }
        let mut sight = Self { m, s, unoccluded_area, pieces: vec![above] };
        for occluder in parts.iter().flat_map(Part::triangles) {
            sight.hide_behind(x, occluder, triangle);
        }
        Some(sight)
    }

    /// Visible area in square metres.
    pub fn area(&self) -> f64 {
        self.pieces.iter().map(|piece| area(piece)).sum()
    }

    /// Takes away what the occluder hides. A triangle whose plane holds x hides nothing, nor does
    /// one in the plane of the light.
    fn hide_behind(&mut self, x: DVec3, occluder: [DVec3; 3], light: [DVec3; 3]) {
        let in_light_plane = occluder.iter().all(|&v| plane_holds(light, v, x));
        if in_light_plane || plane_holds(occluder, x, x) {
            return;
        }
        let near = clip(&occluder.map(|v| v - x), -self.m, -self.s);
        if near.len() < 3 {
            return;
        }
        let sides = pyramid(&near);
        let sliver = 1e-13 * self.unoccluded_area;
        self.pieces = self.pieces.iter().flat_map(|piece| outside(piece, &sides, sliver)).collect();
    }
}

/// Unit normal of the side from which the triangle runs counter-clockwise.
fn front_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize()
}

/// Whether the triangle's plane holds a point, up to what binary32 coordinates as large as those
/// of the triangle and x can tell: 4 · 2⁻²⁴ of the largest.
fn plane_holds(triangle: [DVec3; 3], point: DVec3, x: DVec3) -> bool {
    let largest = triangle.iter().chain([&x]).map(|v| v.abs().max_element()).fold(0.0, f64::max);
    let distance = front_normal(triangle).dot(point - triangle[0]).abs();
    distance <= 4.0 / f64::from(1 << 24) * largest
}

/// Area of a convex polygon.
fn area(polygon: &[DVec3]) -> f64 {
    let Some(&first) = polygon.first() else {
        return 0.0;
    };
    let fan = polygon.windows(2).map(|w| (w[0] - first).cross(w[1] - first));
    fan.sum::<DVec3>().length() / 2.0
}

/// The part of a convex polygon where h·v ≥ offset (Sutherland and Hodgman 1974).
fn clip(polygon: &[DVec3], h: DVec3, offset: f64) -> Vec<DVec3> {
    let mut kept = Vec::new();
    for (i, &v) in polygon.iter().enumerate() {
        let w = polygon[(i + 1) % polygon.len()];
        let (height_v, height_w) = (h.dot(v) - offset, h.dot(w) - offset);
        if height_v >= 0.0 {
            kept.push(v);
        }
        if height_v * height_w < 0.0 {
            kept.push(v + (w - v) * (height_v / (height_v - height_w)));
        }
    }
    kept
}

/// Normals, pointing inward, of the planes through the origin and the edges of a convex polygon.
fn pyramid(polygon: &[DVec3]) -> Vec<DVec3> {
    let middle: DVec3 = polygon.iter().sum();
    let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let sides = edges.map(|(&v, &w)| v.cross(w - v));
    sides.map(|side| side * side.dot(middle).signum()).filter(|&side| side != DVec3::ZERO).collect()
}

/// A convex polygon without what lies in the pyramid, as convex pieces larger than `sliver`.
fn outside(polygon: &[DVec3], pyramid: &[DVec3], sliver: f64) -> Vec<Vec<DVec3>> {
    let mut inside = polygon.to_vec();
    let mut pieces = Vec::new();
    for &side in pyramid {
        pieces.push(clip(&inside, -side, 0.0));
        inside = clip(&inside, side, 0.0);
    }
    if area(&inside) <= sliver {
        return vec![polygon.to_vec()];
    }
    pieces.retain(|piece| area(piece) > sliver);
    pieces
}
