//! The angle of a vector.

use twoforms_geometry::real::{Real, arctan_defect};

/// The angle from the first axis to (x, y), y >= 0: from 0 to π, to some units in its last place.
#[inline(always)]
pub(crate) fn arc_tangent<R: Real>(y: R, x: R) -> R {
    let size = R::select(x.lt(R::zero()), -x, x);
    let steep = size.lt(y);
    let ratio = R::select(steep, size, y) / R::select(steep, y, size);
    let angle = ratio - arctan_defect(ratio);
    let angle = R::select(steep, R::splat(std::f32::consts::FRAC_PI_2) - angle, angle);
    R::select(x.lt(R::zero()), R::splat(std::f32::consts::PI) - angle, angle)
}

#[cfg(test)]
mod tests {
    use super::arc_tangent;

    #[test]
    fn angles_are_those_of_the_plane() {
        for k in 0..=1000 {
            let angle = f64::from(k) / 1000.0 * std::f64::consts::PI;
            let (sin, cos) = angle.sin_cos();
            let found = f64::from(arc_tangent(sin.abs() as f32, cos as f32));
            assert!((found - angle).abs() <= 4e-7 * angle.max(1e-6), "{found} {angle}");
        }
    }
}
