//! Where two variances are equal.
//!
//! What is looked at is g = (V_a − V_b)/(V_a + V_b), which neither scale nor decay of the two can hide, as a function of a
//! place u. A sign counts only where the variances differ by more than their error bounds allow. Between two samples of
//! opposite sign there is a crossing; where |g| dips without a change of sign, the bottom of the dip is looked for, and on
//! either side of it there may be one; and where g begins between two samples, as at the edge of a shadow, it is followed to
//! its edge. Crossings that lie closer together than the samples, without such a dip, are missed.

/// The difference of two variances over their sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Difference {
    value: f64,
    /// Bound of its error, on the same scale.
    error: f64,
}

impl Difference {
    /// Of two variances, each with its error bound; `None` where both are zero, as without light.
    pub(crate) fn of([a, a_error]: [f64; 2], [b, b_error]: [f64; 2]) -> Option<Self> {
        let sum = a.abs() + b.abs();
        let is_zero = a.abs() <= a_error && b.abs() <= b_error;
        (!is_zero).then(|| Self { value: (a - b) / sum, error: (a_error + b_error) / sum })
    }

    /// −1, 0 or 1; 0 where the difference is within its error bound.
    fn sign(self) -> f64 {
        if self.value.abs() <= self.error { 0.0 } else { self.value.signum() }
    }
}

/// A difference at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sample {
    /// The place.
    pub u: f64,
    /// The difference there; `None` where a variance is missing or both are zero.
    pub difference: Option<Difference>,
}

/// A place where the difference is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Root {
    /// The place.
    pub u: f64,
    /// How far the error bounds of the variances may move it.
    pub error: f64,
}

impl Sample {
    fn known(self) -> Option<Known> {
        self.difference.map(|g| Known { u: self.u, g })
    }

    fn has_sign(self) -> bool {
        self.difference.is_some_and(|g| g.sign() != 0.0)
    }
}

/// A sample that is there.
#[derive(Clone, Copy)]
struct Known {
    u: f64,
    g: Difference,
}

/// All crossings that samples in ascending order show, refined with `g` to the last digits. Nothing is looked for across
/// a sample without a value, nor where the two are equal at several samples in a row: over a whole interval.
pub(crate) fn roots(samples: &[Sample], g: impl Fn(f64) -> Option<Difference>) -> Vec<Root> {
    let search = Search { g };
    let edges = samples.windows(2).flat_map(|pair| search.edge(pair[0], pair[1]));
    let mut all: Vec<Sample> = samples.iter().copied().chain(edges).collect();
    all.sort_by(|a, b| a.u.total_cmp(&b.u));
    let runs = all.split(|sample| sample.difference.is_none());
    runs.flat_map(|run| search.run(run.iter().filter_map(|sample| sample.known()).collect())).collect()
}

/// A jump across zero is no crossing: there g does not become this small.
const SMALL: f64 = 1e-6;
/// A dip or an edge is followed down to this share of its width.
const NARROW: f64 = 1e-6;
/// How near to an end of the samples one more lies, as a share of the distance to the next.
const BESIDE_END: f64 = 1e-3;
/// (3 − √5)/2: where golden-section search probes the longer side.
const GOLDEN: f64 = 0.381_966_011_250_105_15;
/// Ridders' method halves the bracket at least this often.
const HALVINGS: usize = 100;

struct Search<G> {
    g: G,
}

impl<G: Fn(f64) -> Option<Difference>> Search<G> {
    fn sample(&self, u: f64) -> Sample {
        Sample { u, difference: (self.g)(u) }
    }

    fn at(&self, u: f64) -> Option<Known> {
        self.sample(u).known()
    }

    /// Where one of two samples has a sign and the other has none or no value: samples with a sign that approach the
    /// edge between, by halving.
    fn edge(&self, one: Sample, other: Sample) -> Vec<Sample> {
        let (mut inside, mut outside) = match [one, other].map(Sample::has_sign) {
            [true, false] => (one.u, other.u),
            [false, true] => (other.u, one.u),
            _ => return Vec::new(),
        };
        let (mut found, narrow) = (Vec::new(), NARROW * (outside - inside).abs());
        while (outside - inside).abs() > narrow {
            let middle = self.sample(0.5 * (inside + outside));
            if middle.has_sign() {
                found.push(middle);
                inside = middle.u;
            } else {
                outside = middle.u;
            }
        }
        found
    }

    /// The crossings within one run of samples.
    fn run(&self, mut run: Vec<Known>) -> Vec<Root> {
        if let (&[first, second, ..], &[.., before, last]) = (&run[..], &run[..]) {
            run.splice(run.len() - 1..run.len() - 1, self.beside(last, before));
            run.splice(1..1, self.beside(first, second));
        }
        let dips = run.windows(3).filter(|triple| is_dip(triple));
        let beyond: Vec<Known> = dips.filter_map(|triple| self.beyond(triple[0], triple[1], triple[2])).collect();
        run.extend(beyond);
        run.sort_by(|a, b| a.u.total_cmp(&b.u));
        let signed: Vec<(usize, Known)> = run.into_iter().enumerate().filter(|(_, k)| k.g.sign() != 0.0).collect();
        let changes = signed.windows(2).filter(|pair| {
            let equal_between = pair[1].0 - pair[0].0 - 1;
            pair[0].1.g.sign() != pair[1].1.g.sign() && equal_between <= 1
        });
        changes.filter_map(|pair| self.root(pair[0].1, pair[1].1)).collect()
    }

    /// A sample beside an end of the run, which shows whether |g| falls from there: then it has a dip before `next`.
    fn beside(&self, end: Known, next: Known) -> Option<Known> {
        self.at(end.u + BESIDE_END * (next.u - end.u))
    }

    /// A place in a dip where the sign is the other one: golden-section search for the bottom, left as soon as one is met.
    fn beyond(&self, mut low: Known, mut middle: Known, mut high: Known) -> Option<Known> {
        let sign = low.g.sign();
        let narrow = NARROW * (high.u - low.u);
        while high.u - low.u > narrow {
            let in_left = middle.u - low.u > high.u - middle.u;
            let (from, to) = if in_left { (middle.u, low.u) } else { (middle.u, high.u) };
            let probe = self.at(from + (to - from) * GOLDEN)?;
            if probe.g.sign() == -sign {
                return Some(probe);
            }
            let lower = sign * probe.g.value < sign * middle.g.value;
            match (in_left, lower) {
                (true, true) => (middle, high) = (probe, middle),
                (true, false) => low = probe,
                (false, true) => (low, middle) = (middle, probe),
                (false, false) => high = probe,
            }
        }
        None
    }

    /// The zero between two places of opposite sign, by Ridders' method (1979); `None` where g jumps, or has no value.
    fn root(&self, mut low: Known, mut high: Known) -> Option<Root> {
        let width = high.u - low.u;
        let mut best = low;
        for _ in 0..HALVINGS {
            let middle = self.at(0.5 * (low.u + high.u))?;
            let (a, m, b) = (low.g.value, middle.g.value, high.g.value);
            let step = (middle.u - low.u) * (a - b).signum() * m / (m * m - a * b).sqrt();
            let next = self.at(middle.u + step)?;
            let settled = (next.u - best.u).abs() <= f64::EPSILON * next.u.abs();
            best = next;
            if settled || next.g.value == 0.0 {
                break;
            }
            let inner = if step > 0.0 { [middle, next] } else { [next, middle] };
            let points = [low, inner[0], inner[1], high];
            let change = |pair: &&[Known]| pair[0].g.value.signum() != pair[1].g.value.signum();
            let bracket = points.windows(2).find(change)?;
            (low, high) = (bracket[0], bracket[1]);
        }
        let reached = best.g.value.abs() <= SMALL.max(best.g.error);
        reached.then(|| Root { u: best.u, error: self.uncertainty(best, width) })
    }

    /// What the error of g makes of u: error / |dg/du|, the slope over a thousandth of the bracket to either side.
    fn uncertainty(&self, root: Known, width: f64) -> f64 {
        let h = 1e-3 * width;
        let rise = match (self.at((root.u - h).max(0.0)), self.at((root.u + h).min(1.0))) {
            (Some(before), Some(after)) => (after.g.value - before.g.value) / (after.u - before.u),
            _ => 0.0,
        };
        let rounding = 2.0 * f64::EPSILON * root.u.abs();
        (root.g.error / rise.abs() + rounding).min(width)
    }
}

/// Whether |g| has its least value in the middle of three samples of one sign, the middle one perhaps of none.
fn is_dip(triple: &[Known]) -> bool {
    let [a, b, c] = [triple[0].g, triple[1].g, triple[2].g];
    let one_sign = a.sign() != 0.0 && a.sign() == c.sign() && (b.sign() == 0.0 || b.sign() == a.sign());
    let (a, b, c) = (a.value.abs(), b.value.abs(), c.value.abs());
    one_sign && b <= a && b <= c && b < a.max(c)
}

#[cfg(test)]
mod tests {
    use super::{Difference, Root, Sample, roots};

    /// The crossings of a(u) and b(u) with a relative error bound, from `steps` samples of \[0, 1\].
    fn found(a: impl Fn(f64) -> f64, b: impl Fn(f64) -> f64, error: f64, steps: u32) -> Vec<Root> {
        search(|u| Difference::of([a(u), error * a(u)], [b(u), error * b(u)]), steps)
    }

    fn search(g: impl Fn(f64) -> Option<Difference>, steps: u32) -> Vec<Root> {
        let places = (0..steps).map(|k| f64::from(k) / f64::from(steps - 1));
        roots(&places.map(|u| Sample { u, difference: g(u) }).collect::<Vec<_>>(), g)
    }

    fn places(roots: &[Root]) -> Vec<f64> {
        roots.iter().map(|root| root.u).collect()
    }

    #[test]
    fn a_crossing_is_found_to_the_last_digits() {
        let roots = found(f64::exp, |_| 1.3, 1e-15, 10);
        assert_eq!(roots.len(), 1);
        assert!((roots[0].u - 1.3_f64.ln()).abs() < 1e-15 && roots[0].error < 1e-13, "{roots:?}");
    }

    /// However much the two fall with u.
    #[test]
    fn two_crossings_between_two_samples_are_found_by_the_dip() {
        for (p, q) in [(0.23, 0.26), (0.01, 0.02), (0.97, 0.975)] {
            let decay = |u: f64| (-30.0 * u).exp();
            let ratio = |u: f64| (1.0 + (u - p) * (u - q)) * decay(u);
            let roots = places(&found(ratio, decay, 1e-14, 12));
            assert_eq!(roots.len(), 2, "{p} {q}: {roots:?}");
            assert!((roots[0] - p).abs() < 1e-10 && (roots[1] - q).abs() < 1e-10, "{roots:?}");
        }
    }

    #[test]
    fn equal_variances_do_not_cross_whatever_their_rounding() {
        let noise = |u: f64| 1.0 + 1e-13 * (1e6 * u).sin();
        assert_eq!(found(noise, |_| 1.0, 1e-12, 100), []);
        assert_eq!(found(|_| 0.0, |_| 0.0, 0.0, 10), []);
    }

    /// As in an umbra, where all variances are zero.
    #[test]
    fn equality_over_an_interval_is_no_crossing() {
        let turn = |u: f64| 1.0 + (u - 0.3).min(0.0) + (u - 0.7).max(0.0);
        assert_eq!(found(turn, |_| 1.0, 1e-15, 12), []);
        let shadow = |u: f64| if (0.3..0.8).contains(&u) { 0.0 } else { 1.0 };
        assert_eq!(found(|u| u * shadow(u), |u| 0.5 * shadow(u), 1e-15, 12), []);
    }

    /// A crossing between the edge of a shadow and the first sample beyond it.
    #[test]
    fn the_edge_of_a_shadow_is_looked_at() {
        for edge in [0.3, 0.34] {
            let light = |u: f64| (u - edge).max(0.0);
            let roots = places(&found(|u| light(u) * 1.37, |u| light(u) * (1.0 + u), 1e-15, 11));
            assert!(roots.len() == 1 && (roots[0] - 0.37).abs() < 1e-12, "{edge}: {roots:?}");
        }
    }

    #[test]
    fn a_jump_and_a_touch_are_no_crossings() {
        assert_eq!(found(|u| if u < 0.37 { 1.0 } else { 3.0 }, |_| 2.0, 1e-15, 11), []);
        assert_eq!(found(|u| 1.0 + (u - 0.33).powi(2), |_| 1.0, 1e-12, 11), []);
    }

    #[test]
    fn nothing_is_looked_for_across_a_missing_value() {
        let g =
            |missing: f64| move |u: f64| Difference::of([u, 0.0], [0.65, 0.0]).filter(|_| (u - missing).abs() > 0.06);
        assert_eq!(search(g(0.6), 11), []);
        assert_eq!(search(g(0.3), 11).len(), 1);
    }

    #[test]
    fn the_error_of_a_crossing_follows_from_those_of_the_variances() {
        let roots = found(|u| 1.0 + 0.1 * u, |_| 1.025, 1e-9, 8);
        assert_eq!(roots.len(), 1);
        // 2.05e-9 over a slope of 0.1
        assert!((roots[0].error / 2.05e-8 - 1.0).abs() < 1e-3, "{roots:?}");
    }
}
