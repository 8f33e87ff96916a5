//! What bounds the light of some targets.

use glam::DVec3;

use super::cone::Cone;
use super::emitter::Emitter;

/// A box, the normals and the power of some targets, in metres and in luminance × m².
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
    /// The normals of the sides that emit; of two-sided targets, of one of their sides.
    pub(super) normals: Cone,
    /// Whether some emit to both sides.
    pub(super) both: bool,
    pub(super) power: f64,
}

impl From<&Emitter> for Bounds {
    fn from(emitter: &Emitter) -> Self {
        let corners = emitter.corners().iter();
        let (low, high) = corners
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), corner| (low.min(*corner), high.max(*corner)));
        Self { low, high, normals: Cone::of(emitter.normal), both: emitter.both, power: emitter.power }
    }
}

impl Bounds {
    /// What bounds both.
    pub(super) fn with(self, other: &Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            normals: self.normals.with(other.normals),
            both: self.both || other.both,
            power: self.power + other.power,
        }
    }

    pub(super) fn middle(&self) -> DVec3 {
        0.5 * (self.low + self.high)
    }

    /// How much it costs to take these together: power, times the area of the box, times the measure of the normals (Conty
    /// Estévez and Kulla 2018, equation 1).
    pub(super) fn cost(&self) -> f64 {
        let size = self.high - self.low;
        let area = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
        self.power * area * self.normals.measure()
    }
}
