//! The bilinear cosine over the pieces of a target, in binary64.

use std::borrow::Cow;

use glam::DVec3;
use twoforms_estimator::density::{Piece, corner_cosines, each_piece};
use twoforms_geometry::solid_angle::solid_angle;

use crate::clip::Halves;
use crate::seen::Seen;
use crate::visible::Pieces;

/// w on the pieces of a target: bilinear over the unit square that each is drawn from uniformly in solid angle.
pub struct Bilinear(Vec<(Piece, [f64; 4])>);

impl Bilinear {
    /// The pieces of a target with these corners.
    pub fn new(corners: &[DVec3]) -> Self {
        let mut pieces = Vec::new();
        each_piece(corners, |piece| {
            let w = corner_cosines(&piece);
            pieces.push((piece, w));
        });
        Self(pieces)
    }

    /// ∫ w dω over the target.
    pub fn whole(&self) -> f64 {
        self.0.iter().map(|(piece, w)| piece.solid_angle() * w.iter().sum::<f64>() / 4.0).sum()
    }

    /// What x sees of a facet of the target, cut where one piece of the target meets another, so that w is smooth on each part.
    pub fn cut<'s>(&self, seen: &'s Seen) -> Cow<'s, Pieces> {
        if self.0.len() < 2 {
            return Cow::Borrowed(&seen.pieces);
        }
        let mut cut = Pieces::default();
        let mut rest: Vec<Vec<DVec3>> = seen.pieces.iter().map(<[DVec3]>::to_vec).collect();
        for (piece, _) in &self.0 {
            let mut beyond = Vec::new();
            for polygon in rest {
                cut.push(&within(polygon, sides(piece), seen.facet.tolerance(), &mut beyond));
            }
            rest = beyond;
        }
        // What lies beyond all of them by rounding.
        for polygon in &rest {
            cut.push(polygon);
        }
        Cow::Owned(cut)
    }

    /// w at a point of the target, or nearest to it.
    pub fn at(&self, y: DVec3) -> f64 {
        let found = self.0.iter().map(|(piece, w)| (numbers(piece, y), w));
        let beyond = |[u, v]: [f64; 2]| [-u, u - 1.0, -v, v - 1.0].into_iter().fold(0.0, f64::max);
        let nearest = found.min_by(|(one, _), (other, _)| beyond(*one).total_cmp(&beyond(*other)));
        let Some((uv, [w00, w10, w01, w11])) = nearest else { return 0.0 };
        let [u, v] = uv.map(share);
        (w00 * (1.0 - u) + w10 * u) * (1.0 - v) + (w01 * (1.0 - u) + w11 * u) * v
    }
}

/// The planes through x of a piece's sides, their normals inward. A rectangle is a whole target.
fn sides(piece: &Piece) -> [DVec3; 3] {
    match piece {
        Piece::Rectangle(..) => [DVec3::ZERO; 3],
        Piece::Triangle(triangle) => {
            let [a, b, c] = triangle.corners();
            let inward = 1.0_f64.copysign(a.dot(b.cross(c)));
            [a.cross(b), b.cross(c), c.cross(a)].map(|normal| normal.normalize() * inward)
        }
    }
}

/// The part of a convex polygon that no plane has on its back, and those that one has.
fn within(mut part: Vec<DVec3>, sides: [DVec3; 3], tolerance: f64, beyond: &mut Vec<Vec<DVec3>>) -> Vec<DVec3> {
    let mut halves = Halves::default();
    for normal in sides {
        if part.is_empty() {
            break;
        }
        halves.cut(&part, normal, tolerance);
        if !halves.back.is_empty() {
            beyond.push(halves.back.clone());
        }
        part.clone_from(&halves.front);
    }
    part
}

/// A number brought to [0, 1], as samples bring it; 0 for what is not a number, which a corner has.
fn share(x: f64) -> f64 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

/// The two numbers that fall on y: the share of solid angle before it, and the share along what is left.
fn numbers(piece: &Piece, y: DVec3) -> [f64; 2] {
    match piece {
        Piece::Rectangle(_, [a, b, _, d]) => {
            let (e, f) = (*b - *a, *d - *a);
            let s = (y - *a).dot(e) / e.length_squared();
            let low = *a + e * s;
            let up = |at: DVec3| at.dot(f.normalize()) / at.length();
            let before = solid_angle(&[*a, low, low + f, *d]);
            [before.copysign(s) / piece.solid_angle(), (up(y) - up(low)) / (up(low + f) - up(low))]
        }
        Piece::Triangle(triangle) => {
            let [a, b, c] = triangle.corners();
            let normal = a.cross(c - a).normalize();
            let toward = b.cross(y - b).cross(normal);
            // In a sliver both planes are nearly one, and what their cross product loses shows across them.
            let toward = toward - normal * normal.dot(toward);
            let edge = toward * 1.0_f64.copysign(toward.dot(a.normalize() + c.normalize()));
            let [psi, from, to] = [y, b, edge].map(DVec3::normalize);
            let side = a.cross(edge).dot(normal);
            let before = solid_angle(&[a, b, edge]).copysign(side);
            let along = (psi - from).length_squared() / (to - from).length_squared();
            [before / piece.solid_angle(), along.copysign((psi - from).dot(to - from))]
        }
    }
}
