//! Which target a point is drawn on.

use twoforms_geometry::real::Real;

use crate::lights::Lights;

/// How the light is picked before a point on it: the word after `@`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Selection {
    /// No light is picked: points are uniform over the area of all lights together.
    ByArea,
    /// Each light alike.
    Uniform,
    /// Each light in proportion to its power, A·L·sides (L the luminance).
    Power,
}

/// All selections.
pub const SELECTIONS: [Selection; 3] = [Selection::ByArea, Selection::Uniform, Selection::Power];

impl Selection {
    /// Its word, empty for [`Selection::ByArea`].
    pub fn word(self) -> &'static str {
        match self {
            Self::ByArea => "",
            Self::Uniform => "uniform",
            Self::Power => "power",
        }
    }

    /// The probability of each target, up to a common factor: that of its light, then its share of the light's area.
    fn weights(self, lights: &Lights) -> Vec<f64> {
        let mut light_area = vec![0.0; lights.powers().len()];
        for (&light, area) in lights.light_of_target().iter().zip(lights.areas()) {
            light_area[light] += area;
        }
        let of_light = |light: usize| match self {
            Self::ByArea => light_area[light],
            Self::Uniform => 1.0,
            Self::Power => lights.powers()[light],
        };
        let share = |(&light, area): (&usize, &f64)| of_light(light) * area / light_area[light];
        lights.light_of_target().iter().zip(lights.areas()).map(share).collect()
    }
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
    /// The distribution of `selection` over the targets of `lights`; there must be at least one target.
    pub fn new(selection: Selection, lights: &Lights) -> Self {
        let bounds = bounds(&selection.weights(lights));
        let widths: Vec<u64> = bounds.windows(2).map(|b| b[1] - b[0]).collect();
        let probability = |width: &u64| *width as f64 / WORDS as f64;
        let density = widths.iter().zip(lights.areas()).map(|(w, area)| (probability(w) / area) as f32).collect();
        let scale = widths.iter().map(|&width| (1.0 / width as f64) as f32).collect();
        Self { bounds, density, scale }
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
