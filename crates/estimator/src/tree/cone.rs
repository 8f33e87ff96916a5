//! Cones of directions.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DQuat, DVec3};

/// All directions at most `spread` radian from a unit vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cone {
    pub(super) axis: DVec3,
    pub(super) spread: f64,
}

impl Cone {
    /// A single direction, a unit vector.
    pub(super) fn of(axis: DVec3) -> Self {
        Self { axis, spread: 0.0 }
    }

    /// The least cone that holds two.
    pub(super) fn with(self, other: Self) -> Self {
        let (wide, narrow) = if self.spread < other.spread { (other, self) } else { (self, other) };
        let between = libm::atan2(wide.axis.cross(narrow.axis).length(), wide.axis.dot(narrow.axis));
        if between + narrow.spread <= wide.spread {
            return wide;
        }
        let spread = 0.5 * (wide.spread + between + narrow.spread);
        let turn = wide.axis.cross(narrow.axis).try_normalize();
        match turn {
            Some(turn) if spread < PI => {
                let axis = DQuat::from_axis_angle(turn, spread - wide.spread) * wide.axis;
                Self { axis: axis.normalize(), spread }
            }
            _ => Self { axis: wide.axis, spread: PI },
        }
    }

    /// The solid angle of the directions less than a quarter turn from one of the cone, those beyond the cone counted by the
    /// cosine of how far (Conty Estévez and Kulla 2018, section 4.4).
    pub(super) fn measure(self) -> f64 {
        let to = (self.spread + FRAC_PI_2).min(PI);
        let (sin, cos) = (libm::sin(self.spread), libm::cos(self.spread));
        let beyond = 2.0 * to * sin - libm::cos(self.spread - 2.0 * to) - 2.0 * self.spread * sin + cos;
        2.0 * PI * (1.0 - cos) + FRAC_PI_2 * beyond
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::DVec3;

    use super::Cone;

    #[test]
    fn a_cone_of_two_holds_both_and_no_more() {
        let right = Cone::of(DVec3::X).with(Cone::of(DVec3::Y));
        assert!((right.spread - PI / 4.0).abs() < 1e-12 && (right.axis.x - right.axis.y).abs() < 1e-12, "{right:?}");
        assert_eq!(right.with(Cone::of(DVec3::X)), right);
        assert!((Cone::of(DVec3::X).with(Cone::of(-DVec3::X)).spread - PI).abs() < 1e-12);
        assert_eq!(Cone { axis: DVec3::X, spread: 1.0 }.with(Cone::of(DVec3::X)).spread, 1.0);
    }

    /// A flat light shines into a hemisphere, ∫ cosθ dω = π, and a sphere everywhere, 4π.
    #[test]
    fn measures_are_the_known_ones() {
        assert!((Cone::of(DVec3::Z).measure() - PI).abs() < 1e-12);
        assert!((Cone { axis: DVec3::Z, spread: PI }.measure() - 4.0 * PI).abs() < 1e-12);
    }
}
