//! Convex cones with their apex at x.

use glam::DVec3;

use crate::real::Real;
use crate::vector::{Vector, round};

/// A convex cone: the directions on the inner side of three or four planes through x. What stands between x and a target,
/// and the outline of the target itself, are such cones.
///
/// An edge's plane is the cross product of its two vertices, taken in binary64 by two products and a difference, so
/// triangles on either side of an edge have exactly opposite planes, and a direction on the edge belongs to both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    planes: [[f32; 3]; 3],
    fourth: Option<[f32; 3]>,
}

impl Cone {
    /// The cone with these inward plane normals (any length, local): three or four. Missing ones bound nothing.
    pub(crate) fn new(normals: impl IntoIterator<Item = DVec3>) -> Self {
        let mut normals = normals.into_iter().map(|normal| round(normal.normalize_or_zero()));
        let planes = std::array::from_fn(|_| normals.next().unwrap_or_default());
        Self { planes, fourth: normals.next() }
    }

    /// Whether a direction (of any length) lies in the cone or on its boundary.
    #[inline(always)]
    pub fn holds<R: Real>(&self, toward: Vector<R>) -> R::Mask {
        let [a, b, c] = self.planes;
        let inside = inner(a, toward) & inner(b, toward) & inner(c, toward);
        match self.fourth {
            Some(d) => inside & inner(d, toward),
            None => inside,
        }
    }
}

#[inline(always)]
fn inner<R: Real>(normal: [f32; 3], toward: Vector<R>) -> R::Mask {
    R::zero().le(Vector::splat(normal).dot(toward))
}

/// The inward normals of the planes through x and the edges of a polygon that is convex as x sees it, its corners in
/// order in the frame of x. An edge that points straight at x gives the zero vector, which bounds nothing.
pub(crate) fn edge_planes(corners: &[DVec3]) -> impl Iterator<Item = DVec3> + '_ {
    let inward = orientation(corners);
    let next = |k: usize| corners[(k + 1) % corners.len()];
    (0..corners.len()).map(move |k| inward * corners[k].cross(next(k)))
}

/// +1 if the corners run counter-clockwise as x sees them, −1 if clockwise.
fn orientation(corners: &[DVec3]) -> f64 {
    let [a, rest @ ..] = corners else { return 1.0 };
    let volume: f64 = rest.windows(2).map(|edge| a.dot(edge[0].cross(edge[1]))).sum();
    1.0_f64.copysign(volume)
}
