//! The directions in which one triangle hides an emitter.

use glam::DVec3;

use crate::facet::Facet;
use crate::value::EPSILON;

/// A convex cone with its apex at x: where a blocker stands before a facet's plane.
///
/// The rays that meet a triangle p₀p₁p₂ whose plane misses x are those with (pᵢ × pᵢ₊₁)·y >= 0 for
/// all i (oriented so that (p₀ × p₁)·p₂ > 0), however near or wide the triangle, so the blocker
/// itself need never be clipped. For y on the facet's plane, m·y = s, the triangle's plane N·y = D
/// stands before y where (s N − D m)·y > 0: the fourth plane through x.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    planes: [DVec3; 4],
    count: usize,
    /// A measure of the solid angle, to order blockers by.
    pub size: f64,
    /// How much rounding grows where this cone's boundary is a crossing with the facet's plane at a
    /// small angle (>= 1).
    pub amplification: f64,
}

/// How a cone and a convex polygon on the facet lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// One of the cone's planes separates them.
    Apart,
    /// The polygon lies in the cone.
    Covered,
    /// Neither.
    Meeting,
}

impl Cone {
    /// The cone of `blocker`, or `None` where it hides nothing of the facet's part above the horizon.
    pub fn new(blocker: &[DVec3; 3], facet: &Facet, sides: &[DVec3]) -> Option<Self> {
        let [a, b, c] = *blocker;
        let scale = a.abs().max(b.abs()).max(c.abs()).max_element().max(facet.reach);
        let tolerance = 8.0 * EPSILON * scale;
        let depth = blocker.map(|p| facet.m.dot(p) - facet.s);
        let outside = |plane: DVec3| blocker.iter().all(|p| plane.dot(*p) <= tolerance);
        if depth.iter().all(|&d| d >= -tolerance) || outside(DVec3::Z) || sides.iter().any(|&plane| outside(plane)) {
            return None;
        }
        let normal = (b - a).cross(c - a);
        let distance = normal.dot(a);
        let turn = if distance > 0.0 { 1.0 } else { -1.0 };
        let edge = |p: DVec3, q: DVec3| (p.cross(q - p) * turn).try_normalize();
        let mut cone = Self {
            planes: [edge(a, b)?, edge(b, c)?, edge(c, a)?, DVec3::ZERO],
            count: 3,
            size: distance.abs() / (a.length() * b.length() * c.length()),
            amplification: 1.0,
        };
        if depth.iter().any(|&d| d > tolerance) {
            let before = (normal * facet.s - facet.m * distance) * turn;
            cone.planes[3] = before.try_normalize()?;
            cone.count = 4;
            cone.amplification = (normal.length() * facet.s + distance.abs()) / before.length();
        }
        Some(cone)
    }

    /// The planes through x that bound the cone, unit normals pointing in.
    pub fn planes(&self) -> &[DVec3] {
        &self.planes[..self.count]
    }

    /// How the cone lies to a convex polygon; distances within `tolerance` metres of a plane are on it.
    pub fn relation(&self, polygon: &[DVec3], tolerance: f64) -> Relation {
        let mut covered = true;
        for plane in self.planes() {
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for v in polygon {
                let d = plane.dot(*v);
                low = low.min(d);
                high = high.max(d);
            }
            if high <= tolerance {
                return Relation::Apart;
            }
            covered &= low >= -tolerance;
        }
        if covered { Relation::Covered } else { Relation::Meeting }
    }
}

/// Unit normals, pointing in, of the planes through x and the edges of a convex polygon.
pub fn sides(polygon: &[DVec3]) -> Vec<DVec3> {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).filter_map(|(&v, &w)| v.cross(w - v).try_normalize()).collect()
}
