//! The pieces that targets are drawn as by solid angle: rectangles and spherical triangles.

use glam::DVec3;
use twoforms_geometry::real::{Mask, Real, Word};
use twoforms_geometry::segment::SurfacePoint;
use twoforms_geometry::vector::{Vector, round};
use twoforms_geometry::view::View;

use super::along;
use super::spherical_rectangle::{self, SphericalRectangle};
use super::spherical_triangle::{self, SphericalTriangle};

/// How often a triangle is cut.
const MOST_CUTS: u32 = 3;

/// A target or a part of one, that two uniform numbers fall on uniformly in solid angle.
#[derive(Clone, Debug)]
pub enum Piece {
    /// A whole rectangle, with its corners.
    Rectangle(SphericalRectangle, [DVec3; 4]),
    /// A triangle.
    Triangle(SphericalTriangle),
}

impl Piece {
    /// Ω in steradian.
    pub fn solid_angle(&self) -> f64 {
        match self {
            Self::Rectangle(rectangle, _) => rectangle.solid_angle(),
            Self::Triangle(triangle) => triangle.solid_angle(),
        }
    }

    /// Where the corners (0, 0), (1, 0), (0, 1) and (1, 1) of the unit square fall, in metres in the frame of x.
    pub(crate) fn corners(&self) -> [DVec3; 4] {
        match self {
            Self::Rectangle(_, [a, b, c, d]) => [*a, *b, *d, *c],
            Self::Triangle(triangle) => {
                let [a, b, c] = triangle.corners();
                [b, b, a, c]
            }
        }
    }

    /// Its numbers, that of a triangle in the plane of a target with these corners.
    fn row(&self, plane: &[DVec3]) -> [f32; ROW] {
        let mut row = [0.0; ROW];
        match self {
            Self::Rectangle(rectangle, [a, b, _, d]) => {
                row[..FLAT].copy_from_slice(&rectangle.row());
                for (slot, vector) in row[FLAT..].chunks_exact_mut(3).zip([*a, *b - *a, *d - *a]) {
                    slot.copy_from_slice(&round(vector));
                }
                let normal = (*b - *a).cross(*d - *a).normalize();
                row[KIND - 1] = normal.dot(*a).abs() as f32;
                row[KIND] = 1.0;
            }
            Self::Triangle(triangle) => {
                row[..ROUND].copy_from_slice(&triangle.row());
                row[ROUND..KIND].copy_from_slice(&along::row(triangle.axes(), plane));
            }
        }
        row
    }
}

/// The pieces of a target with these corners in the frame of x, three or four: one for a rectangle that x is not too near the plane
/// of; else a spherical triangle, two for a parallelogram, more where they are huge.
pub fn each_piece(corners: &[DVec3], mut f: impl FnMut(Piece)) {
    if let (&[a, b, c, d], Some(rectangle)) = (corners, SphericalRectangle::new(corners)) {
        return f(Piece::Rectangle(rectangle, [a, b, c, d]));
    }
    for edge in corners[1..].windows(2) {
        if let Some(triangle) = SphericalTriangle::new([corners[0], edge[0], edge[1]]) {
            triangle.each_part(MOST_CUTS, &mut |part| f(Piece::Triangle(part)));
        }
    }
}

const FLAT: usize = spherical_rectangle::ROW;
const ROUND: usize = spherical_triangle::ROW;
/// Where a row says which it is: 1 for a rectangle, 0 for a triangle.
const KIND: usize = ROUND + along::ROW;
const ROW: usize = KIND + 1;

/// The pieces of all targets that face x and rise above its horizon, each target's together.
#[derive(Clone, Debug)]
pub struct Pieces {
    rows: Vec<[f32; ROW]>,
    targets: Vec<u32>,
    /// Whether there are rectangles, and triangles.
    kinds: [bool; 2],
}

impl Pieces {
    /// The pieces at x; `each` is told of every one, with its target.
    pub(crate) fn new(view: &View, mut each: impl FnMut(u32, &Piece)) -> Self {
        let mut pieces = Self { rows: Vec::new(), targets: Vec::new(), kinds: [false; 2] };
        for target in 0..view.geometry().targets().len() as u32 {
            view.facing(target, |corners| {
                if corners.iter().any(|corner| corner.z > 0.0) {
                    each_piece(corners, |piece| {
                        each(target, &piece);
                        pieces.kinds[usize::from(matches!(piece, Piece::Triangle(_)))] = true;
                        pieces.rows.push(piece.row(corners));
                        pieces.targets.push(target);
                    });
                }
            });
        }
        // Beyond the last: a point that is none, since all of its depth is zero.
        pieces.rows.push([0.0; ROW]);
        pieces.targets.push(0);
        pieces
    }

    #[inline(always)]
    fn row<R: Real>(&self, piece: R::Word) -> [R; ROW] {
        R::gather(
            piece,
            #[inline(always)]
            |k| &self.rows[k as usize],
        )
    }

    /// The point of a piece that two uniform numbers pick.
    #[inline(always)]
    pub(crate) fn point<R: Real>(&self, piece: R::Word, uv: [R; 2]) -> SurfacePoint<R> {
        let row = self.row::<R>(piece);
        let target = R::gather_word(
            piece,
            #[inline(always)]
            |k| self.targets[k as usize],
        );
        match self.kinds {
            [true, false] => on_rectangle(&row, uv, target),
            [true, true] => {
                let flat = R::zero().lt(row[KIND]);
                SurfacePoint::select(flat, &on_rectangle(&row, uv, target), &on_triangle(&row, uv, target))
            }
            _ => on_triangle(&row, uv, target),
        }
    }

    /// The two numbers that fall on a point of a piece: within 0 and 1 but for rounding, elsewhere anything.
    #[inline(always)]
    pub(crate) fn numbers<R: Real>(&self, piece: R::Word, y: Vector<R>) -> [R; 2] {
        let row = self.row::<R>(piece);
        match self.kinds {
            [true, false] => of_rectangle(&row, y),
            [true, true] => {
                let (flat, one, other) = (R::zero().lt(row[KIND]), of_rectangle(&row, y), of_triangle(&row, y));
                [R::select(flat, one[0], other[0]), R::select(flat, one[1], other[1])]
            }
            _ => of_triangle(&row, y),
        }
    }
}

#[inline(always)]
fn on_rectangle<R: Real>(row: &[R; ROW], uv: [R; 2], target: R::Word) -> SurfacePoint<R> {
    let mut map = [R::zero(); FLAT];
    map.copy_from_slice(&row[..FLAT]);
    let [corner, e, f] = sides(row);
    let [s, t] = spherical_rectangle::shares(&map, uv);
    SurfacePoint { position: corner + e * s + f * t, depth: row[KIND - 1], target }
}

#[inline(always)]
fn of_rectangle<R: Real>(row: &[R; ROW], y: Vector<R>) -> [R; 2] {
    let mut map = [R::zero(); FLAT];
    map.copy_from_slice(&row[..FLAT]);
    let [corner, e, f] = sides(row);
    let from = y - corner;
    spherical_rectangle::numbers(&map, [from.dot(e) / e.dot(e), from.dot(f) / f.dot(f)])
}

/// The first corner, and the sides to the second and to the fourth.
#[inline(always)]
fn sides<R: Real>(row: &[R; ROW]) -> [Vector<R>; 3] {
    let [ax, ay, az, ex, ey, ez, fx, fy, fz] = std::array::from_fn(
        #[inline(always)]
        |k| row[FLAT + k],
    );
    [Vector::new(ax, ay, az), Vector::new(ex, ey, ez), Vector::new(fx, fy, fz)]
}

#[inline(always)]
fn on_triangle<R: Real>(row: &[R; ROW], uv: [R; 2], target: R::Word) -> SurfacePoint<R> {
    let (mut map, mut plane) = ([R::zero(); ROUND], [R::zero(); along::ROW]);
    map.copy_from_slice(&row[..ROUND]);
    plane.copy_from_slice(&row[ROUND..KIND]);
    along::point(&plane, spherical_triangle::direction(&map, uv), target)
}

#[inline(always)]
fn of_triangle<R: Real>(row: &[R; ROW], y: Vector<R>) -> [R; 2] {
    let (mut map, mut plane) = ([R::zero(); ROUND], [R::zero(); along::ROW]);
    map.copy_from_slice(&row[..ROUND]);
    plane.copy_from_slice(&row[ROUND..KIND]);
    spherical_triangle::numbers(&map, along::along(&plane, y * (R::one() / y.length())))
}

/// The pieces of each target, as they are listed.
#[derive(Clone, Debug)]
pub struct PiecesOfTargets {
    /// The first piece of each target, and how many pieces there are before the next target's.
    first: Vec<u32>,
    /// The most pieces that one has.
    most: u32,
}

impl PiecesOfTargets {
    /// From the target of each piece.
    pub(crate) fn new(targets: usize, pieces: &Pieces) -> Self {
        let listed = &pieces.targets[..pieces.targets.len() - 1];
        let first: Vec<u32> = (0..=targets as u32).map(|k| listed.partition_point(|&t| t < k) as u32).collect();
        let most = first.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap_or(0);
        Self { first, most }
    }

    /// The piece of its target that a point lies on, and the two numbers that fall there: of several pieces the one that it is least
    /// beyond. Of a target without pieces anything.
    #[inline(always)]
    pub(crate) fn find<R: Real>(&self, pieces: &Pieces, y: &SurfacePoint<R>) -> (R::Word, [R; 2]) {
        let first = R::gather_word(
            y.target,
            #[inline(always)]
            |k| self.first[k as usize],
        );
        let (mut found, mut numbers) = (first, pieces.numbers(first, y.position));
        if self.most < 2 {
            return (found, numbers);
        }
        let end = R::gather_word(
            y.target,
            #[inline(always)]
            |k| self.first[k as usize + 1],
        );
        let mut least = beyond(numbers);
        for k in 1..self.most {
            let piece = first.wrapping_add(R::Word::splat(k));
            let there = R::below(piece, end);
            if !there.any() {
                break;
            }
            let piece = R::select_word(there, piece, first);
            let next = pieces.numbers(piece, y.position);
            let nearer = there & beyond(next).lt(least);
            least = R::select(nearer, beyond(next), least);
            found = R::select_word(nearer, piece, found);
            numbers = [R::select(nearer, next[0], numbers[0]), R::select(nearer, next[1], numbers[1])];
        }
        (found, numbers)
    }
}

/// By how much two numbers leave the unit square; what is not a number leaves it by far.
#[inline(always)]
fn beyond<R: Real>([u, v]: [R; 2]) -> R {
    let (zero, one) = (R::zero(), R::one());
    let mut most = zero;
    for by in [-u, u - one, -v, v - one] {
        let less = by.le(most);
        most = R::select(less, most, R::select(by.lt(R::splat(2.0)), by, R::splat(2.0)));
    }
    most
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::DVec3;

    use super::{Piece, SphericalTriangle, each_piece};

    fn spherical_triangles(corners: &[DVec3]) -> Vec<SphericalTriangle> {
        let mut triangles = Vec::new();
        each_piece(corners, |piece| match piece {
            Piece::Triangle(triangle) => triangles.push(triangle),
            Piece::Rectangle(..) => panic!("three corners are no rectangle"),
        });
        triangles
    }

    /// An octant; most of the hemisphere; a sliver half around it: cut or not, parts add up and draws lie within.
    #[test]
    fn parts_add_up_and_hold_their_draws() {
        let corner = |degrees: f64, z: f64| DVec3::new(degrees.to_radians().cos(), degrees.to_radians().sin(), z);
        let octant = [DVec3::X, DVec3::Y, DVec3::Z];
        let wide = [corner(0.0, 1e-3), corner(120.0, 1e-3), corner(240.0, 1e-3)];
        let sliver = [corner(0.0, 0.01), corner(175.0, 0.01), corner(80.0, 0.012)];
        for (corners, least, most) in [(octant, 1, 1), (wide, 3, 12), (sliver, 2, 8)] {
            let parts = spherical_triangles(&corners);
            let sum: f64 = parts.iter().map(SphericalTriangle::solid_angle).sum();
            let whole = twoforms_geometry::solid_angle::solid_angle(&corners);
            assert!((least..=most).contains(&parts.len()) && (sum - whole).abs() < 1e-9 * PI, "{sum} {whole}");
            let around = 1.0_f64.copysign(corners[0].dot(corners[1].cross(corners[2])));
            for part in &parts {
                for k in 0..64_u8 {
                    let uv = [f32::from(k % 8) / 7.0, f32::from(k / 8 + 1) / 8.0];
                    let psi = part.turned(part.direction(uv).map(f64::from));
                    let edges =
                        [[0, 1], [1, 2], [2, 0]].map(|[i, j]| corners[i].cross(corners[j]).normalize() * around);
                    assert!(edges.iter().all(|normal| normal.dot(psi) > -1e-6), "{psi} at {uv:?} of {corners:?}");
                }
            }
        }
    }
}
