//! Where irradiance is asked for.

use glam::{DQuat, DVec3, Quat, Vec3};

/// A point with a normal. Both are stored in binary32, so that every reader finds the same point
/// whether it reads the file in binary32 or binary64.
#[derive(Clone, Debug)]
pub struct Receiver {
    /// The name of its node.
    pub name: &'static str,
    /// Where it is.
    pub position: Vec3,
    /// Turns +Y into the normal.
    pub rotation: Quat,
    /// What is worth saying of it, put before the derivation of its answer; may be empty.
    pub note: &'static str,
}

/// Rotations that turn +Y into an axis. Their entries are 0, 1/2 and 1: no rounding anywhere.
pub const UP: Quat = Quat::IDENTITY;
pub const DOWN: Quat = Quat::from_xyzw(1.0, 0.0, 0.0, 0.0);
pub const PLUS_X: Quat = Quat::from_xyzw(0.5, 0.5, -0.5, 0.5);
pub const MINUS_X: Quat = Quat::from_xyzw(0.5, -0.5, 0.5, 0.5);
pub const MINUS_Z: Quat = Quat::from_xyzw(-0.5, 0.5, -0.5, 0.5);

impl Receiver {
    /// A receiver without a note.
    pub fn new(name: &'static str, position: [f32; 3], rotation: Quat) -> Self {
        Self { name, position: position.into(), rotation, note: "" }
    }

    /// The same receiver with a note.
    pub fn note(self, note: &'static str) -> Self {
        Self { note, ..self }
    }

    /// x, in binary64.
    pub fn x(&self) -> DVec3 {
        self.position.as_dvec3()
    }

    /// The unit normal that the stored rotation gives.
    pub fn n_x(&self) -> DVec3 {
        self.rotation.as_dquat().normalize() * DVec3::Y
    }
}

/// The shortest rotation of +Y into a direction, rounded to binary32; + 0 turns -0 into 0.
pub fn toward(normal: DVec3) -> Quat {
    let rotation = DQuat::from_rotation_arc(DVec3::Y, normal.normalize());
    Quat::from_array(rotation.to_array().map(|v| v as f32 + 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn named_rotations_turn_y_into_their_axes_exactly() {
        let normal = |rotation| Receiver::new("", [0.0; 3], rotation).n_x();
        assert_eq!(normal(UP), DVec3::Y);
        assert_eq!(normal(DOWN), -DVec3::Y);
        assert_eq!(normal(PLUS_X), DVec3::X);
        assert_eq!(normal(MINUS_X), -DVec3::X);
        assert_eq!(normal(MINUS_Z), -DVec3::Z);
    }
}
