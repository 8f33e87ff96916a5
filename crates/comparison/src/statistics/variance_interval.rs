//! The 95 % interval of the variance of an N-sample estimate.

use super::clopper_pearson::clopper_pearson;
use super::log_variance::LogVariance;
use super::reason::Reason;

/// What is known where every single, independent sample is worth either zero or one and the same value.
///
/// Such are cosine-weighted directions under one radiance: πL where the light is met, else zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoValued {
    /// w, the value that is not zero, in the estimates' unit.
    pub value: f64,
    /// k, the number of samples worth w, over all replicates.
    pub hits: u64,
    /// R·N, the number of samples over all replicates.
    pub samples: u64,
}

/// 95 % interval of the variance of an N-sample estimate, from R independent replicates of it.
///
/// `estimates` holds one value (a luminance) per replicate. Where `two_valued` is given, the interval is Clopper and
/// Pearson's for the hits' probability p, carried through p (1 − p) w² / N, exact for any number of hits: it uses all
/// R·N samples and is therefore narrower than the spread of the replicates' own sample variance when N > 1. Otherwise
/// it is [`LogVariance`]'s, from the replicates' fourth moment, valid for every sampler.
///
/// # Errors
/// A [`Reason`] where the data cannot say: see [`LogVariance::from_replicates`]; for two values, fewer than two
/// replicates, no hit or nothing but hits.
pub fn variance_interval(estimates: &[f64], two_valued: Option<TwoValued>) -> Result<[f64; 2], Reason> {
    match two_valued {
        Some(counts) => counts.variance_interval(estimates.len()),
        None => LogVariance::from_replicates(estimates).map(|measured| measured.interval()),
    }
}

impl TwoValued {
    fn variance_interval(self, replicates: usize) -> Result<[f64; 2], Reason> {
        let Self { value, hits, samples } = self;
        if replicates < 2 {
            return Err(Reason::FewReplicates { replicates });
        }
        match hits {
            _ if !value.is_finite() => Err(Reason::NotFinite),
            _ if hits > samples => Err(Reason::NotACount { hits, samples }),
            _ if hits == 0 || hits == samples => Err(Reason::AllEqual),
            _ => {
                let n = samples as f64 / replicates as f64;
                Ok(bernoulli_variance(clopper_pearson(hits, samples, 0.05))
                    .map(|variance| variance * value * value / n))
            }
        }
    }
}

/// Image of an interval of p under p (1 − p), which peaks at 1/2.
fn bernoulli_variance([lo, hi]: [f64; 2]) -> [f64; 2] {
    let (at_lo, at_hi) = (lo * (1.0 - lo), hi * (1.0 - hi));
    let peak = if lo <= 0.5 && 0.5 <= hi { 0.25 } else { at_lo.max(at_hi) };
    [at_lo.min(at_hi), peak]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_image_of_an_interval_holds_its_peak() {
        assert_eq!(bernoulli_variance([0.0, 0.25]), [0.0, 0.1875]);
        assert_eq!(bernoulli_variance([0.75, 1.0]), [0.0, 0.1875]);
        assert_eq!(bernoulli_variance([0.25, 0.625]), [0.1875, 0.25]);
    }

    #[test]
    fn two_values_scale_with_value_and_samples() {
        let of = |value, samples| variance_interval(&[0.0; 100], Some(TwoValued { value, hits: 50, samples }));
        let [lo, hi] = bernoulli_variance(clopper_pearson(50, 1600, 0.05));
        assert_eq!(of(2.0, 1600), Ok([lo * 4.0 / 16.0, hi * 4.0 / 16.0]));
    }

    #[test]
    fn two_values_refuse_with_the_reason() {
        let of = |hits, value, replicates| {
            let counts = TwoValued { value, hits, samples: 100 };
            variance_interval(&vec![0.0; replicates], Some(counts)).err()
        };
        assert_eq!(of(0, 1.0, 100), Some(Reason::AllEqual));
        assert_eq!(of(100, 1.0, 100), Some(Reason::AllEqual));
        assert_eq!(of(101, 1.0, 100), Some(Reason::NotACount { hits: 101, samples: 100 }));
        assert_eq!(of(5, 1.0, 1), Some(Reason::FewReplicates { replicates: 1 }));
        assert_eq!(of(5, f64::NAN, 100), Some(Reason::NotFinite));
        assert_eq!(of(1, 1.0, 100), None);
    }

    /// At N = 1 both ways see the same data, and agree where hits are many.
    #[test]
    fn both_ways_agree_for_many_hits() {
        let estimates: Vec<f64> = (0..4000).map(|k| if k % 5 == 0 { 3.0 } else { 0.0 }).collect();
        let counts = TwoValued { value: 3.0, hits: 800, samples: 4000 };
        let (exact, fourth) = (variance_interval(&estimates, Some(counts)), variance_interval(&estimates, None));
        let (Ok(exact), Ok(fourth)) = (exact, fourth) else { panic!("both are given") };
        for (exact, fourth) in exact.into_iter().zip(fourth) {
            assert!((exact / fourth - 1.0).abs() < 0.01, "{exact} {fourth}");
        }
    }
}
