//! Rays, hits, and the watertight test of a ray against a triangle.

use glam::DVec3;

use crate::mesh::Triangle;

/// A ray from an origin (world, metres) along a direction of any length; distances are in units of that length.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes.
    pub direction: DVec3,
    shear: Shear,
}

/// The triangle a ray meets, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in units of the ray's direction.
    pub t: f64,
    /// Triangle index in the mesh.
    pub triangle: u32,
}

impl Hit {
    /// Whether this hit comes before another; of two at the same distance the lower triangle index does, so that the
    /// answer does not depend on the order of traversal.
    pub fn before(&self, other: &Self) -> bool {
        (self.t, self.triangle) < (other.t, other.triangle)
    }
}

/// The shear that carries a direction to the unit vector of its largest axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shear {
    /// The axes x, y, z of the sheared space: z is that of the largest component.
    pub(crate) axes: [usize; 3],
    /// d_x / d_z and d_y / d_z.
    pub(crate) slope: [f64; 2],
    scale: f64,
}

impl Ray {
    /// A ray; the direction must be finite and not zero.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        let z = direction.abs().max_position();
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let slope = [direction[axes[0]] / direction[z], direction[axes[1]] / direction[z]];
        let scale = 1.0 / direction[z];
        Self { origin, direction, shear: Shear { axes, slope, scale } }
    }

    /// The shear that carries its direction to an axis.
    pub(crate) fn shear(&self) -> &Shear {
        &self.shear
    }

    /// The point at distance `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    /// Distance to the triangle, if the ray meets it beyond its origin.
    ///
    /// Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection" (JCGT 2(1)): translated by the origin and
    /// sheared along the ray, the triangle is held against the origin of a plane by three edge functions. Each is a
    /// difference of two rounded products, so its sign is never wrong (rounding is monotone), it is exactly opposite for
    /// the triangle across the edge, and zero counts as inside: no ray passes between triangles that share vertices.
    #[inline]
    pub fn distance(&self, triangle: &Triangle) -> Option<f64> {
        let [a, b, c] = triangle.vertices().map(|v| self.sheared(v));
        let u = c.x * b.y - c.y * b.x;
        let v = a.x * c.y - a.y * c.x;
        let w = b.x * a.y - b.y * a.x;
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let det = u + v + w;
        if det == 0.0 {
            return None;
        }
        let t = (u * a.z + v * b.z + w * c.z) / det;
        (t > 0.0).then_some(t)
    }

    #[inline]
    fn sheared(&self, vertex: DVec3) -> DVec3 {
        let Shear { axes, slope, scale } = self.shear;
        let v = vertex - self.origin;
        let z = v[axes[2]];
        DVec3::new(v[axes[0]] - slope[0] * z, v[axes[1]] - slope[1] * z, scale * z)
    }
}
