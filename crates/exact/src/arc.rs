//! Integrals along one edge of a spherical polygon.

use glam::DVec3;

/// The great-circle arc that an edge v→w describes on the unit sphere about x.
///
/// p(t) = u cos t + q sin t, 0 <= t <= Θ, with u = v/|v| and q = G × u; G = v × (w − v) / |…| is
/// the unit normal that points into a polygon whose vertices run around its outward direction. (v ×
/// (w − v), not v × w: the difference of neighbours is exact, so a short edge keeps its digits.)
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    /// Unit normal of the arc's plane, pointing into the polygon.
    pub g: DVec3,
    /// Start, on the unit sphere.
    pub u: DVec3,
    /// Unit tangent at the start.
    pub q: DVec3,
    /// Length Θ = atan2(|v × w|, v·w), 0 <= Θ <= π.
    pub theta: f64,
    /// sin Θ.
    pub sin: f64,
    /// cos Θ.
    pub cos: f64,
    /// Distance from x to the edge's line, in metres.
    pub distance: f64,
}

impl Arc {
    /// The arc of the edge from `v` to `w`, whose lengths are given; `None` when it has no length
    /// or runs through x.
    pub fn new(v: DVec3, v_length: f64, w: DVec3, w_length: f64) -> Option<Self> {
        let edge = w - v;
        let cross = v.cross(edge);
        let size = cross.length();
        if size.is_nan() || size <= 0.0 {
            return None;
        }
        let (g, u) = (cross / size, v / v_length);
        let (dot, lengths) = (v.dot(w), v_length * w_length);
        Some(Self {
            g,
            u,
            q: g.cross(u),
            theta: size.atan2(dot),
            sin: size / lengths,
            cos: dot / lengths,
            distance: size / edge.length(),
        })
    }
}

/// Integrals over one arc of products of a = N_x·p and b = m·p.
#[derive(Clone, Copy, Debug)]
pub struct ArcIntegrals {
    /// ∫ a dt.
    pub a: f64,
    /// ∫ a² dt.
    pub aa: f64,
    /// ∫ a b dt.
    pub ab: f64,
    /// ∫ b² dt.
    pub bb: f64,
    /// ∫ a b³ dt.
    pub abbb: f64,
    /// ∫ a² b² dt.
    pub aabb: f64,
}

impl ArcIntegrals {
    /// With a = a₀ cos t + a₁ sin t and b likewise, every product is a sum of ∫ cosⁱ t sinʲ t dt,
    /// which are elementary.
    pub fn new(arc: &Arc, n_x: DVec3, m: DVec3) -> Self {
        let (a0, a1) = (n_x.dot(arc.u), n_x.dot(arc.q));
        let (b0, b1) = (m.dot(arc.u), m.dot(arc.q));
        let (theta, s, c) = (arc.theta, arc.sin, arc.cos);
        let (ss, cc, sc) = (s * s, c * c, s * c);
        // ∫ cos² = (Θ + sin Θ cos Θ)/2, ∫ cos sin = sin² Θ/2, ∫ sin² = (Θ − sin Θ cos Θ)/2
        let (i20, i11, i02) = (0.5 * (theta + sc), 0.5 * ss, 0.5 * (theta - sc));
        // ∫ cos⁴ = (3Θ + 3sc + 2sc³)/8, ∫ cos³ sin = s²(1 + c²)/4, ∫ cos² sin² = (Θ + sc − 2sc³)/8,
        // ∫ cos sin³ = s⁴/4, ∫ sin⁴ = (3Θ − 3sc − 2s³c)/8
        let i40 = 0.125 * (3.0 * (theta + sc) + 2.0 * sc * cc);
        let i31 = 0.25 * ss * (1.0 + cc);
        let i22 = 0.125 * (theta + sc - 2.0 * sc * cc);
        let i13 = 0.25 * ss * ss;
        let i04 = 0.125 * (3.0 * (theta - sc) - 2.0 * sc * ss);
        let one_minus_cos = if c > 0.0 { ss / (1.0 + c) } else { 1.0 - c };
        let (b00, b01, b11) = (b0 * b0, b0 * b1, b1 * b1);
        let (a00, a01, a11) = (a0 * a0, a0 * a1, a1 * a1);
        Self {
            a: a0 * s + a1 * one_minus_cos,
            aa: a00 * i20 + 2.0 * a01 * i11 + a11 * i02,
            ab: a0 * b0 * i20 + (a0 * b1 + a1 * b0) * i11 + a1 * b1 * i02,
            bb: b00 * i20 + 2.0 * b01 * i11 + b11 * i02,
            abbb: a0 * b0 * b00 * i40
                + (3.0 * a0 * b1 + a1 * b0) * b00 * i31
                + 3.0 * b01 * (a0 * b1 + a1 * b0) * i22
                + (a0 * b1 + 3.0 * a1 * b0) * b11 * i13
                + a1 * b1 * b11 * i04,
            aabb: a00 * b00 * i40
                + 2.0 * (a00 * b01 + a01 * b00) * i31
                + (a00 * b11 + 4.0 * a01 * b01 + a11 * b00) * i22
                + 2.0 * (a01 * b11 + a11 * b01) * i13
                + a11 * b11 * i04,
        }
    }
}
