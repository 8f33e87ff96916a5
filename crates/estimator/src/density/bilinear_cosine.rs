//! Points on the lights by solid angle and a cosine that is bilinear over the map's square (Hart, Pharr, Müller, Lopes, McGuire,
//! Shirley 2020, "Practical product sampling by fitting and composing warps").

use std::borrow::Cow;

use twoforms_geometry::real::{Real, at_least};
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::view::{Vantage, View};

use super::Ready;
use super::lights::{OnLights, Picking, Spread};
use super::pieces::{self, Pieces, PiecesOfTargets};
use crate::lights::Lights;
use crate::measure::SurfaceArea;
use crate::query::Query;
use crate::selection::{Picker, Piece, Selection};

/// The least cosine of a corner, which keeps a density where all of them are below the horizon or near it.
const LEAST: f64 = 0.01;

/// Solid angle times w(u, v) over the targets that face x and rise above its horizon: w is bilinear over the unit square that the
/// map by solid angle starts from, and at its corners the cosine at x of where they fall, 0.01 at least.
#[derive(Clone, Debug)]
pub struct ByBilinearCosine {
    pieces: Pieces,
    of_targets: PiecesOfTargets,
    /// w at (0, 0), (1, 0), (0, 1) and (1, 1) of each piece.
    cosines: Vec<[f32; 4]>,
}

impl ByBilinearCosine {
    /// The pieces at x, and what they hold.
    fn new(view: &View) -> (Self, Vec<Piece>) {
        let (mut cosines, mut shares) = (Vec::new(), Vec::new());
        let pieces = Pieces::new(view, |target, piece| {
            let w = corner_cosines(piece);
            shares.push(Piece { target, measure: piece.solid_angle() * w.iter().sum::<f64>() / 4.0 });
            cosines.push(w.map(|w| w as f32));
        });
        cosines.push([1.0; 4]);
        let of_targets = PiecesOfTargets::new(view.geometry().targets().len(), &pieces);
        (Self { pieces, of_targets, cosines }, shares)
    }

    #[inline(always)]
    fn cosines<R: Real>(&self, piece: R::Word) -> [R; 4] {
        R::gather(
            piece,
            #[inline(always)]
            |k| &self.cosines[k as usize],
        )
    }
}

/// w at the corners of the unit square.
pub fn corner_cosines(piece: &pieces::Piece) -> [f64; 4] {
    piece.corners().map(|corner| (corner.z / corner.length()).max(LEAST))
}

impl Spread for ByBilinearCosine {
    #[inline(always)]
    fn point<R: Real>(&self, from: &Vantage<R>, piece: R::Word, uv: [R; 2]) -> SurfacePoint<R> {
        self.draw(from, piece, uv).0
    }

    /// First v by the sums of w along u, then u by w there.
    #[inline(always)]
    fn draw<R: Real>(&self, _: &Vantage<R>, piece: R::Word, [u, v]: [R; 2]) -> (SurfacePoint<R>, R) {
        let w = self.cosines::<R>(piece);
        let [w00, w10, w01, w11] = w;
        let v = linear(v, [w00 + w10, w01 + w11]);
        let u = linear(u, [w00 + (w01 - w00) * v, w10 + (w11 - w10) * v]);
        let y = self.pieces.point(piece, [u, v]);
        (y, bilinear(w, [u, v]) * Segment::to(&y).d_omega_d_area())
    }

    /// w(u, v) dω/dA, u and v found from y: across a sliver no better than y is rounded, over its width.
    #[inline(always)]
    fn per_area<R: Real>(&self, _: &Vantage<R>, y: &SurfacePoint<R>) -> R {
        let (piece, [u, v]) = self.of_targets.find(&self.pieces, y);
        bilinear(self.cosines::<R>(piece), [share(u), share(v)]) * Segment::to(y).d_omega_d_area()
    }
}

/// w at (u, v).
#[inline(always)]
fn bilinear<R: Real>([w00, w10, w01, w11]: [R; 4], [u, v]: [R; 2]) -> R {
    (w00 + (w01 - w00) * v) * (R::one() - u) + (w10 + (w11 - w10) * v) * u
}

/// The number in \[0, 1\] that ξ draws by a density that goes from a to b: ξ (a + b)/(a + √(a² + ξ (b² − a²))).
#[inline(always)]
fn linear<R: Real>(xi: R, [a, b]: [R; 2]) -> R {
    xi * (a + b) / (a + (a * a + xi * ((b - a) * (b + a))).sqrt())
}

/// A number brought to \[0, 1\]; 0 for what is not a number.
#[inline(always)]
fn share<R: Real>(x: R) -> R {
    R::one() - at_least(R::one() - at_least(x, R::zero()), R::zero())
}

/// `area/bilinear-cosine`.
#[derive(Clone, Debug)]
pub struct BilinearCosineOnLights(Selection);

impl Ready for BilinearCosineOnLights {
    type Measure = SurfaceArea;
    type At<'a> = OnLights<'a, ByBilinearCosine>;

    fn prepare(_: &Lights, selection: Selection) -> Self {
        Self(selection)
    }

    fn depends_on_x(&self) -> bool {
        true
    }

    fn at<'a>(&'a self, view: &View, query: &Query) -> OnLights<'a, ByBilinearCosine> {
        let (spread, shares) = ByBilinearCosine::new(view);
        let lights = query.lights();
        let picker = Picker::over(self.0, lights, &shares, || self.0.at_x(lights, view));
        OnLights { picking: Picking::Listed(Cow::Owned(picker)), spread }
    }
}

#[cfg(test)]
mod tests {
    use super::linear;

    /// The share of a trapezium before the number drawn is ξ.
    #[test]
    fn a_linear_density_is_inverted() {
        for [a, b] in [[1.0, 1.0], [0.01, 1.0], [1.0, 0.01], [0.3, 0.5_f32]] {
            for k in 0..=64_u8 {
                let xi = f32::from(k) / 64.0;
                let x = linear(xi, [a, b]);
                let before = x * (a + 0.5 * (b - a) * x) / (0.5 * (a + b));
                assert!((before - xi).abs() < 1e-6 && (0.0..=1.000_001).contains(&x), "{x} of {a} {b} at {xi}");
            }
        }
    }
}
