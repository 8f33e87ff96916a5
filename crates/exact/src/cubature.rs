//! Adaptive cubature of smooth functions over what x sees of a facet.

use std::array::from_fn;

use glam::DVec3;

use crate::error::Error;
use crate::gauss::{HIGH, LOW, Node};
use crate::visible::Pieces;

/// Triangles evaluated before giving up.
pub const CELLS: usize = 20_000;

/// ∫ f dA of K functions at once, and estimates of their absolute errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integral<const K: usize> {
    /// The integrals.
    pub value: [f64; K],
    /// Σ over cells of |11×11 nodes − 7×7 nodes|: the error of the lower rule, far above that of the higher one, whose value is taken.
    pub error: [f64; K],
}

impl<const K: usize> Integral<K> {
    const ZERO: Self = Self {
        value: [0.0; K],
        error: [0.0; K],
    };

    fn plus(self, other: Self) -> Self {
        Self {
            value: from_fn(|k| self.value[k] + other.value[k]),
            error: from_fn(|k| self.error[k] + other.error[k]),
        }
    }
}

/// ∫ f dA over `pieces`, f a function of the point y on the light (metres, the receiver's frame, x at the origin), smooth on
/// each piece. Cells are halved across their longest edge until every component's estimated error is at most what `tolerance` allows for the totals.
///
/// # Errors
/// [`Error::NotConverged`] after [`CELLS`] cells, or when f is not finite somewhere.
pub fn integrate<const K: usize>(
    pieces: &Pieces,
    f: impl Fn(DVec3) -> [f64; K],
    tolerance: impl Fn(&[f64; K]) -> [f64; K],
) -> Result<Integral<K>, Error> {
    let mut cells: Vec<Cell<K>> = triangles(pieces).map(|t| Cell::new(t, &f)).collect();
    let mut evaluated = cells.len();
    loop {
        let total = cells
            .iter()
            .fold(Integral::ZERO, |sum, cell| sum.plus(cell.integral));
        let allowed = tolerance(&total.value);
        if (0..K).all(|k| total.error[k] <= allowed[k]) {
            return Ok(total);
        }
        let worst = (0..K)
            .map(|k| total.error[k] / total.value[k].abs())
            .fold(0.0, f64::max);
        if evaluated > CELLS || total.value.iter().any(|v| !v.is_finite()) {
            return Err(Error::NotConverged {
                relative: worst,
                cells: evaluated,
            });
        }
        let share = allowed.map(|a| a / cells.len() as f64);
        let before = cells.len();
        let mut refined = Vec::with_capacity(2 * before);
        for cell in cells {
            if (0..K).all(|k| cell.integral.error[k] <= share[k]) {
                refined.push(cell);
            } else {
                refined.extend(halves(cell.corners).map(|t| Cell::new(t, &f)));
            }
        }
        if refined.len() == before {
            return Ok(total);
        }
        evaluated += 2 * (refined.len() - before);
        cells = refined;
    }
}

/// Σ of the 7×7 rule over the pieces' triangles, without refinement: a first guess.
pub fn guess<const K: usize>(pieces: &Pieces, f: impl Fn(DVec3) -> [f64; K]) -> [f64; K] {
    triangles(pieces)
        .map(|t| apply(&LOW, t, &f))
        .fold([0.0; K], |sum, v| from_fn(|k| sum[k] + v[k]))
}

struct Cell<const K: usize> {
    corners: [DVec3; 3],
    integral: Integral<K>,
}

impl<const K: usize> Cell<K> {
    fn new(corners: [DVec3; 3], f: &impl Fn(DVec3) -> [f64; K]) -> Self {
        let value = apply(&HIGH, corners, f);
        let judge = apply(&LOW, corners, f);
        Self {
            corners,
            integral: Integral {
                value,
                error: from_fn(|k| (value[k] - judge[k]).abs()),
            },
        }
    }
}

fn apply<const K: usize>(
    rule: &[Node],
    [a, b, c]: [DVec3; 3],
    f: &impl Fn(DVec3) -> [f64; K],
) -> [f64; K] {
    let area = 0.5 * (b - a).cross(c - a).length();
    let mut sum = [0.0; K];
    for node in rule {
        let y = a + node.xi * ((b - a) + node.eta * (c - b));
        let value = f(y);
        for k in 0..K {
            sum[k] += node.weight * value[k];
        }
    }
    sum.map(|s| s * area)
}

fn triangles(pieces: &Pieces) -> impl Iterator<Item = [DVec3; 3]> {
    pieces.iter().flat_map(|polygon| {
        polygon[1..]
            .windows(2)
            .map(|edge| [polygon[0], edge[0], edge[1]])
    })
}

fn halves([a, b, c]: [DVec3; 3]) -> [[DVec3; 3]; 2] {
    let (ab, bc, ca) = (
        a.distance_squared(b),
        b.distance_squared(c),
        c.distance_squared(a),
    );
    let [a, b, c] = if bc >= ab && bc >= ca {
        [a, b, c]
    } else if ca >= ab {
        [b, c, a]
    } else {
        [c, a, b]
    };
    let middle = 0.5 * (b + c);
    [[a, b, middle], [a, middle, c]]
}
