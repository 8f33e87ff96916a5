//! How much of what x sees a polygon takes up: by direction, and by what of it a surface receives.
//!
//! Polygons are convex and planar, their corners in metres in the frame of x, in either order around; x does not lie in
//! their plane. All in binary64.

use glam::DVec3;

/// The solid angle of a polygon seen from the origin, in steradian: not cut by the horizon.
///
/// A fan of triangles, each tan(Ω/2) = |a·(b×c)| / (abc + (a·b)c + (a·c)b + (b·c)a) (Van Oosterom and Strackee 1983, "The
/// solid angle of a plane triangle"), with the triple product taken of edges, which does not cancel for a small triangle.
pub fn solid_angle(corners: &[DVec3]) -> f64 {
    let Some((&a, rest)) = corners.split_first() else { return 0.0 };
    rest.windows(2).map(|pair| of_triangle(a, pair[0], pair[1])).sum()
}

fn of_triangle(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let triple = a.dot((b - a).cross(c - a)).abs();
    let [a_length, b_length, c_length] = [a, b, c].map(DVec3::length);
    let below = a_length * b_length * c_length + a.dot(b) * c_length + a.dot(c) * b_length + b.dot(c) * a_length;
    2.0 * libm::atan2(triple, below)
}

/// ∫ cosθ_x dω over the part of a polygon above the horizon z = 0, in steradian: what a surface receives from it at unit
/// radiance (Lambert 1760; Arvo 1995, "Analytic methods for simulated light transport", section 3.2): half the sum of
/// each edge's angle times the third coordinate of the unit normal of its plane through x.
pub fn projected_solid_angle(corners: &[DVec3]) -> f64 {
    let above = above_horizon(corners);
    let edges = above.iter().zip(above.iter().cycle().skip(1));
    let sum: f64 = edges.map(|(&v, &w)| of_edge(v, w)).sum();
    0.5 * sum.abs()
}

fn of_edge(v: DVec3, w: DVec3) -> f64 {
    let cross = v.cross(w - v);
    let length = cross.length();
    if length == 0.0 { 0.0 } else { libm::atan2(length, v.dot(w)) * (cross.z / length) }
}

/// The part of a convex polygon where z >= 0.
pub fn above_horizon(corners: &[DVec3]) -> Vec<DVec3> {
    let mut above = Vec::with_capacity(corners.len() + 1);
    for (&v, &w) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        if v.z >= 0.0 {
            above.push(v);
        }
        if (v.z > 0.0 && w.z < 0.0) || (v.z < 0.0 && w.z > 0.0) {
            above.push((v + (w - v) * (v.z / (v.z - w.z))).with_z(0.0));
        }
    }
    above
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use glam::DVec3;

    use super::{projected_solid_angle, solid_angle};

    fn square(half: f64, height: f64) -> [DVec3; 4] {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| DVec3::new(x * half, y * half, height))
    }

    /// An octant, a cube's face, and a tiny square, whose solid angle is its area over the squared distance.
    #[test]
    fn solid_angles_are_the_known_ones() {
        assert!((solid_angle(&[DVec3::X, DVec3::Y, DVec3::Z]) - FRAC_PI_2).abs() < 1e-15);
        assert!((solid_angle(&square(1.0, 1.0)) - 4.0 * PI / 6.0).abs() < 1e-15);
        assert!((solid_angle(&square(1e-6, 1.0)) / 4e-12 - 1.0).abs() < 1e-11);
    }

    /// All of the hemisphere receives π; half of a light that stands on the horizon is not received.
    #[test]
    fn projected_solid_angles_are_the_known_ones() {
        assert!((projected_solid_angle(&square(1e9, 1.0)) - PI).abs() < 1e-8);
        assert!((projected_solid_angle(&square(1e-6, 1.0)) / 4e-12 - 1.0).abs() < 1e-11);
        let upright = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[y, z]| DVec3::new(1.0, y, z));
        let above = [[-1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-1.0, 1.0]].map(|[y, z]| DVec3::new(1.0, y, z));
        assert!((projected_solid_angle(&upright) - projected_solid_angle(&above)).abs() < 1e-15);
    }
}
