//! A small polygon in place.

use glam::DVec3;

/// Up to six things in order: what four corners can have that are cut by one plane. (Five, but that corners which rounding
/// has left next to that plane may lie to either side in turn.)
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Few<T> {
    at: [T; 6],
    count: usize,
}

/// Corners in order.
pub(crate) type Polygon = Few<DVec3>;

impl<T> Few<T> {
    pub(crate) fn as_slice(&self) -> &[T] {
        &self.at[..self.count]
    }

    fn push(&mut self, thing: T) {
        self.at[self.count] = thing;
        self.count += 1;
    }
}

impl Polygon {
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

impl<T: Default> FromIterator<T> for Few<T> {
    fn from_iter<I: IntoIterator<Item = T>>(things: I) -> Self {
        let mut few = Self::default();
        things.into_iter().for_each(|thing| few.push(thing));
        few
    }
}
