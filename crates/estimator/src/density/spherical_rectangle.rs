//! Points of a rectangle uniform in solid angle (Ureña, Fajardo and King 2013, "An area-preserving parametrization for
//! spherical rectangles"), in a form that holds for rectangles of any size in binary32.
//!
//! In units of the distance of the rectangle's plane, from the foot of the perpendicular, it reaches from T₀ to T₁ along one side
//! and from Y₀ to Y₁ along the other. The share u of the solid angle Ω lies before T, where, with θ_i = atan Y_i,
//! A = asin(sinθ₁ sinφ) − asin(sinθ₀ sinφ) and T = tanφ, A = A₀ + uΩ. Inverse sines cancel where the rectangle is small; but
//! with p = tan(A/2)/tan((θ₁ − θ₀)/2), κ = tan²((θ₁ − θ₀)/2) tan²((θ₁ + θ₀)/2) and K the product of both 1 + tan²,
//!
//! T² = K p²/((1 − p²)(1 − κp²)),
//! p − p₀ = sin(uΩ/2)/(cos(A/2) cos(A₀/2) tan((θ₁ − θ₀)/2)),
//! T² − T₀² = K (p² − p₀²)(1 − κp²p₀²)/((1 − p²)(1 − κp²)(1 − p₀²)(1 − κp₀²)),
//!
//! in which differences are found as such. Along the other side h = Y/√(1 + T² + Y²) is uniform, and the difference of two Y
//! follows from that of their h in the same manner.

use std::f64::consts::PI;

use glam::DVec3;
use twoforms_geometry::real::{Real, sin_cos_turns};
use twoforms_geometry::solid_angle::solid_angle;

use super::arc_tangent::arc_tangent;

/// Numbers that a draw needs.
pub(crate) const ROW: usize = 12;

/// How far from right an angle may be, and from equal two opposite sides, in units of the sides: what it adds to the density.
const SQUARE: f64 = 1e-6;
/// The least distance of the plane over that of the farthest corner: nearer to the plane, 1 − p² and 1 − h² lose more digits in
/// binary32 than the 10⁻⁴ of accuracy that is promised.
const GRAZING: f64 = 1.0 / 16.0;

/// A rectangle as x sees it, prepared in binary64.
#[derive(Clone, Copy, Debug)]
pub struct SphericalRectangle {
    solid_angle: f64,
    row: [f64; ROW],
}

impl SphericalRectangle {
    /// The rectangle with these corners around x, the origin, which does not lie in its plane: metres, in the frame of x. None
    /// where they are no rectangle, or where x is near its plane, so that it is better drawn as triangles.
    pub fn new(corners: &[DVec3]) -> Option<Self> {
        let &[a, b, c, d] = corners else { return None };
        let (e, f) = (b - a, d - a);
        let [e_length, f_length] = [e.length(), f.length()];
        let square = e.dot(f).abs() <= SQUARE * e_length * f_length;
        let closed = (a - b + c - d).length() <= SQUARE * e_length.min(f_length);
        let (e_unit, f_unit) = (e / e_length, f / f_length);
        let distance = e_unit.cross(f_unit).normalize().dot(a).abs();
        let reach = corners.iter().map(|corner| corner.length()).fold(0.0, f64::max);
        if !(square && closed && distance >= GRAZING * reach) {
            return None;
        }
        let per = 1.0 / distance;
        let (t0, y0) = (e_unit.dot(a) * per, f_unit.dot(a) * per);
        let rectangle = Self {
            solid_angle: solid_angle(corners),
            row: row(solid_angle(corners), [t0, e_length * per], [y0, f_length * per]),
        };
        (rectangle.solid_angle > 0.0 && rectangle.row.iter().all(|number| number.is_finite())).then_some(rectangle)
    }

    /// Ω in steradian.
    pub fn solid_angle(&self) -> f64 {
        self.solid_angle
    }

    pub(crate) fn row(&self) -> [f32; ROW] {
        self.row.map(|number| number as f32)
    }

    /// Where two uniform numbers fall: shares of the sides from the first corner to the second and to the fourth.
    pub fn shares(&self, uv: [f32; 2]) -> [f32; 2] {
        shares(&self.row(), uv)
    }
}

/// The numbers of a rectangle from T₀ and Y₀, with its sides in the same unit.
fn row(solid_angle: f64, [t0, width]: [f64; 2], [y0, height]: [f64; 2]) -> [f64; ROW] {
    let y1 = y0 + height;
    let half_extent = 0.5 * libm::atan2(height, 1.0 + y0 * y1);
    let half_sum = 0.5 * (libm::atan(y1) + libm::atan(y0));
    let (extent, sum) = (libm::tan(half_extent), libm::tan(half_sum));
    let (d2, s2) = (extent * extent, sum * sum);
    let (kappa, k) = (d2 * s2, (1.0 + d2) * (1.0 + s2));
    let b = t0 * t0 * (1.0 + kappa) + k;
    let p0 = t0 * (2.0 / (b + (b * b - 4.0 * kappa * t0.powi(4)).sqrt())).sqrt();
    let cos = 1.0 / (1.0 + d2 * p0 * p0).sqrt();
    let q0 = (1.0 - p0) * (1.0 + p0) * (1.0 - kappa * p0 * p0);
    let turns = solid_angle / (4.0 * PI);
    [turns, cos, extent * p0 * cos, cos * extent, p0, kappa, k.sqrt(), t0, k / q0, width, y0, y1]
}

/// Where two uniform numbers fall.
#[inline(always)]
pub(crate) fn shares<R: Real>(row: &[R; ROW], [u, v]: [R; 2]) -> [R; 2] {
    let [turns, cos_start, sin_start, unit, p0, kappa, root_k, t0, k_per_q0, width, y0, y1] = *row;
    let (zero, one) = (R::zero(), R::one());
    let (sin, cos) = sin_cos_turns(u * turns);
    let rise = sin / ((cos_start * cos - sin_start * sin) * unit);
    let p = p0 + rise;
    let p2 = p * p;
    let q = (one - p) * (one + p) * (one - kappa * p2);
    let t = p * root_k / q.sqrt();
    // T² − T₀² over T + T₀, which does not cancel where T and T₀ lie on one side
    let squares = k_per_q0 * rise * (p + p0) * (one - kappa * p2 * p0 * p0) / q;
    let apart = R::select(zero.lt(p * p0), squares / (t + t0), t - t0);
    let [c0, h0, c1, h1, d] = slopes(t, [y0, y1]);
    let h = h0 + v * (y1 - y0) * c0 * c1 * (c0 + c1) / (d * (one + c0 * c1 + h0 * h1));
    let c = ((one - h) * (one + h)).sqrt();
    let up = v * c1 * (c0 + c1) * (one + c0 * c + h0 * h) / ((one + c0 * c1 + h0 * h1) * (c0 + c) * c);
    [apart / width, up]
}

/// The two uniform numbers that fall there.
#[inline(always)]
pub(crate) fn numbers<R: Real>(row: &[R; ROW], [along, up]: [R; 2]) -> [R; 2] {
    let [turns, cos_start, _, unit, p0, kappa, root_k, t0, k_per_q0, width, y0, y1] = *row;
    let (zero, one, two) = (R::zero(), R::one(), R::splat(2.0));
    let t = t0 + along * width;
    let t2 = t * t;
    let b = t2 * (one + kappa) + root_k * root_k;
    let p = t * (two / (b + (b * b - R::splat(4.0) * kappa * t2 * t2).sqrt())).sqrt();
    // p² − p₀² over p + p₀, which does not cancel where p and p₀ lie on one side
    let p2 = p * p;
    let squares = along * width * (t + t0) * (one - p) * (one + p) * (one - kappa * p2)
        / (k_per_q0 * (one - kappa * p2 * p0 * p0));
    let rise = R::select(zero.lt(p * p0), squares / (p + p0), p - p0);
    let extent = unit / cos_start;
    let half = arc_tangent(extent * rise, one + extent * extent * p * p0);
    let [c0, h0, c1, h1, d] = slopes(t, [y0, y1]);
    let y = y0 + up * (y1 - y0);
    let per = one / (d * d + y * y).sqrt();
    let (c, h) = (d * per, y * per);
    let v = up * (one + c0 * c1 + h0 * h1) * (c0 + c) * c / (c1 * (c0 + c1) * (one + c0 * c + h0 * h));
    [half / (turns * R::splat(std::f32::consts::TAU)), v]
}

/// Cosine and sine of the elevations of Y₀ and of Y₁ at T, and √(1 + T²).
#[inline(always)]
fn slopes<R: Real>(t: R, [y0, y1]: [R; 2]) -> [R; 5] {
    let d2 = R::one() + t * t;
    let d = d2.sqrt();
    let (per0, per1) = (R::one() / (d2 + y0 * y0).sqrt(), R::one() / (d2 + y1 * y1).sqrt());
    [d * per0, y0 * per0, d * per1, y1 * per1, d]
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use rand_philox::splitmix64;
    use twoforms_geometry::solid_angle::solid_angle;

    use super::{GRAZING, SphericalRectangle, numbers};

    /// Roundings of its place, in which the numbers undone may be those of another point: some thirty follow each other in the map and
    /// its undoing, not all the same way.
    const ROUNDINGS: f64 = 16.0;

    fn uniform(state: &mut u64) -> f64 {
        *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        ((splitmix64(*state) >> 12) as f64 + 0.5) / 4_503_599_627_370_496.0
    }

    /// Rectangles of sides log-uniform from 10⁻⁵ to 10 at a distance of one, up to ten times as far beside it.
    fn rectangle(state: &mut u64) -> [DVec3; 4] {
        let mut side = || 10.0_f64.powf(6.0 * uniform(state) - 5.0);
        let (width, height) = (side(), side());
        let mut beside = || 20.0 * uniform(state).powi(3) - 10.0;
        let corner = DVec3::new(beside(), beside(), 1.0);
        let (e, f) = (DVec3::X * width, DVec3::Y * height);
        [corner, corner + e, corner + e + f, corner + f]
    }

    /// The two numbers of the point at the shares s and t of the sides, from the solid angle before it and from sines of elevations,
    /// in binary64.
    fn numbers_of([a, b, _, d]: [DVec3; 4], whole: f64, [s, t]: [f64; 2]) -> [f64; 2] {
        let (e, f) = (b - a, d - a);
        let before = solid_angle(&[a, a + e * s, a + e * s + f, d]) / whole;
        let sine = |t: f64| {
            let y = a + e * s + f * t;
            y.y / y.length()
        };
        [before, (sine(t) - sine(0.0)) / (sine(1.0) - sine(0.0))]
    }

    /// Largest difference.
    fn apart([a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
        (a - c).abs().max((b - d).abs())
    }

    /// What is drawn at (u, v) against the solid angles of the parts before it, in binary64, and undone again.
    #[test]
    fn a_draw_parts_the_solid_angle_as_its_numbers_say() {
        let (mut state, mut drawn, mut worst, mut undone) = (0, 0, 0.0_f64, 0.0_f64);
        while drawn < 20_000 {
            let corners = rectangle(&mut state);
            let Some(rectangle) = SphericalRectangle::new(&corners) else { continue };
            let uv = [uniform(&mut state) as f32, uniform(&mut state) as f32];
            let shares = rectangle.shares(uv);
            let numbers_of = |shares: [f64; 2]| numbers_of(corners, rectangle.solid_angle(), shares);
            let at = shares.map(f64::from);
            let exact = numbers_of(at);
            worst = worst.max(apart(exact, uv.map(f64::from)));
            let again = numbers(&rectangle.row(), shares).map(f64::from);
            let [a, b, _, d] = corners;
            let reach = corners.iter().map(|corner| corner.length()).fold(0.0, f64::max);
            let step = [b - a, d - a].map(|side| ROUNDINGS * 2.0_f64.powi(-24) * reach / side.length());
            let near = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
            let moved = near.map(|by| apart(numbers_of([0, 1].map(|k| at[k] + by[k] * step[k])), exact));
            undone = undone.max(apart(again, exact) / moved.into_iter().fold(0.0, f64::max));
            drawn += 1;
        }
        // 1 − p² >= K p²/T² is half of GRAZING² at least, and p is known to 2⁻²⁴: p₀ and the sum are rounded to half of that.
        let known = 2.0_f64.powi(-23) / (GRAZING * GRAZING);
        assert!(worst < known, "{worst:e} of {known:e}");
        assert!(undone < 1.0, "{undone:e}");
    }

    #[test]
    fn what_is_no_rectangle_or_grazed_is_refused() {
        let square = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.0), DVec3::ONE, DVec3::new(0.0, 1.0, 1.0)];
        assert!(SphericalRectangle::new(&square).is_some());
        assert!(SphericalRectangle::new(&square.map(|v| DVec3::new(v.x, v.y, 0.01))).is_none());
        assert!(SphericalRectangle::new(&square.map(|v| DVec3::new(v.x + 0.1 * v.y, v.y, 1.0))).is_none());
        assert!(SphericalRectangle::new(&square[..3]).is_none());
    }
}
