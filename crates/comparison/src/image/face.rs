//! Faces: triangles as one eye sees them, with all of it that does not depend on the direction.

use glam::DVec3;

use crate::world::{Seen, World};

/// The plane of a triangle that the eye sees.
pub(super) struct Face {
    eye: DVec3,
    triangle: u32,
    /// Unit normal on the side of the eye, world.
    normal: DVec3,
    /// Whether that is the front.
    front: bool,
    /// Distance of the plane from the eye along that normal: below zero.
    height: f64,
}

impl Face {
    /// The face of a triangle whose plane does not hold the eye.
    pub(super) fn new(world: &World, eye: DVec3, triangle: u32) -> Self {
        let corners = world.geometry.mesh().triangle(triangle);
        let cross = corners.cross().normalize();
        let height = cross.dot(corners.a.as_dvec3() - eye);
        let front = height < 0.0;
        Self { eye, triangle, normal: if front { cross } else { -cross }, front, height: -height.abs() }
    }

    /// The point in a direction from the eye, world, of any length.
    pub(super) fn seen(&self, toward: DVec3) -> Seen {
        let Self { eye, triangle, normal, front, height } = *self;
        let distance = height / normal.dot(toward);
        Seen { position: eye + toward * distance, normal, distance, triangle, front }
    }
}
