//! From measurements to rows and rates.

use std::collections::BTreeMap;

use twoforms_estimator::lights::Lights;
use twoforms_estimator::rgb::luminance;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;

use crate::experiment::Plan;
use crate::measurement::Measurement;
use crate::place::{Place, Quantity};
use crate::result::{Chebyshev, Colour, Known, Rate, ReceiverResult, Row, Why};
use crate::statistics::{
    LogVariance, Reason, TwoValued, chebyshev, efficiency, fit_rate, sample_mean, sample_variance, variance_interval,
};

/// δ of the Chebyshev bound that rows report: at most one replicate in twenty outside.
const DELTA: f64 = 0.05;
/// Hits from which samples that all have one value are taken for two-valued, the other value being zero.
const HITS_OF_ONE_VALUE: u64 = 30;

/// All that is said of one receiver.
pub(crate) fn receiver_result(
    place: &Place,
    setup_seconds: f64,
    measured: &[(&Plan, Measurement)],
    lights: &Lights,
) -> ReceiverResult {
    let known = place.known.as_ref().filter(|_| place.quantity == Quantity::Irradiance).map(|known| Known {
        irradiance: known.irradiance.into(),
        variance: known.variance.clone(),
        derivation: known.derivation.clone(),
    });
    let reference = Reference { known: known.as_ref(), one_colour: lights.one_colour() };
    ReceiverResult {
        name: place.name.clone(),
        position: place.position.to_array(),
        normal: place.normal.to_array(),
        setup_seconds,
        rows: measured.iter().map(|(plan, measurement)| row(plan, measurement, &reference)).collect(),
        verdicts: Vec::new(),
        rates: rates(measured),
        exact: None,
        why: Why::from([("exact", "no closed form is evaluated for this quantity".to_owned())]),
        known,
    }
}

/// What the scene says the answer is.
struct Reference<'a> {
    known: Option<&'a Known>,
    one_colour: bool,
}

impl Reference<'_> {
    /// The known luminance variance of one sample, where the scene cites it per channel and all light has one colour:
    /// then channels are proportional, and √V_Y = Σ l_c √V_c.
    fn variance_of_one(&self, strategy: Strategy) -> Option<f64> {
        let channels = self.known?.variance.get(&strategy.to_string())?;
        let deviation = luminance(channels.map(f64::sqrt));
        self.one_colour.then_some(deviation * deviation)
    }
}

fn row(plan: &Plan, measured: &Measurement, reference: &Reference) -> Row {
    let mut why = Why::new();
    let replicates = measured.estimates.len();
    let strategy = plan.prepared.strategy();
    let seconds = measured.seconds / replicates as f64;
    let variance_of_mean = or_why(&mut why, "variance_of_mean", sample_variance(&measured.estimates), || {
        "a variance needs at least two replicates".into()
    });
    let interval = interval(plan, measured);
    let variance_interval = interval.map_err(|reason| why.insert("variance_interval", reason.to_string())).ok();
    let variance_exact = reference.variance_of_one(strategy).filter(|_| plan.sampler == Sampler::Independent);
    let variance_exact = or_why(&mut why, "variance_exact", variance_exact, || "no exact variance is known".into());
    let variance_of_one =
        or_why(&mut why, "variance_of_one", measured.one.variance(), || "there is a single sample".into());
    let efficiency = variance_of_mean.and_then(|variance| efficiency(variance, seconds));
    Row {
        strategy: strategy.to_string(),
        sampler: plan.sampler.to_string(),
        samples: plan.samples.into(),
        replicates: replicates as u64,
        mean: Colour::from(measured.total.map(|sum| sum / replicates as f64)),
        variance_of_mean,
        variance_interval,
        variance_exact: variance_exact.map(|one| one / f64::from(plan.samples)),
        variance_of_one,
        chebyshev: kept(measured, reference, variance_exact.map(|one| one / f64::from(plan.samples))),
        rays: measured.rays as f64 / replicates as f64,
        seconds,
        efficiency: or_why(&mut why, "efficiency", efficiency, || "the variance or the time is zero or unknown".into()),
        why,
    }
}

fn or_why<T>(why: &mut Why, field: &'static str, value: Option<T>, reason: impl FnOnce() -> String) -> Option<T> {
    if value.is_none() {
        why.insert(field, reason());
    }
    value
}

/// The 95 % interval of the variance over replicates. Where samples take two values, Clopper and Pearson's: of single
/// samples, and of N where the replicates alone cannot say. (It is valid for any N, but being narrower than the spread
/// of the replicates' own variance it would mostly leave out the number that it stands beside.)
fn interval(plan: &Plan, measured: &Measurement) -> Result<[f64; 2], Reason> {
    let two_valued = two_valued(plan, measured);
    let of_one = two_valued.filter(|_| plan.samples == 1);
    variance_interval(&measured.estimates, of_one)
        .or_else(|reason| two_valued.map_or(Err(reason), |_| variance_interval(&measured.estimates, two_valued)))
}

/// Independent samples that are zero or all one value, as cosine-weighted directions are under one radiance.
fn two_valued(plan: &Plan, measured: &Measurement) -> Option<TwoValued> {
    let two =
        plan.sampler == Sampler::Independent && measured.hits >= HITS_OF_ONE_VALUE && measured.range.is_one_value();
    let samples = u64::from(plan.samples) * measured.estimates.len() as u64;
    two.then_some(TwoValued { value: measured.range.high, hits: measured.hits, samples })
}

/// Chebyshev's bound about the known value, else about the mean; with the exact variance, else the measured one.
fn kept(measured: &Measurement, reference: &Reference, exact: Option<f64>) -> Option<Chebyshev> {
    let (centre, about) = match reference.known {
        Some(known) => (known.irradiance.luminance, "known"),
        None => (sample_mean(&measured.estimates)?, "mean"),
    };
    let sigma = exact.or_else(|| sample_variance(&measured.estimates))?.sqrt();
    let band = chebyshev(&measured.estimates, centre, sigma, DELTA)?;
    Some(Chebyshev { delta: DELTA, bound: band.bound, outside: band.outside, about })
}

/// One fitted slope per strategy and sampler, in the order of the rows.
fn rates(measured: &[(&Plan, Measurement)]) -> Vec<Rate> {
    let mut order: Vec<(Strategy, Sampler)> = measured.iter().map(|(plan, _)| plan.pair()).collect();
    order.dedup();
    let mut points: BTreeMap<usize, Vec<(u64, LogVariance)>> = BTreeMap::new();
    for (plan, measurement) in measured {
        if let (Some(place), Ok(variance)) =
            (order.iter().position(|pair| *pair == plan.pair()), LogVariance::from_replicates(&measurement.estimates))
        {
            points.entry(place).or_default().push((plan.samples.into(), variance));
        }
    }
    let fits = order.iter().enumerate().map(|(place, pair)| (pair, points.remove(&place).unwrap_or_default()));
    fits.map(|((strategy, sampler), points)| rate(*strategy, *sampler, &points)).collect()
}

fn rate(strategy: Strategy, sampler: Sampler, points: &[(u64, LogVariance)]) -> Rate {
    let mut why = Why::new();
    let fit = fit_rate(points).map_err(|reason| why.insert("slope", reason.to_string())).ok();
    let regime = fit.and_then(|fit| fit.regime.map_err(|reason| why.insert("regime", reason.to_string())).ok());
    Rate {
        strategy: strategy.to_string(),
        sampler: sampler.to_string(),
        slope: fit.map(|fit| fit.slope),
        interval: fit.map(|fit| fit.interval),
        regime: regime.map(str::to_owned),
        why,
    }
}
