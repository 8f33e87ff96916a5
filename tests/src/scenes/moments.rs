//! M_ij = ∫ cosθ_x^i cosθ_y^j dω over a spherical polygon, in closed form.
//!
//! With a = n·w and b = m·w, the divergence theorem on the sphere turns each moment of degree
//! k = i + j ≥ 1 into integrals along the boundary and moments of degree k - 2:
//!
//!   k (k+1) M_ij = i(i-1) M_{i-2,j} + 2ij (n·m) M_{i-1,j-1} + j(j-1) M_{i,j-2} + B_ij,
//!   B_ij = Σ over arcs of ∫ (i (G·n) a^{i-1} b^j + j (G·m) a^i b^{j-1}) dt,
//!
//! G being the unit normal of the arc's plane that points into the polygon and `M_00` the solid
//! angle. `M_10` = ½ Σ Θ (G·n) is Lambert's irradiance (Photometria, 1760; Baum, Rushmeier and
//! Winget 1989); the others are equivalent to the double-axis moments of Arvo (1995,
//! "Applications of irradiance tensors to the simulation of non-Lambertian phenomena").

use glam::DVec3;

use super::cubature::gauss_legendre;

/// An edge as seen from the origin: the arc start·cos t + tangent·sin t, 0 ≤ t ≤ angle.
struct Arc {
    start: DVec3,
    tangent: DVec3,
    inward: DVec3,
    angle: f64,
}

impl Arc {
    /// None for an edge that the origin sees as a point.
    fn new(v: DVec3, w: DVec3) -> Option<Self> {
        let c = v.cross(w - v);
        let inward = c.try_normalize()?;
        let start = v.normalize();
        let angle = libm::atan2(c.length(), v.dot(w));
        Some(Self { start, tangent: inward.cross(start), inward, angle })
    }

    fn at(&self, t: f64) -> DVec3 {
        self.start * libm::cos(t) + self.tangent * libm::sin(t)
    }
}

/// A convex polygon as seen from the origin, with the two axes of its moments.
pub struct SphericalPolygon {
    n: DVec3,
    m: DVec3,
    corners: Vec<DVec3>,
    arcs: Vec<Arc>,
    rule: Vec<(f64, f64)>,
}

impl SphericalPolygon {
    /// The polygon must run counter-clockwise as seen from the origin's far side, so that its
    /// normal by the right-hand rule is `m`, which points away from the origin.
    pub fn new(polygon: &[DVec3], n: DVec3, m: DVec3) -> Self {
        let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
        Self {
            n,
            m,
            corners: polygon.iter().map(|v| v.normalize()).collect(),
            arcs: edges.filter_map(|(&v, &w)| Arc::new(v, w)).collect(),
            rule: gauss_legendre(16),
        }
    }

    /// M_ij.
    pub fn moment(&self, i: i32, j: i32) -> f64 {
        let k = i + j;
        if k == 0 {
            return self.solid_angle();
        }
        let term = |factor: i32, i, j| match factor {
            0 => 0.0,
            _ => f64::from(factor) * self.moment(i, j),
        };
        let lower = term(i * (i - 1), i - 2, j)
            + self.n.dot(self.m) * term(2 * i * j, i - 1, j - 1)
            + term(j * (j - 1), i, j - 2);
        (lower + self.boundary(i, j)) / f64::from(k * (k + 1))
    }

    /// Whether the sums lose more than a few digits: the polygon is narrower than an eighth of a
    /// radian, or the terms of Lambert's sum exceed the sum more than a hundredfold.
    pub fn cancels(&self) -> bool {
        let terms = || self.arcs.iter().map(|arc| arc.angle * arc.inward.dot(self.n));
        let widest = self.arcs.iter().map(|arc| arc.angle).fold(0.0, f64::max);
        let magnitude: f64 = terms().map(f64::abs).sum();
        widest < 0.125 || magnitude > 100.0 * terms().sum::<f64>().abs()
    }

    /// B_ij; 16 Gauss points are exact to rounding for trigonometric polynomials of low degree.
    fn boundary(&self, i: i32, j: i32) -> f64 {
        self.arcs.iter().map(|arc| self.arc_integral(arc, i, j)).sum()
    }

    fn arc_integral(&self, arc: &Arc, i: i32, j: i32) -> f64 {
        let (g_n, g_m) = (arc.inward.dot(self.n), arc.inward.dot(self.m));
        let integrand = |t| {
            let (a, b) = (self.n.dot(arc.at(t)), self.m.dot(arc.at(t)));
            derivative(i, a) * g_n * power(b, j) + derivative(j, b) * g_m * power(a, i)
        };
        let weighted = self.rule.iter().map(|&(u, weight)| weight * integrand(u * arc.angle));
        arc.angle * weighted.sum::<f64>()
    }

    /// Sum over a fan of spherical triangles (van Oosterom and Strackee 1983).
    fn solid_angle(&self) -> f64 {
        let [a, rest @ ..] = self.corners.as_slice() else {
            return 0.0;
        };
        let triangle = |b: DVec3, c: DVec3| 2.0 * libm::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(*a));
        rest.windows(2).map(|w| triangle(w[0], w[1])).sum()
    }
}

/// a^k for k ≥ 0.
fn power(a: f64, k: i32) -> f64 {
    (0..k).map(|_| a).product()
}

/// k a^{k-1}, which is 0 for k = 0.
fn derivative(k: i32, a: f64) -> f64 {
    f64::from(k) * power(a, k - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn octant_has_textbook_moments() {
        let octant = SphericalPolygon::new(&[DVec3::X, DVec3::Y, DVec3::Z], DVec3::X, DVec3::Y);
        let pi = std::f64::consts::PI;
        let cases = [(0, 0, pi / 2.0), (1, 0, pi / 4.0), (2, 0, pi / 6.0), (1, 1, 1.0 / 3.0)];
        for (i, j, expected) in cases {
            assert!((octant.moment(i, j) - expected).abs() < 1e-14, "M_{i}{j}");
        }
    }
}
