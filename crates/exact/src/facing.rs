//! What the exact light is computed from: the emitters as x meets them.

use glam::DVec3;

use crate::error::Error;
use crate::glow::Glow;
use crate::seen::Seen;

/// One emitter target in the receiver's local frame: x at the origin, its normal N_x along +Z,
/// metres, binary64.
#[derive(Clone, Debug, PartialEq)]
pub struct Facing {
    /// The target's number in the scene, for messages.
    pub target: u32,
    /// The light it belongs to: an index into the list of [`Light`]s.
    pub light: u32,
    /// Three corners, or four that run around a parallelogram, counter-clockwise seen from the
    /// front. Four that do not lie in one plane are taken as the triangles 0, 1, 2 and 0, 2, 3.
    pub corners: Vec<DVec3>,
    /// Whether x is on a side of the target from which light leaves.
    pub faces: bool,
    /// Area in m², once, whatever the sides.
    pub area: f64,
    /// L_e f_r toward x, linear RGB, W/(m² sr) or lm/(m² sr) for f_r = 1; its mean where the target emits by a texture.
    pub radiance: [f64; 3],
    /// Luminance of L_e itself, whatever the surface at x makes of it: lights are picked by that.
    pub emitted: f64,
    /// L_e toward x point by point, where the target emits by a texture.
    pub glow: Option<Glow>,
    /// Triangles that may stand between x and the target, in the same frame. A triangle whose plane
    /// holds x, and one that is coplanar with the target, block nothing and must have been left
    /// out. The others may lie anywhere: behind the target or across its plane, below the horizon,
    /// outside the pyramid.
    pub blockers: Vec<[DVec3; 3]>,
}

/// What the selection of lights needs to know of each light of the scene, whether x sees it or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Area of all its triangles in m², each counted once.
    pub area: f64,
    /// Area × luminance of L_e × number of emitting sides, up to a factor common to all lights.
    pub power: f64,
}

impl Facing {
    /// Whether one of these triangles stands before some of it, were nothing else in between.
    pub(crate) fn is_veiled(&self, veils: Vec<[DVec3; 3]>) -> Result<bool, Error> {
        let seen = Seen::facets(&Self { blockers: veils, glow: None, ..self.clone() })?;
        Ok(seen.iter().any(|seen| seen.blocked))
    }

    /// Refuses numbers that are not finite and lights that do not exist.
    pub(crate) fn check(&self, lights: usize) -> Result<(), Error> {
        let points = self.corners.iter().chain(self.blockers.iter().flatten());
        let finite = points.into_iter().all(|p| p.is_finite())
            && self.area.is_finite()
            && self.emitted.is_finite()
            && self.radiance.iter().all(|l| l.is_finite());
        if !finite {
            return Err(Error::NotFinite { target: self.target });
        }
        if self.light as usize >= lights {
            return Err(Error::NoSuchLight { target: self.target, light: self.light, lights });
        }
        Ok(())
    }
}
