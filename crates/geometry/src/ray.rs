//! Rays, hits, and the watertight test of a ray against a triangle.

use glam::DVec3;

use crate::mesh::Triangle;

/// A ray from an origin (world, metres) along a direction of any length; distances are in units of that length.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes; one that is not finite, or zero, meets nothing.
    pub direction: DVec3,
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

impl Ray {
    /// A ray.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction }
    }

    /// Whether it leads anywhere: its direction is finite and not zero.
    #[inline(always)]
    pub(crate) fn leads(&self) -> bool {
        self.direction.is_finite() && self.direction != DVec3::ZERO
    }

    /// The point at distance `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    /// The ray whose direction's largest component is between 1 and 2, and the power of two that divides its distances
    /// to give those of this one: exact, so that both meet the same triangles.
    pub(crate) fn scaled(&self) -> (Self, f64) {
        const EXPONENT: u64 = 0x7ff << 52;
        let most = self.direction.abs().max_element();
        let unit = f64::from_bits(most.to_bits() & EXPONENT).max(f64::MIN_POSITIVE);
        (Self { origin: self.origin, direction: self.direction / unit }, unit)
    }

    /// Distance to the triangle, if the ray meets it beyond its origin: t > 0. What touches the origin itself is not met,
    /// since it has a plane that holds the origin and blocks nothing (see [`blocking`](crate::blocking)).
    pub fn distance(&self, triangle: &Triangle) -> Option<f64> {
        Shear::new(self).distance(triangle)
    }
}

/// The translation and shear that carry a ray to the axis of its direction's largest component, from the origin on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shear {
    /// The axes x, y, z of the sheared space: z is that of the largest component.
    pub(crate) axes: [usize; 3],
    /// The ray's origin along them.
    pub(crate) origin: [f64; 3],
    /// d_z.
    pub(crate) along: f64,
    /// d_x / d_z and d_y / d_z.
    pub(crate) slope: [f64; 2],
    /// 1 / d_z.
    scale: f64,
}

/// Where a ray crosses a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing {
    /// The distance.
    pub(crate) t: f64,
    /// |N·(a − o)|, N = (b − a) × (c − a): six times the volume over the triangle with its apex at the ray's origin.
    pub(crate) volume: f64,
    /// The larger of the sheared x and y of the first vertex, which the ray passes at most this far along either axis.
    pub(crate) aside: f64,
}

/// The axes in cyclic order that end with a given one.
const CYCLES: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

impl Shear {
    /// The shear of no ray.
    pub(crate) const NONE: Self = Self { axes: [0; 3], origin: [0.0; 3], along: 0.0, slope: [0.0; 2], scale: 0.0 };

    /// The shear of a ray.
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> Self {
        let axes = CYCLES[ray.direction.abs().max_position()];
        let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
        let [x, y, z] = axes;
        let (origin, along) = ([o[x], o[y], o[z]], d[z]);
        Self { axes, origin, along, slope: [d[x] / along, d[y] / along], scale: 1.0 / along }
    }

    /// Distance to the triangle, if the ray meets it beyond its origin.
    #[inline(always)]
    pub(crate) fn distance(&self, triangle: &Triangle) -> Option<f64> {
        let vertices = [triangle.a.to_array(), triangle.b.to_array(), triangle.c.to_array()];
        self.crossing(|vertex, axis| vertices[vertex][axis]).map(|crossing| crossing.t)
    }

    /// Where the ray crosses the triangle with these coordinates, by vertex and axis.
    ///
    /// Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection" (JCGT 2(1)): translated by the origin and
    /// sheared along the ray, the triangle is held against the origin of a plane by three edge functions. Each is a
    /// difference of two rounded products, so its sign is never wrong (rounding is monotone), it is exactly opposite for
    /// the triangle across the edge, and zero counts as inside: no ray passes between triangles that share vertices.
    #[inline(always)]
    pub(crate) fn crossing(&self, coordinate: impl Fn(usize, usize) -> f32) -> Option<Crossing> {
        let [a, b, c] = [
            self.carry(|axis| coordinate(0, axis)),
            self.carry(|axis| coordinate(1, axis)),
            self.carry(|axis| coordinate(2, axis)),
        ];
        let u = c.x * b.y - c.y * b.x;
        let v = a.x * c.y - a.y * c.x;
        let w = b.x * a.y - b.y * a.x;
        if least(least(u, v), w) < 0.0 && most(most(u, v), w) > 0.0 {
            return None;
        }
        let det = u + v + w;
        if det == 0.0 {
            return None;
        }
        let moment = u * a.z + v * b.z + w * c.z;
        let t = moment / det;
        let (volume, aside) = ((moment * self.along).abs(), a.x.abs().max(a.y.abs()));
        (t > 0.0).then_some(Crossing { t, volume, aside })
    }

    /// A vertex translated by the origin and sheared, from its coordinates by axis.
    #[inline(always)]
    fn carry(&self, coordinate: impl Fn(usize) -> f32) -> DVec3 {
        let along = |k: usize| f64::from(coordinate(self.axes[k])) - self.origin[k];
        let depth = along(2);
        DVec3::new(along(0) - self.slope[0] * depth, along(1) - self.slope[1] * depth, self.scale * depth)
    }
}

/// The lesser of two numbers, in one instruction.
#[inline(always)]
fn least(one: f64, other: f64) -> f64 {
    if one < other { one } else { other }
}

/// The greater of two numbers, in one instruction.
#[inline(always)]
fn most(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}
