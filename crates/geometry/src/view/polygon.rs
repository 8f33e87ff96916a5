//! A small polygon in place.

use glam::DVec3;

/// Up to six points, or planes, in order: what four corners can have that are cut by one plane. (Five, but that corners which
/// rounding has left next to that plane may lie to either side in turn.)
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Polygon {
    at: [DVec3; 6],
    count: usize,
}

impl Polygon {
    pub(crate) fn as_slice(&self) -> &[DVec3] {
        &self.at[..self.count]
    }

    fn push(&mut self, point: DVec3) {
        self.at[self.count] = point;
        self.count += 1;
    }

    /// The part above x's horizon (z > 0) of a convex polygon of up to four corners, by Sutherland and Hodgman 1974.
    pub(crate) fn above_horizon(corners: &[DVec3]) -> Self {
        let mut kept = Self::default();
        for (k, &from) in corners.iter().enumerate() {
            let to = corners[(k + 1) % corners.len()];
            if from.z > 0.0 {
                kept.push(from);
            }
            if (from.z > 0.0) != (to.z > 0.0) {
                kept.push(from.lerp(to, from.z / (from.z - to.z)));
            }
        }
        kept
    }
}

/// The part of a convex polygon where `height` is not below zero, a function that is linear in place (Sutherland and
/// Hodgman 1974).
pub(crate) fn clipped(corners: &[DVec3], height: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (k, &from) in corners.iter().enumerate() {
        let to = corners[(k + 1) % corners.len()];
        let (p, q) = (height(from), height(to));
        if p >= 0.0 {
            kept.push(from);
        }
        if (p >= 0.0) != (q >= 0.0) {
            kept.push(from.lerp(to, p / (p - q)));
        }
    }
    kept
}

impl FromIterator<DVec3> for Polygon {
    fn from_iter<I: IntoIterator<Item = DVec3>>(points: I) -> Self {
        let mut polygon = Self::default();
        points.into_iter().for_each(|point| polygon.push(point));
        polygon
    }
}
