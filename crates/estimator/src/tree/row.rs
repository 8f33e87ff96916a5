//! A node as a walk meets it, and how much its children may give to x.

use glam::DVec3;
use twoforms_geometry::real::{Real, at_least};
use twoforms_geometry::vector::Vector;

use super::cone::Cone;

/// Numbers that say all about a child.
pub(super) const CHILD: usize = 10;
/// Numbers in a row: both children.
pub(super) const ROW: usize = 2 * CHILD;
/// A node's children, left and right.
pub(super) type Row = [f32; ROW];

/// A child: the ball around its targets, the cone of their normals, whether some emit to both sides, their power.
pub(super) fn child(middle: DVec3, radius: f64, normals: Cone, both: bool, power: f64) -> [f32; CHILD] {
    let [x, y, z] = middle.to_array();
    let [along_x, along_y, along_z] = normals.axis.to_array();
    let both = if both { 1.0 } else { 0.0 };
    let cos = libm::cos(normals.spread);
    [x, y, z, radius, along_x, along_y, along_z, cos, both, power].map(|number| number as f32)
}

/// The row of a node with these children.
pub(super) fn of(children: [[f32; CHILD]; 2]) -> Row {
    let mut row = [0.0; ROW];
    row[..CHILD].copy_from_slice(&children[0]);
    row[CHILD..].copy_from_slice(&children[1]);
    row
}

/// What the targets of a child may give to x, up to a factor: Φ cosθ′_x cosθ′_y/r², the cosines those of the least angles that a
/// point in the ball and a normal in the cone allow, and r the distance of the ball's middle, or its radius where x lies
/// within (Conty Estévez and Kulla 2018, equation 3).
#[inline(always)]
pub(super) fn importance<R: Real>(child: &[R; CHILD], x: Vector<R>, n_x: Vector<R>) -> R {
    let [mx, my, mz, radius, ax, ay, az, cos_spread, both, power] = *child;
    let (zero, one) = (R::zero(), R::one());
    let toward = Vector::new(mx, my, mz) - x;
    let (r2, ball2) = (toward.dot(toward), radius * radius);
    let outside = ball2.lt(r2);
    let per_r = one / r2.sqrt();
    let sin_ball = R::select(outside, radius * per_r, one);
    let cos_ball = ((one - sin_ball) * (one + sin_ball)).sqrt();
    let cos_normal = -(toward.dot(Vector::new(ax, ay, az)) * per_r);
    let turned = zero.lt(both) & cos_normal.lt(zero);
    let cos_normal = R::select(turned, -cos_normal, cos_normal);
    let off_cone = less([cos_normal, sine(cos_normal)], [cos_spread, sine(cos_spread)]);
    let [cos_y, _] = less(off_cone, [cos_ball, sin_ball]);
    let cos_x = toward.dot(n_x) * per_r;
    let [cos_x, _] = less([cos_x, sine(cos_x)], [cos_ball, sin_ball]);
    let positive = |cos: R| R::select(zero.lt(cos), cos, zero);
    R::select(outside, power * positive(cos_x) * positive(cos_y) / r2, power / at_least(ball2, r2))
}

/// cos and sin of the first angle less the second, or of zero where that is larger.
#[inline(always)]
fn less<R: Real>([cos_a, sin_a]: [R; 2], [cos_b, sin_b]: [R; 2]) -> [R; 2] {
    let beyond = cos_a.lt(cos_b);
    let (cos, sin) = (cos_a * cos_b + sin_a * sin_b, sin_a * cos_b - cos_a * sin_b);
    [R::select(beyond, cos, R::one()), R::select(beyond, sin, R::zero())]
}

/// The sine of an angle up to half a turn, from its cosine, which may be rounded beyond one.
#[inline(always)]
fn sine<R: Real>(cos: R) -> R {
    at_least((R::one() - cos) * (R::one() + cos), R::zero()).sqrt()
}
