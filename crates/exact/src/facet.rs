//! A flat piece of an emitter, oriented toward x.

use glam::DVec3;

use crate::error::Error;
use crate::facing::Facing;
use crate::value::EPSILON;

/// A receiver is on a light when it is nearer than this to it, in units of its farthest corner's
/// distance: directions to the light's points are then known to fewer than six digits.
const ON_LIGHT: f64 = 1e-9;

/// A planar target, or one half of a target whose four corners do not lie in one plane.
#[derive(Clone, Debug)]
pub struct Facet {
    /// Corners in metres, around m: (v₁ − v₀) × (v₂ − v₀) points away from x.
    pub corners: Vec<DVec3>,
    /// Unit normal of the plane, from x toward it.
    pub m: DVec3,
    /// Distance of the plane from x, s = m·v > 0, in metres.
    pub s: f64,
    /// Area in m².
    pub area: f64,
    /// Distance from x to the farthest corner, in metres: the scale of the coordinates' rounding.
    pub reach: f64,
}

impl Facet {
    /// The planar facets of a target that x can see light from: none when x lies in its plane,
    /// beside it, or when it has collapsed to a line.
    ///
    /// # Errors
    /// [`Error::OnLight`] when x lies on the facet, nearer than 10⁻⁹ of the distance to its
    /// farthest corner.
    pub fn of(facing: &Facing) -> Result<Vec<Self>, Error> {
        let outlines = match facing.corners.as_slice() {
            &[a, b, c, d] if !flat(a, b, c, d) => vec![vec![a, b, c], vec![a, c, d]],
            corners => vec![corners.to_vec()],
        };
        outlines.into_iter().filter_map(|outline| Self::new(outline, facing.target).transpose()).collect()
    }

    fn new(mut corners: Vec<DVec3>, target: u32) -> Result<Option<Self>, Error> {
        let reach = corners.iter().map(|v| v.length()).fold(0.0, f64::max);
        let cross = doubled_area(&corners);
        let area = 0.5 * cross.length();
        let length = corners.iter().map(|v| v.distance(corners[0])).fold(0.0, f64::max);
        let Some(normal) = cross.try_normalize() else {
            return Ok(None);
        };
        let distance = normal.dot(nearest(&corners));
        if distance_to(&corners) <= ON_LIGHT * reach {
            return Err(Error::OnLight { target });
        }
        if distance.abs() <= 8.0 * EPSILON * reach || area <= 8.0 * EPSILON * reach * length {
            return Ok(None);
        }
        let m = normal * distance.signum();
        if distance < 0.0 {
            corners.reverse();
        }
        Ok(Some(Self { corners, m, s: distance.abs(), area, reach }))
    }

    /// Distances from x smaller than this are rounding, in metres.
    pub fn tolerance(&self) -> f64 {
        4.0 * EPSILON * self.reach
    }
}

/// Σ (vₖ − v₀) × (vₖ₊₁ − v₀): twice the area of a flat polygon along its normal.
pub fn doubled_area(polygon: &[DVec3]) -> DVec3 {
    let Some((&origin, rest)) = polygon.split_first() else {
        return DVec3::ZERO;
    };
    rest.windows(2).map(|pair| (pair[0] - origin).cross(pair[1] - origin)).sum()
}

/// The corner nearest to x, whose coordinates carry the least rounding.
fn nearest(corners: &[DVec3]) -> DVec3 {
    corners.iter().copied().fold(DVec3::INFINITY, |a, b| if b.length_squared() < a.length_squared() { b } else { a })
}

fn flat(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> bool {
    let normal = (c - a).cross(d - b).normalize_or_zero();
    let reach = a.abs().max(b.abs()).max(c.abs()).max(d.abs()).max_element();
    normal.dot(b - a).abs() <= 8.0 * EPSILON * reach && normal.dot(c - a).abs() <= 8.0 * EPSILON * reach
}

/// Distance from x to a flat convex polygon, in metres.
pub fn distance_to(polygon: &[DVec3]) -> f64 {
    let edges = || polygon.iter().zip(polygon.iter().cycle().skip(1));
    let normal = doubled_area(polygon).normalize_or_zero();
    if normal != DVec3::ZERO && edges().all(|(&v, &w)| v.cross(w - v).dot(normal) >= 0.0) {
        return normal.dot(nearest(polygon)).abs();
    }
    edges().map(|(&v, &w)| distance_to_segment(v, w)).fold(f64::INFINITY, f64::min)
}

fn distance_to_segment(v: DVec3, w: DVec3) -> f64 {
    let edge = w - v;
    let along = -v.dot(edge) / edge.length_squared();
    if along.is_nan() {
        return v.length();
    }
    (v + edge * along.clamp(0.0, 1.0)).length()
}
