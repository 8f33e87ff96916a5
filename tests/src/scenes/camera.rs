//! From where a scene is looked at.

use glam::{DMat3, DQuat, DVec3};

/// A perspective camera that looks along its local -Z with +Y up, as glTF defines it.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// Where it is.
    pub eye: DVec3,
    /// Its orientation.
    pub rotation: DQuat,
    /// Vertical field of view in radians.
    pub yfov: f64,
    /// Width over height.
    pub aspect_ratio: f64,
}

impl Camera {
    /// Looks from `eye` at `target`, +Y up, 4:3.
    pub fn look_at(eye: DVec3, target: DVec3, yfov: f64) -> Self {
        let back = (eye - target).normalize();
        let right = DVec3::Y.cross(back).normalize();
        let axes = DMat3::from_cols(right, back.cross(right), back);
        Self { eye, rotation: DQuat::from_mat3(&axes), yfov, aspect_ratio: 4.0 / 3.0 }
    }
}
