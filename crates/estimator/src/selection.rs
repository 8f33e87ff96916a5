//! Which target a point is drawn on.

use twoforms_geometry::real::{Real, Word};
use twoforms_geometry::view::View;

use crate::compensation::Compensation;
use crate::lights::Lights;
use crate::tree::Walk;
use crate::xi::unit;

/// How the light is picked before a point on it: the word after `@`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Selection {
    /// No light is picked: points are drawn over all lights together.
    Together,
    /// Each light alike: q = 1/n.
    Uniform,
    /// Each light in proportion to its power: q ∝ A·L·sides (L the luminance).
    Power,
    /// Each light in proportion to the luminance of its unoccluded irradiance at x.
    Contribution,
    /// No light but a target, by a [`Tree`](crate::tree::Tree).
    Tree,
    /// Each light in proportion to what samples by the cosine leave of its unoccluded irradiance at x, which may be nothing: only
    /// in a team with `hemisphere/cosine`, which sets the counts of samples.
    Compensated(Compensation),
}

impl Selection {
    /// All selections.
    pub const ALL: [Self; 6] = [
        Self::Together,
        Self::Uniform,
        Self::Power,
        Self::Contribution,
        Self::Tree,
        Self::Compensated(Compensation { own: 1, cosine: 1 }),
    ];

    /// What it adds to a strategy's name.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Together => "",
            Self::Uniform => "@uniform",
            Self::Power => "@power",
            Self::Contribution => "@contribution",
            Self::Tree => "@tree",
            Self::Compensated(_) => "@compensated",
        }
    }

    /// Whether the probabilities depend on x.
    pub fn depends_on_x(self) -> bool {
        matches!(self, Self::Contribution | Self::Tree | Self::Compensated(_))
    }

    /// Whether every light that gives something may be picked, so that a technique needs no other beside it.
    pub fn stands_alone(self) -> bool {
        !matches!(self, Self::Compensated(_))
    }

    /// What each light counts at x where that is asked for: the luminance of its unoccluded irradiance, or what the cosine
    /// leaves of it. By the tree, the probability of each target.
    pub(crate) fn at_x(self, lights: &Lights, view: &View) -> Vec<f64> {
        if self == Self::Tree {
            return Walk::new(lights.tree(), view.frame()).probabilities();
        }
        let unoccluded = lights.unoccluded(view);
        let given = lights.sums(&lights.contributions(&unoccluded));
        match self {
            Self::Compensated(compensation) => compensation.weights(&given, &lights.sums(&unoccluded)),
            _ => given,
        }
    }

    /// The probability of each target, up to a common factor: that of its light, then its share of the light's `measure`;
    /// and that of lights that have no measure. By the tree, that of each target that has a measure.
    /// `at_x` is [`Selection::at_x`], asked for where it counts.
    fn weights(self, lights: &Lights, measure: &[f64], at_x: impl FnOnce() -> Vec<f64>) -> (Vec<f64>, f64) {
        let whole = lights.sums(measure);
        let of_light = match self {
            Self::Together => return (measure.to_vec(), 0.0),
            Self::Uniform => vec![1.0; whole.len()],
            Self::Power => lights.powers().to_vec(),
            Self::Contribution | Self::Compensated(_) => at_x(),
            Self::Tree => {
                let listed = |(p, &m): (f64, &f64)| if m > 0.0 { p } else { 0.0 };
                return (at_x().into_iter().zip(measure).map(listed).collect(), 0.0);
            }
        };
        let share = |(&light, &m): (&usize, &f64)| if m > 0.0 { of_light[light] * m / whole[light] } else { 0.0 };
        let empty = of_light.iter().zip(&whole).filter(|&(_, &whole)| whole <= 0.0);
        (lights.light_of_target().iter().zip(measure).map(share).collect(), empty.map(|(of_light, _)| of_light).sum())
    }
}

/// A discrete distribution over targets, drawn from by inversion of its CDF in scene order. Where targets fall into pieces,
/// a piece is drawn, in proportion to its part of the target's measure.
///
/// Probabilities are whole multiples of 2⁻³², at least one for every target that has any, and the very same numbers
/// serve as density, so nothing is lost to rounding: E\[f/p\] holds exactly.
#[derive(Clone, Debug)]
pub struct Picker {
    /// The pieces that have a probability, in scene order.
    shares: Vec<Share>,
    /// For each value of a word's leading bits, the share that the least such word picks: where a search begins (Chen and
    /// Asau 1974, "On generating random variates from an empirical distribution").
    guide: Vec<u32>,
    /// How many bits of a word do not lead.
    trailing: u32,
    /// The probability of each target over its measure.
    density: Vec<f32>,
    /// The probability that a target is picked.
    mass: f64,
}

/// A part of a target that points are drawn on by a map of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// The target that it is part of.
    pub target: u32,
    /// How much of the measure it holds, in which points are uniform over it.
    pub measure: f64,
}

/// The words that pick one piece: from the first up to that of the next share.
#[derive(Clone, Copy, Debug)]
struct Share {
    first: u32,
    piece: u32,
    /// 1 / (number of words), and the density of the piece's target.
    numbers: [f32; 2],
}

/// What a random word picks.
#[derive(Clone, Copy, Debug)]
pub struct Picked<R: Real> {
    /// The piece; the target where targets are whole.
    pub piece: R::Word,
    /// What is left of the word: a uniform number.
    pub u: R,
    /// The probability of picking the target over its measure.
    pub density: R,
}

const WORDS: u64 = 1 << 32;
/// Most targets whose bounds are tried one after the other; where there are more, words are looked up.
const FEW: usize = 16;

impl Picker {
    /// The distribution of `selection` over the targets, points of a target being uniform in `measure`; it depends on x where
    /// the measure or the selection does, which asks then for what targets count `at_x`.
    pub(crate) fn new(selection: Selection, lights: &Lights, measure: &[f64], at_x: impl FnOnce() -> Vec<f64>) -> Self {
        let whole = |(k, &measure): (usize, &f64)| Piece { target: k as u32, measure };
        Self::over(selection, lights, &measure.iter().enumerate().map(whole).collect::<Vec<_>>(), at_x)
    }

    /// The same over the pieces that the targets fall into, in scene order. Where a light is picked that has none, a piece
    /// beyond the last is drawn.
    pub(crate) fn over(
        selection: Selection,
        lights: &Lights,
        pieces: &[Piece],
        at_x: impl FnOnce() -> Vec<f64>,
    ) -> Self {
        let mut measure = vec![0.0; lights.targets()];
        for piece in pieces {
            measure[piece.target as usize] += piece.measure;
        }
        let (weights, empty) = selection.weights(lights, &measure, at_x);
        Self::of(&weights, empty, &measure, pieces)
    }

    /// The distribution over the area of the targets, the same for every x; `None` where the selection depends on x.
    pub fn of_area(selection: Selection, lights: &Lights) -> Option<Self> {
        (!selection.depends_on_x()).then(|| Self::new(selection, lights, lights.areas(), Vec::new))
    }

    /// The distribution with these weights of targets, each being of this measure in all, and of nothing. Where no weight is
    /// positive, the first piece is picked, whose target then has density zero.
    fn of(weights: &[f64], nothing: f64, measure: &[f64], pieces: &[Piece]) -> Self {
        let weight = |piece: &Piece| {
            let target = piece.target as usize;
            if piece.measure > 0.0 { weights[target] * (piece.measure / measure[target]) } else { 0.0 }
        };
        let bounds = bounds(&pieces.iter().map(weight).chain([nothing]).collect::<Vec<_>>());
        let width = |k: usize| bounds[k + 1] - bounds[k];
        let mut words = vec![0_u64; weights.len()];
        pieces.iter().enumerate().for_each(|(k, piece)| words[piece.target as usize] += width(k));
        let mass = words.iter().sum::<u64>() as f64 / WORDS as f64;
        let of_words =
            |(&words, &m): (&u64, &f64)| if words > 0 { (words as f64 / WORDS as f64 / m) as f32 } else { 0.0 };
        let density: Vec<f32> = words.iter().zip(measure).map(of_words).collect();
        let of_piece = |k: usize| pieces.get(k).map_or(0.0, |piece| density[piece.target as usize]);
        let share = |k: usize| Share {
            first: bounds[k] as u32,
            piece: k as u32,
            numbers: [(1.0 / width(k) as f64) as f32, of_piece(k)],
        };
        let mut shares: Vec<Share> = (0..=pieces.len()).filter(|&k| width(k) > 0).map(share).collect();
        if shares.is_empty() {
            shares.push(Share { first: 0, piece: 0, numbers: [1.0 / WORDS as f32, 0.0] });
        }
        let leading = usize::BITS - shares.len().leading_zeros();
        let trailing = u32::BITS - leading;
        let first_of = |bits: u32| shares.partition_point(|share| share.first <= bits << trailing) as u32 - 1;
        Self { guide: (0..1 << leading).map(first_of).collect(), trailing, shares, density, mass }
    }

    /// The share of a word, by trying them in order.
    #[inline(always)]
    fn tried<R: Real>(&self, word: R::Word) -> R::Word {
        let mut share = R::Word::splat(0);
        for k in 1..self.shares.len() {
            let before = R::below(word, R::Word::splat(self.shares[k].first));
            share = R::select_word(before, share, R::Word::splat(k as u32));
        }
        share
    }

    /// The share of a word, from the guide on.
    #[inline(always)]
    fn looked_up<R: Real>(&self, word: R::Word) -> R::Word {
        R::map_word(
            word,
            #[inline(always)]
            |word| {
                let mut k = self.guide[(word >> self.trailing) as usize];
                while self.shares.get(k as usize + 1).is_some_and(|next| next.first <= word) {
                    k += 1;
                }
                k
            },
        )
    }

    #[inline(always)]
    fn first<R: Real>(&self, share: R::Word) -> R::Word {
        R::gather_word(
            share,
            #[inline(always)]
            |k| self.shares[k as usize].first,
        )
    }

    #[inline(always)]
    fn piece<R: Real>(&self, share: R::Word) -> R::Word {
        R::gather_word(
            share,
            #[inline(always)]
            |k| self.shares[k as usize].piece,
        )
    }

    /// What a random word picks. Targets that are whole are each a piece.
    #[inline(always)]
    pub fn pick<R: Real>(&self, word: R::Word) -> Picked<R> {
        if let [only] = self.shares[..] {
            return Picked { piece: R::Word::splat(only.piece), u: unit(word), density: R::splat(only.numbers[1]) };
        }
        let share = if self.shares.len() <= FEW { self.tried::<R>(word) } else { self.looked_up::<R>(word) };
        let [scale, density] = R::gather(
            share,
            #[inline(always)]
            |k| self.shares[k as usize].numbers,
        );
        let (first, piece) = (self.first::<R>(share), self.piece::<R>(share));
        Picked { piece, u: (R::from_word(word.wrapping_sub(first)) + R::splat(0.5)) * scale, density }
    }

    /// The probability that a target is picked: less than one where a light is picked that has none to be drawn on.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// The probability of picking a target over its measure.
    #[inline(always)]
    pub fn density<R: Real>(&self, target: R::Word) -> R {
        if let [only] = self.density[..] {
            return R::splat(only);
        }
        let [density] = R::gather(
            target,
            #[inline(always)]
            |k| [self.density[k as usize]],
        );
        density
    }
}

/// Rounds the CDF to words: cumulative weights times 2³², kept strictly increasing where a weight is positive.
fn bounds(weights: &[f64]) -> Vec<u64> {
    let total: f64 = weights.iter().sum();
    let mut left = weights.iter().filter(|&&w| w > 0.0).count() as u64;
    let (mut sum, mut bound) = (0.0, 0_u64);
    let mut bounds = vec![0];
    for &weight in weights {
        sum += weight;
        if weight > 0.0 {
            left -= 1;
            let rounded = (sum / total * WORDS as f64).round() as u64;
            let last = if left == 0 { WORDS } else { WORDS - left };
            bound = rounded.max(bound + 1).min(last);
            bound = if left == 0 { WORDS } else { bound };
        }
        bounds.push(bound);
    }
    bounds
}

#[cfg(test)]
mod tests {
    use super::{WORDS, bounds};

    #[test]
    fn every_positive_weight_gets_a_word_and_all_words_are_given() {
        for weights in [vec![1.0], vec![1.0, 0.0, 3.0], vec![1e-30, 1.0, 1e-30, 0.0], vec![0.0, 5.0]] {
            let bounds = bounds(&weights);
            assert_eq!((bounds[0], bounds[weights.len()]), (0, WORDS));
            for (pair, weight) in bounds.windows(2).zip(&weights) {
                assert_eq!(pair[1] > pair[0], *weight > 0.0, "{weights:?} gave {bounds:?}");
            }
        }
        assert_eq!(bounds(&[1.0, 3.0]), [0, WORDS / 4, WORDS]);
    }
}
