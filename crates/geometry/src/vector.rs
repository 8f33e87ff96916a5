//! Vectors and directions in the numbers of formulas.

use std::ops::{Add, Mul, Neg, Sub};

use glam::DVec3;

use crate::real::Real;

/// A vector of three numbers per sample; lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<R> {
    /// Along the first axis.
    pub x: R,
    /// Along the second axis.
    pub y: R,
    /// Along the third axis.
    pub z: R,
}

impl<R: Real> Vector<R> {
    /// The vector with these coordinates.
    #[inline(always)]
    pub fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }

    /// The same vector for every sample.
    #[inline(always)]
    pub fn splat([x, y, z]: [f32; 3]) -> Self {
        Self::new(R::splat(x), R::splat(y), R::splat(z))
    }

    /// a·b.
    #[inline(always)]
    pub fn dot(self, other: Self) -> R {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// a × b.
    #[inline(always)]
    pub fn cross(self, b: Self) -> Self {
        let a = self;
        Self::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
    }

    /// |a|.
    #[inline(always)]
    pub fn length(self) -> R {
        self.dot(self).sqrt()
    }

    /// The coordinates in order.
    #[inline(always)]
    pub fn to_array(self) -> [R; 3] {
        [self.x, self.y, self.z]
    }
}

impl<R> From<[R; 3]> for Vector<R> {
    #[inline(always)]
    fn from([x, y, z]: [R; 3]) -> Self {
        Self { x, y, z }
    }
}

impl<R: Real> Add for Vector<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<R: Real> Sub for Vector<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<R: Real> Neg for Vector<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<R: Real> Mul<R> for Vector<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, scale: R) -> Self {
        Self::new(self.x * scale, self.y * scale, self.z * scale)
    }
}

/// A direction: Ψ, Θ or a normal, unit by construction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Direction<R>(Vector<R>);

impl<R: Real> Direction<R> {
    /// The direction at angle θ from the third axis and azimuth φ, from cosθ and sinθ (cos² + sin² = 1) and φ in turns.
    #[inline(always)]
    pub fn polar(cos_theta: R, sin_theta: R, turns: R) -> Self {
        let (sin_phi, cos_phi) = crate::real::sin_cos_turns(turns);
        Self(Vector::new(cos_phi * sin_theta, sin_phi * sin_theta, cos_theta))
    }

    /// The direction of a vector of length r > 0, from 1/r.
    #[inline(always)]
    pub fn of(vector: Vector<R>, per_r: R) -> Self {
        Self(vector * per_r)
    }

    /// As a unit vector.
    #[inline(always)]
    pub fn vector(self) -> Vector<R> {
        self.0
    }

    /// cosθ against the third axis, which is N_x in the frame of x.
    #[inline(always)]
    pub fn cos_theta(self) -> R {
        self.0.z
    }

    /// a·b.
    #[inline(always)]
    pub fn dot(self, other: Self) -> R {
        self.0.dot(other.0)
    }
}

impl<R: Real> Neg for Direction<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// Rounds a binary64 vector once, coordinate by coordinate.
#[inline]
pub fn round(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}
