//! Moments of what x sees of a facet, by sums over edges.
//!
//! M_ij = ∫ aⁱ bʲ dω over a spherical polygon, a = N_x·Ψ = cosθ_x and b = m·Ψ = cosθ_y. The
//! divergence theorem on the sphere turns them into edge sums, with c = N_x·m, k = i + j >= 1, G
//! the arcs' inward normals, and k(k+1) the eigenvalue of the spherical Laplacian:
//!
//! k(k+1) M_ij = i(i−1) M_{i−2,j} + 2ij c M_{i−1,j−1} + j(j−1) M_{i,j−2} + B_ij,
//! B_ij = Σ_arcs ∫ (i (G·N_x) aⁱ⁻¹ bʲ + j (G·m) aⁱ bʲ⁻¹) dt, M_00 the solid angle.
//!
//! M_10 is Lambert's formula (1760; Baum, Rushmeier and Winget 1989); the rest equals the
//! double-axis moments of Arvo 1995.

use glam::DVec3;

use crate::arc::{Arc, ArcIntegrals};
use crate::facet::{Facet, doubled_area};
use crate::value::EPSILON;
use crate::visible::Pieces;

/// N_x: the receiver's normal in its own frame.
const N_X: DVec3 = DVec3::Z;

/// Moments of a set of polygons on one facet, unit radiance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// Area in m².
    pub area: f64,
    /// M_00: solid angle in sr.
    pub solid_angle: f64,
    /// M_10 = ∫ cosθ_x dω: projected solid angle, the irradiance at unit radiance.
    pub m10: f64,
    /// M_20 = ∫ cos²θ_x dω.
    pub m20: f64,
    /// M_23 = ∫ cos²θ_x cos³θ_y dω.
    pub m23: f64,
    /// Bound of the absolute error of each edge sum (all |aⁱ bʲ| <= 1): what the vertices' rounding
    /// moves across the edges, and the rounding of the sums themselves.
    pub error: f64,
    /// Bounds of the errors of M_00, M_10 and M_20: `error`, or smaller where cubature took the
    /// sums' place.
    pub errors: [f64; 3],
    /// How far rounding may move an outline, in metres.
    pub shift: f64,
    /// Bound of the area's error in m².
    pub area_error: f64,
}

/// The sums over arcs from which the moments follow.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    b10: f64,
    b01: f64,
    b20: f64,
    b03: f64,
    b12: f64,
    b21: f64,
    b23: f64,
    /// Σ Θ reach/distance.
    weighted_length: f64,
    perimeter: f64,
}

impl Moments {
    /// The moments of `pieces` on `facet`; `amplification` scales the error bound.
    pub fn of(pieces: &Pieces, facet: &Facet, amplification: f64) -> Self {
        let mut sums = Sums::default();
        let (mut area, mut solid_angle) = (0.0, 0.0);
        for polygon in pieces.iter() {
            sums.add(polygon, facet);
            area += 0.5 * doubled_area(polygon).dot(facet.m);
            solid_angle += solid_angle_of(polygon);
        }
        sums.moments(facet, area, solid_angle, amplification)
    }
}

impl Sums {
    fn add(&mut self, polygon: &[DVec3], facet: &Facet) {
        let mut v = polygon[polygon.len() - 1];
        let mut v_length = v.length();
        for &w in polygon {
            let w_length = w.length();
            if let Some(arc) = Arc::new(v, v_length, w, w_length) {
                self.add_arc(&arc, facet);
                self.perimeter += v.distance(w);
            }
            (v, v_length) = (w, w_length);
        }
    }

    fn add_arc(&mut self, arc: &Arc, facet: &Facet) {
        let (g_n, g_m) = (arc.g.dot(N_X), arc.g.dot(facet.m));
        let i = ArcIntegrals::new(arc, N_X, facet.m);
        self.b10 += g_n * arc.theta;
        self.b01 += g_m * arc.theta;
        self.b20 += 2.0 * g_n * i.a;
        self.b03 += 3.0 * g_m * i.bb;
        self.b12 += g_n * i.bb + 2.0 * g_m * i.ab;
        self.b21 += 2.0 * g_n * i.ab + g_m * i.aa;
        self.b23 += 2.0 * g_n * i.abbb + 3.0 * g_m * i.aabb;
        self.weighted_length += arc.theta * (facet.reach / arc.distance);
    }

    fn moments(&self, facet: &Facet, area: f64, solid_angle: f64, amplification: f64) -> Moments {
        let c = N_X.dot(facet.m);
        let m10 = self.b10 / 2.0;
        let m01 = self.b01 / 2.0;
        let m20 = (2.0 * solid_angle + self.b20) / 6.0;
        let m03 = (6.0 * m01 + self.b03) / 12.0;
        let m12 = (4.0 * c * m01 + 2.0 * m10 + self.b12) / 12.0;
        let m21 = (2.0 * m01 + 4.0 * c * m10 + self.b21) / 12.0;
        let m23 = (2.0 * m03 + 12.0 * c * m12 + 6.0 * m21 + self.b23) / 30.0;
        let rounding = 16.0 * EPSILON * amplification;
        let (error, shift) = (rounding * self.weighted_length, rounding * facet.reach);
        Moments {
            area,
            solid_angle,
            m10,
            m20,
            m23,
            error,
            errors: [error; 3],
            shift,
            area_error: shift * self.perimeter,
        }
    }
}

/// Solid angle of a convex polygon: triangles from its first vertex, tan(Ω/2) = u·(v×w)/(1 + u·v +
/// v·w + w·u) each (Van Oosterom and Strackee 1983). All terms are positive, so that a distant
/// polygon keeps its digits.
pub fn solid_angle_of(polygon: &[DVec3]) -> f64 {
    let origin = polygon[0];
    let r = origin.length();
    polygon[1..].windows(2).map(|edge| triangle_solid_angle(origin, r, edge[0], edge[1])).sum()
}

fn triangle_solid_angle(a: DVec3, a_length: f64, b: DVec3, c: DVec3) -> f64 {
    let (b_length, c_length) = (b.length(), c.length());
    let volume = a.dot((b - a).cross(c - a));
    let rest = a_length * b_length * c_length + a.dot(b) * c_length + b.dot(c) * a_length + c.dot(a) * b_length;
    2.0 * volume.atan2(rest)
}
