//! Directions uniform over a spherical triangle (Arvo 1995, "Stratified sampling of spherical triangles"), in a form that holds
//! for triangles of any size and shape in binary32.
//!
//! The triangle ABC is drawn as a fan from B: u picks C′ on the arc AC so that ABC′ holds the share u of the solid angle Ω,
//! and v picks Ψ on the arc BC′ so that 1 − cos BΨ = v (1 − cos BC′). AC is the longest arc and AB the shortest. With α the
//! angle at A, and with half the share β = uΩ/2, the arc from A to C′ follows from
//!
//! tan(AC′/2) = sin β / (tan(AB/2) sin(α − β)),
//!
//! a quotient of two numbers of which neither cancels, instead of from inverse cosines. All coordinates are along axes that
//! suit the triangle: η is the normal of the arc AC, ζ its middle, ξ points from A to C. There a small triangle has small ξ
//! and η, a thin one small η, and each is found to a few units in its own last place.

use glam::DVec3;
use twoforms_geometry::real::{Real, sin_cos_turns};
use twoforms_geometry::solid_angle::solid_angle;
use twoforms_geometry::vector::Vector;

use super::along::Axes;
use super::arc_tangent::arc_tangent;

/// Numbers that a draw needs.
pub(crate) const ROW: usize = 8;

/// A spherical triangle, prepared in binary64.
#[derive(Clone, Copy, Debug)]
pub struct SphericalTriangle {
    /// Ω in steradian.
    solid_angle: f64,
    /// A, B and C, in metres, in the frame of x.
    corners: [DVec3; 3],
    /// ξ, η and ζ in the frame of x.
    axes: Axes,
    /// tan(AB/2) sin α and tan(AB/2) cos α.
    tan: [f64; 2],
    /// sin(AC/2) and cos(AC/2).
    half: [f64; 2],
    /// B along ξ and η, and 1 − B along ζ.
    b: [f64; 3],
}

impl SphericalTriangle {
    /// The triangle with these corners around x, the origin, which does not lie in its plane: metres, in the frame of x. None
    /// where it holds no solid angle.
    pub fn new(corners: [DVec3; 3]) -> Option<Self> {
        let [a, b, c] = ordered(corners);
        let solid_angle = solid_angle(&corners);
        let [ab, ac] = [a.cross(b - a), a.cross(c - a)];
        let [ab_length, ac_length] = [ab.length(), ac.length()];
        let eta = ac / ac_length;
        let [a_unit, b_unit, c_unit] = [a, b, c].map(DVec3::normalize);
        let middle = a_unit + c_unit;
        let zeta = (middle - eta * eta.dot(middle)).normalize();
        let axes = Axes([eta.cross(zeta), eta, zeta]);
        let tan_ab = ab_length / (a.length() * b.length() + a.dot(b));
        let per_b = 1.0 / b.length();
        let height = (b - a).dot(eta) * per_b;
        let alpha = [(height / per_b).abs() * a.length() / ab_length, ab.dot(eta) / ab_length];
        let tan_half = ac_length / (a.length() * c.length() + a.dot(c));
        let cos_half = 1.0 / (1.0 + tan_half * tan_half).sqrt();
        let triangle = Self {
            solid_angle,
            corners: [a, b, c],
            axes,
            tan: alpha.map(|part| tan_ab * part),
            half: [tan_half * cos_half, cos_half],
            b: [axes.0[0].dot(b_unit), height, 0.5 * (b_unit - zeta).length_squared()],
        };
        (solid_angle > 0.0 && triangle.row().iter().all(|number| number.is_finite())).then_some(triangle)
    }

    /// Ω in steradian.
    pub fn solid_angle(&self) -> f64 {
        self.solid_angle
    }

    /// The triangles to draw it as, so that no arc of a fan comes near half a circle: itself, unless its longest arc is long;
    /// then two that part there, or where it is huge three around the middle of the circle inscribed in it; and these again.
    pub(crate) fn each_part(self, cuts: u32, f: &mut dyn FnMut(Self)) {
        if cuts == 0 || self.half[1] > SHORT {
            return f(self);
        }
        let [a, b, c] = self.corners;
        let parts = if self.solid_angle < HUGE {
            let middle = self.axes.0[2];
            [Self::new([a, b, middle]), Self::new([middle, b, c]), None]
        } else {
            let middle = incentre(self.corners);
            [Self::new([middle, a, b]), Self::new([middle, b, c]), Self::new([middle, c, a])]
        };
        parts.into_iter().flatten().for_each(|part| part.each_part(cuts - 1, f));
    }

    /// A, B and C as the draw takes them: points in metres, in the frame of x.
    pub fn corners(&self) -> [DVec3; 3] {
        self.corners
    }

    /// A vector along ξ, η and ζ, in the frame of x.
    pub fn turned(&self, [xi, eta, zeta]: [f64; 3]) -> DVec3 {
        self.axes.0[0] * xi + self.axes.0[1] * eta + self.axes.0[2] * zeta
    }

    pub(crate) fn axes(&self) -> &Axes {
        &self.axes
    }

    pub(crate) fn row(&self) -> [f32; ROW] {
        let turns = self.solid_angle / (4.0 * std::f64::consts::PI);
        let [sin, cos] = self.half;
        let [x, y, depth] = self.b;
        [turns, self.tan[0], self.tan[1], sin, cos, x, y, depth].map(|number| number as f32)
    }

    /// The direction that two uniform numbers pick, along ξ, η and ζ.
    pub fn direction(&self, uv: [f32; 2]) -> [f32; 3] {
        direction(&self.row(), uv).to_array()
    }
}

/// cos(AC/2) above which the longest arc is short: 2 radian.
const SHORT: f64 = 0.54;
/// Solid angle from which a triangle with a long arc is drawn as three.
const HUGE: f64 = 2.0;

/// The direction to the middle of the circle inscribed in a spherical triangle: A sin a + B sin b + C sin c.
fn incentre(corners: [DVec3; 3]) -> DVec3 {
    let [a, b, c] = corners.map(DVec3::normalize);
    let sine = |v: DVec3, w: DVec3| v.cross(w - v).length();
    (a * sine(b, c) + b * sine(c, a) + c * sine(a, b)).normalize()
}

/// The corners with AC the longest side seen from x, AB the shortest.
fn ordered([p, q, r]: [DVec3; 3]) -> [DVec3; 3] {
    let arc = |v: DVec3, w: DVec3| libm::atan2(v.cross(w - v).length(), v.dot(w));
    let mut opposite = [(arc(q, r), p), (arc(r, p), q), (arc(p, q), r)];
    opposite.sort_by(|one, other| one.0.total_cmp(&other.0));
    let [(_, c), (_, a), (_, b)] = opposite;
    [a, b, c]
}

/// Ψ along ξ, η and ζ.
#[inline(always)]
pub(crate) fn direction<R: Real>(row: &[R; ROW], [u, v]: [R; 2]) -> Vector<R> {
    let [turns, tan_sin, tan_cos, sin_half, cos_half, b_x, b_y, b_depth] = *row;
    let (one, two) = (R::one(), R::splat(2.0));
    // tan(AC′/2) = p/q
    let (sin_beta, cos_beta) = sin_cos_turns(u * turns);
    let (p, q) = (sin_beta, tan_sin * cos_beta - tan_cos * sin_beta);
    let per_square = one / (p * p + q * q);
    let (sin, cos) = (two * p * q * per_square, (q * q - p * p) * per_square);
    // C′ lies at AC′ − AC/2 from the middle.
    let c_x = sin * cos_half - cos * sin_half;
    let c_z = cos * cos_half + sin * sin_half;
    let c_depth = c_x * c_x / (one + c_z);
    // C′ − B, and 1 − cos BC′
    let d = Vector::new(c_x - b_x, -b_y, b_depth - c_depth);
    let h = R::splat(0.5) * d.dot(d);
    // sin BΨ / sin BC′
    let rho = (v * (two - v * h) / (two - h)).sqrt();
    let along_b = one + h * (rho - v);
    Vector::new(b_x * along_b + d.x * rho, b_y * along_b + d.y * rho, (one - b_depth) * along_b + d.z * rho)
}

/// The two uniform numbers that pick Ψ, which is given along ξ, η and ζ; outside the triangle one of them is not within 0 and 1. At
/// B every u picks the same, and anything may be said.
#[inline(always)]
pub(crate) fn numbers<R: Real>(row: &[R; ROW], psi: Vector<R>) -> [R; 2] {
    let [turns, tan_sin, tan_cos, sin_half, cos_half, b_x, b_y, b_depth] = *row;
    let one = R::one();
    let b_z = one - b_depth;
    // C′: where the arc from B through Ψ meets η = 0
    let (x, z) = (b_y * psi.x - psi.y * b_x, b_y * psi.z - psi.y * b_z);
    let per = one / (x * x + z * z).sqrt();
    let per = R::select(z.lt(R::zero()), -per, per);
    let (c_x, c_z) = (x * per, z * per);
    // tan(AC′/2) = sin AC′ / (1 + cos AC′) = sin β / (tan(AB/2) sin(α − β))
    let (sin, cos) = (c_x * cos_half + c_z * sin_half, c_z * cos_half - c_x * sin_half);
    let tan = sin / (one + cos);
    let beta = arc_tangent(tan * tan_sin, one + tan * tan_cos);
    let to = Vector::new(psi.x - b_x, psi.y - b_y, psi.z - b_z);
    let end = Vector::new(c_x - b_x, -b_y, c_z - b_z);
    let v = to.dot(to) / end.dot(end);
    let behind = to.dot(end).lt(R::zero());
    [beta / (turns * R::splat(std::f32::consts::TAU)), R::select(behind, -v, v)]
}
