//! Which target a point is drawn on.

use twoforms_geometry::real::Real;

use crate::lights::Lights;

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
}

impl Selection {
    /// All selections.
    pub const ALL: [Self; 4] = [Self::Together, Self::Uniform, Self::Power, Self::Contribution];

    /// What it adds to a strategy's name.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Together => "",
            Self::Uniform => "@uniform",
            Self::Power => "@power",
            Self::Contribution => "@contribution",
        }
    }
}

/// The probability of each target, up to a common factor: that of its light, then its share of the light's area. `None`
/// where the probability depends on x.
fn weights(selection: Selection, lights: &Lights) -> Option<Vec<f64>> {
    let of_light = |light: usize| match selection {
        Selection::Together => Some(lights.light_areas()[light]),
        Selection::Uniform => Some(1.0),
        Selection::Power => Some(lights.powers()[light]),
        Selection::Contribution => None,
    };
    let targets = lights.light_of_target().iter().zip(lights.areas());
    targets.map(|(&light, area)| Some(of_light(light)? * area / lights.light_areas()[light])).collect()
}

/// A discrete distribution over targets, drawn from by inversion of its CDF in scene order.
///
/// Probabilities are whole multiples of 2⁻³², at least one for every target that has any, and the very same numbers
/// serve as density, so nothing is lost to rounding: E\[f/p\] holds exactly.
#[derive(Clone, Debug)]
pub struct Picker {
    /// Words below this one pick a target before k, for k = 0..=n; the last is 2³².
    bounds: Vec<u64>,
    /// p_A of each target: its probability over its area, in 1/m².
    density: Vec<f32>,
    /// 1 / (number of words that pick the target).
    scale: Vec<f32>,
}

const WORDS: u64 = 1 << 32;

impl Picker {
    /// The distribution of `selection` over the targets of `lights`, of which there must be one; `None` where it depends
    /// on x.
    pub fn new(selection: Selection, lights: &Lights) -> Option<Self> {
        let bounds = bounds(&weights(selection, lights)?);
        let widths: Vec<u64> = bounds.windows(2).map(|b| b[1] - b[0]).collect();
        let probability = |width: &u64| *width as f64 / WORDS as f64;
        let density = widths.iter().zip(lights.areas()).map(|(w, area)| (probability(w) / area) as f32).collect();
        let scale = widths.iter().map(|&width| (1.0 / width as f64) as f32).collect();
        Some(Self { bounds, density, scale })
    }

    /// The target that a random word picks, and the word rescaled to a uniform number.
    #[inline(always)]
    pub fn pick<R: Real>(&self, word: R::Word) -> (R::Word, R) {
        let [target, offset] = R::map_word(word, |w| {
            let k = self.bounds.partition_point(|&bound| bound <= u64::from(w)) - 1;
            [k as u32, (u64::from(w) - self.bounds[k]) as u32]
        });
        let [scale] = R::gather(target, |k| [self.scale[k as usize]]);
        (target, (R::from_word(offset) + R::splat(0.5)) * scale)
    }

    /// p_A over a target, in 1/m².
    #[inline(always)]
    pub fn density<R: Real>(&self, target: R::Word) -> R {
        let [density] = R::gather(target, |k| [self.density[k as usize]]);
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
