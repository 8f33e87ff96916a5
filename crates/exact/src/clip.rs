//! A convex polygon cut by a plane through x.

use glam::DVec3;

/// Which side of a cut a polygon, or part of it, lies on.
#[derive(Debug, Default)]
pub struct Halves {
    /// Where normal·v > 0; empty when nothing lies there.
    pub front: Vec<DVec3>,
    /// Where normal·v < 0; empty when nothing lies there.
    pub back: Vec<DVec3>,
}

impl Halves {
    /// Cuts `polygon` by the plane through x with unit `normal`. Vertices within `tolerance` metres
    /// of the plane lie on it, so that no sliver thinner than rounding is cut off. (Sutherland and
    /// Hodgman 1974, both sides at once.)
    pub fn cut(&mut self, polygon: &[DVec3], normal: DVec3, tolerance: f64) {
        self.front.clear();
        self.back.clear();
        let side = |v: DVec3| snapped(normal.dot(v), tolerance);
        let (mut in_front, mut behind) = (false, false);
        let mut p = polygon[polygon.len() - 1];
        let mut d_p = side(p);
        for &q in polygon {
            let d_q = side(q);
            if d_p * d_q < 0.0 {
                let at = crossing(p, d_p, q, d_q);
                self.front.push(at);
                self.back.push(at);
            }
            if d_q >= 0.0 {
                self.front.push(q);
            }
            if d_q <= 0.0 {
                self.back.push(q);
            }
            in_front |= d_q > 0.0;
            behind |= d_q < 0.0;
            (p, d_p) = (q, d_q);
        }
        if !in_front {
            self.front.clear();
        }
        if !behind {
            self.back.clear();
        }
    }
}

fn snapped(distance: f64, tolerance: f64) -> f64 {
    if distance.abs() <= tolerance { 0.0 } else { distance }
}

/// Where the edge meets the plane, computed from its front end whichever way it runs: neighbours
/// get the same point.
fn crossing(p: DVec3, d_p: f64, q: DVec3, d_q: f64) -> DVec3 {
    let (front, d_front, back, d_back) = if d_p > 0.0 { (p, d_p, q, d_q) } else { (q, d_q, p, d_p) };
    front + (back - front) * (d_front / (d_front - d_back))
}
