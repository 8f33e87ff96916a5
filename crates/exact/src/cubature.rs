//! Adaptive cubature of smooth functions over what x sees of a facet.

use std::array::from_fn;

use glam::DVec3;

use crate::error::Error;
use crate::facet::distance_to;
use crate::gauss::{FIVE, FOUR, HIGH, LOW, Rule};
use crate::visible::Pieces;

/// Cells evaluated before giving up, beside three more for each that the pieces begin with.
pub const CELLS: usize = 20_000;

/// ∫ f dA of K functions at once, and estimates of their absolute errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integral<const K: usize> {
    /// The integrals.
    pub value: [f64; K],
    /// Σ over cells of |higher rule − lower rule| of nodes: the error of the lower rule, far above that of
    /// the higher one, whose value is taken.
    pub error: [f64; K],
}

impl<const K: usize> Integral<K> {
    const ZERO: Self = Self { value: [0.0; K], error: [0.0; K] };

    fn plus(self, other: Self) -> Self {
        Self { value: from_fn(|k| self.value[k] + other.value[k]), error: from_fn(|k| self.error[k] + other.error[k]) }
    }
}

/// A direction around which a function of the direction from x may have a peak that the rules would miss.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// The direction, of unit length.
    pub toward: DVec3,
    /// Where the peak's nearest pole lies, in radian off the direction.
    pub width: f64,
}

impl Peak {
    /// By how much the relative error of f can be larger than that of the directions it is taken at: near a double pole at a
    /// distance w, f changes by at most 2/w of itself per radian; and a half vector is rounded several times.
    pub fn steepness(&self) -> f64 {
        1.0 + 8.0 / self.width
    }
}

/// ∫ f dA over `pieces`, f a function of the point y on the light (metres, the receiver's frame, x
/// at the origin), smooth on each piece. Cells are halved in one coordinate at a time until every
/// component's estimated error is at most what `tolerance` allows for the totals.
///
/// # Errors
/// [`Error::NotConverged`] after [`CELLS`] cells, or when f is not finite somewhere.
pub fn integrate<const K: usize>(
    pieces: &Pieces,
    f: impl Fn(DVec3) -> [f64; K],
    tolerance: impl Fn(&[f64; K]) -> [f64; K],
) -> Result<Integral<K>, Error> {
    integrate_as(pieces, Manner::Smooth, f, tolerance)
}

/// How a function behaves over a piece.
#[derive(Clone, Copy, Debug)]
pub enum Manner<'p> {
    /// It is smooth.
    Smooth,
    /// It may have a peak: cells are halved until none is wide beside it.
    Peaked(&'p Peak),
    /// It may jump across curves: each piece begins as 64 cells, lest the rules miss what lies beyond one.
    Jumping,
}

/// The same for a function that may not be smooth.
///
/// # Errors
/// As [`integrate`].
pub fn integrate_as<const K: usize>(
    pieces: &Pieces,
    manner: Manner,
    f: impl Fn(DVec3) -> [f64; K],
    tolerance: impl Fn(&[f64; K]) -> [f64; K],
) -> Result<Integral<K>, Error> {
    let mut cut: Vec<Patch> = patches(pieces).collect();
    if let Manner::Jumping = manner {
        for across_xi in [true, false, true, false, true, false] {
            cut = cut.into_iter().flat_map(|patch| patch.halves(across_xi)).collect();
        }
    }
    let peak = if let Manner::Peaked(peak) = manner { Some(peak) } else { None };
    let mut cells: Vec<Cell<K>> = cut.into_iter().map(|patch| Cell::new(patch, peak, &f)).collect();
    let mut evaluated = cells.len();
    let limit = CELLS + 3 * evaluated;
    loop {
        let total = cells.iter().fold(Integral::ZERO, |sum, cell| sum.plus(cell.integral));
        let allowed = tolerance(&total.value);
        let wide = cells.iter().any(|cell| cell.wide);
        if !wide && (0..K).all(|k| total.error[k] <= allowed[k]) {
            return Ok(total);
        }
        let worst = (0..K).map(|k| total.error[k] / total.value[k].abs()).fold(0.0, f64::max);
        if evaluated > limit || total.value.iter().any(|v| !v.is_finite()) {
            return Err(Error::NotConverged { relative: worst, cells: evaluated });
        }
        let share = allowed.map(|a| a / cells.len() as f64);
        let before = cells.len();
        let mut refined = Vec::with_capacity(2 * before);
        for cell in cells {
            if cell.is_good(&share) {
                refined.push(cell);
            } else {
                refined.extend(cell.halves(&share, peak, &f));
            }
        }
        if refined.len() == before {
            return Ok(total);
        }
        evaluated += 2 * (refined.len() - before);
        cells = refined;
    }
}

/// Σ of the lower rule over the pieces' triangles, without refinement: a first guess.
pub fn guess<const K: usize>(pieces: &Pieces, f: impl Fn(DVec3) -> [f64; K]) -> [f64; K] {
    let lower = |patch: Patch| patch.apply(patch.rules()[1], patch.rules()[1], &f);
    patches(pieces).map(lower).fold([0.0; K], |sum, v| from_fn(|k| sum[k] + v[k]))
}

/// A part of the triangle abc in Duffy's coordinates (1982): y = a + ξ ((b − a) + η (c − b)), dA =
/// 2 ξ × area dξ dη. All three edges are lines of constant ξ or η, so that a thin layer along an
/// edge is resolved by halving one of them.
#[derive(Clone, Copy)]
struct Patch {
    corners: [DVec3; 3],
    xi: [f64; 2],
    eta: [f64; 2],
}

struct Cell<const K: usize> {
    patch: Patch,
    integral: Integral<K>,
    /// Whether x, or a peak, is so near that the rules may miss it: the cell is halved whatever they say.
    wide: bool,
}

impl<const K: usize> Cell<K> {
    fn new(patch: Patch, peak: Option<&Peak>, f: &impl Fn(DVec3) -> [f64; K]) -> Self {
        let [high, low] = patch.rules();
        let value = patch.apply(high, high, f);
        let judge = patch.apply(low, low, f);
        let integral = Integral { value, error: difference(&value, &judge) };
        Self { patch, integral, wide: patch.is_wide() || peak.is_some_and(|peak| patch.is_wide_beside(peak)) }
    }

    fn is_good(&self, share: &[f64; K]) -> bool {
        !self.wide && (0..K).all(|k| self.integral.error[k] <= share[k])
    }

    /// Halves across the direction in which the lower rule fails more, measured by the `share` of
    /// error that each component is allowed; a wide cell across its longer side.
    fn halves(&self, share: &[f64; K], peak: Option<&Peak>, f: &impl Fn(DVec3) -> [f64; K]) -> [Self; 2] {
        let across_xi = if self.wide { self.patch.is_longer_in_xi() } else { self.fails_in_xi(share, f) };
        self.patch.halves(across_xi).map(|half| Self::new(half, peak, f))
    }

    fn fails_in_xi(&self, share: &[f64; K], f: &impl Fn(DVec3) -> [f64; K]) -> bool {
        let failure = |judge: [f64; K]| {
            let excess =
                difference(&self.integral.value, &judge).into_iter().zip(share).map(|(error, share)| error / share);
            excess.fold(0.0, f64::max)
        };
        let [high, low] = self.patch.rules();
        failure(self.patch.apply(low, high, f)) >= failure(self.patch.apply(high, low, f))
    }
}

/// A cell is wide when it is longer than this many times its distance from x, or from a peak's nearest pole.
const WIDE: f64 = 8.0;
/// A patch is narrow when it is shorter than this many times its distance from x.
const NARROW: f64 = 0.1;

impl Patch {
    fn apply<const K: usize>(
        &self,
        xis: &[(f64, f64)],
        etas: &[(f64, f64)],
        f: &impl Fn(DVec3) -> [f64; K],
    ) -> [f64; K] {
        let [a, b, c] = self.corners;
        let (ab, bc) = (b - a, c - b);
        let ([xi0, xi1], [eta0, eta1]) = (self.xi, self.eta);
        let doubled_area = ab.cross(bc).length() * (xi1 - xi0) * (eta1 - eta0);
        let mut sum = [0.0; K];
        for &(x, x_weight) in xis {
            let xi = xi0 + (xi1 - xi0) * x;
            for &(h, h_weight) in etas {
                let eta = eta0 + (eta1 - eta0) * h;
                let weight = doubled_area * xi * x_weight * h_weight;
                let value = f(a + xi * (ab + eta * bc));
                for k in 0..K {
                    sum[k] += weight * value[k];
                }
            }
        }
        sum
    }

    fn at(&self, xi: f64, eta: f64) -> DVec3 {
        let [a, b, c] = self.corners;
        a + xi * ((b - a) + eta * (c - b))
    }

    fn outline(&self) -> [DVec3; 4] {
        let ([xi0, xi1], [eta0, eta1]) = (self.xi, self.eta);
        [self.at(xi0, eta0), self.at(xi1, eta0), self.at(xi1, eta1), self.at(xi0, eta1)]
    }

    /// The higher rule and the lower: 11 nodes and 7, or 5 and 4 on a narrow patch. Functions of the direction from x have
    /// their nearest poles at r = 0, so that n nodes leave an error of the order of (4 distance/length)⁻²ⁿ: there 10⁻¹³ of
    /// the value for 4.
    fn rules(&self) -> [&'static Rule; 2] {
        let (length, corner) = self.size();
        if length < NARROW * (corner - length) { [&FIVE, &FOUR] } else { [&HIGH, &LOW] }
    }

    /// Length, and distance of the nearest corner from x.
    fn size(&self) -> (f64, f64) {
        let [p, q, r, s] = self.outline();
        let length = p.distance_squared(r).max(q.distance_squared(s)).sqrt();
        (length, [p, q, r, s].iter().map(|v| v.length_squared()).fold(f64::INFINITY, f64::min).sqrt())
    }

    fn is_wide(&self) -> bool {
        let (length, corner) = self.size();
        // The nearest corner is at most one length farther than the nearest point.
        corner < (WIDE + 1.0) * length && length > WIDE * distance_to(&self.outline())
    }

    /// By directions from x: the cell lies in a cone around its middle.
    fn is_wide_beside(&self, peak: &Peak) -> bool {
        let outline = self.outline().map(DVec3::normalize);
        let middle = outline.iter().sum::<DVec3>().normalize_or_zero();
        let radius = outline.iter().map(|v| v.distance(middle)).fold(0.0, f64::max);
        let beside = (middle.distance(peak.toward) - radius).max(0.0);
        2.0 * radius > WIDE * (beside + peak.width)
    }

    fn is_longer_in_xi(&self) -> bool {
        let [p, q, r, s] = self.outline();
        p.distance_squared(q).max(s.distance_squared(r)) >= q.distance_squared(r).max(p.distance_squared(s))
    }

    fn halves(self, across_xi: bool) -> [Self; 2] {
        let [xi0, xi1] = self.xi;
        let [eta0, eta1] = self.eta;
        if across_xi {
            let middle = 0.5 * (xi0 + xi1);
            [Self { xi: [xi0, middle], ..self }, Self { xi: [middle, xi1], ..self }]
        } else {
            let middle = 0.5 * (eta0 + eta1);
            [Self { eta: [eta0, middle], ..self }, Self { eta: [middle, eta1], ..self }]
        }
    }
}

fn difference<const K: usize>(a: &[f64; K], b: &[f64; K]) -> [f64; K] {
    from_fn(|k| (a[k] - b[k]).abs())
}

fn patches(pieces: &Pieces) -> impl Iterator<Item = Patch> {
    let triangles =
        pieces.iter().flat_map(|polygon| polygon[1..].windows(2).map(|edge| [polygon[0], edge[0], edge[1]]));
    triangles.map(|corners| Patch { corners, xi: [0.0, 1.0], eta: [0.0, 1.0] })
}
