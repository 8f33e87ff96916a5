//! The frame of x.

use glam::{DMat3, DVec3};

/// Where x is and which way it faces: x becomes the origin, N_x the third axis. Kept in binary64, so that everything
/// that depends on x alone is translated and turned before it is rounded once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    x: DVec3,
    to_world: DMat3,
}

impl Frame {
    /// The frame at position `x` (world, metres) with unit normal `n_x` (world).
    ///
    /// The two tangents are those of Duff et al. 2017, "Building an Orthonormal Basis, Revisited" (JCGT 6(1)).
    pub fn new(x: DVec3, n_x: DVec3) -> Self {
        let sign = 1.0_f64.copysign(n_x.z);
        let a = -1.0 / (sign + n_x.z);
        let b = n_x.x * n_x.y * a;
        let tangent = DVec3::new(1.0 + sign * n_x.x * n_x.x * a, sign * b, -sign * n_x.x);
        let bitangent = DVec3::new(b, sign + n_x.y * n_x.y * a, -n_x.y);
        Self { x, to_world: DMat3::from_cols(tangent, bitangent, n_x) }
    }

    /// World position of x in metres.
    pub fn x(&self) -> DVec3 {
        self.x
    }

    /// World unit normal of x.
    pub fn n_x(&self) -> DVec3 {
        self.to_world.z_axis
    }

    /// A world position as seen from x.
    #[inline]
    pub fn localize(&self, position: DVec3) -> DVec3 {
        self.to_world.transpose() * (position - self.x)
    }

    /// A world vector turned to local axes.
    #[inline]
    pub fn to_local(&self, vector: DVec3) -> DVec3 {
        self.to_world.transpose() * vector
    }

    /// A local vector turned back to world axes.
    #[inline]
    pub fn to_world(&self, vector: DVec3) -> DVec3 {
        self.to_world * vector
    }
}

#[cfg(test)]
mod tests {
    use super::Frame;
    use glam::{DMat3, DVec3};

    #[test]
    fn axes_are_orthonormal_and_right_handed_for_every_normal() {
        for n in [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z, DVec3::new(0.6, -0.48, -0.64)]
        {
            let m = Frame::new(DVec3::ZERO, n).to_world;
            assert!((m * m.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-15));
            assert!((m.determinant() - 1.0).abs() < 1e-15);
            assert_eq!(m.z_axis, n);
        }
    }
}
