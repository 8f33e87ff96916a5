//! From measurements to rows and rates.

use std::collections::BTreeMap;

use twoforms_estimator::rgb::luminance;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;

use crate::answer::Answer;
use crate::measurement::Measurement;
use crate::place::{Place, Quantity};
use crate::plan::Plan;
use crate::result::{Chebyshev, Colour, Known, Rate, ReceiverResult, Row, Why};
use crate::statistics::{
    LogVariance, Reason, TwoValued, chebyshev, efficiency, fit_rate, sample_mean, sample_variance, variance_interval,
};
use crate::verdict::{Criteria, Evidence, judge};

/// δ of the Chebyshev bound that rows report: at most one replicate in twenty outside.
const DELTA: f64 = 0.05;
/// Why a deterministic rule has no variance.
const NO_CHANCE: &str = "a deterministic rule has an error, and no variance";
/// Hits from which samples that all have one value are taken for two-valued, the other value being zero.
const HITS_OF_ONE_VALUE: u64 = 30;

/// What a run has to say so far.
#[derive(Default)]
pub(crate) struct Report {
    results: Vec<ReceiverResult>,
    evidence: Vec<Evidence>,
}

impl Report {
    /// Adds what was measured at one receiver, row by row.
    pub(crate) fn add(
        &mut self,
        place: &Place,
        setup_seconds: f64,
        measured: &[(&Plan, Measurement)],
        answer: &Answer,
    ) {
        let (receiver, emission) = (self.results.len(), luminance(place.emission()));
        self.evidence.extend(evidence(receiver, emission, measured, answer));
        let mut why = Why::new();
        let exact = answer.irradiance().map_err(|reason| why.insert("exact", reason.to_owned())).ok();
        self.results.push(ReceiverResult {
            name: place.name.clone(),
            position: place.position.to_array(),
            normal: place.normal.to_array(),
            setup_seconds,
            rows: measured.iter().map(|(plan, measurement)| row(plan, measurement, answer)).collect(),
            verdicts: Vec::new(),
            rates: rates(measured),
            exact,
            known: known(place),
            why,
        });
    }

    /// The results with the verdicts over all of them.
    pub(crate) fn judged(mut self, criteria: Criteria) -> Vec<ReceiverResult> {
        for (evidence, verdict) in self.evidence.iter().zip(judge(&self.evidence, criteria)) {
            self.results[evidence.receiver].verdicts.push(verdict);
        }
        self.results
    }
}

fn known(place: &Place) -> Option<Known> {
    let known = place.known.as_ref().filter(|_| place.quantity == Quantity::Irradiance)?;
    Some(Known {
        irradiance: known.irradiance.into(),
        variance: known.variance.clone(),
        derivation: known.derivation.clone(),
    })
}

/// The samples of each strategy and sampler, all N pooled, against the value that they should have; nothing where there
/// is no exact value.
fn evidence(receiver: usize, emission: f64, measured: &[(&Plan, Measurement)], answer: &Answer) -> Vec<Evidence> {
    let Ok(exact) = answer.irradiance() else { return Vec::new() };
    let of = |(strategy, sampler): (Strategy, Sampler)| {
        let rows: Vec<_> = measured.iter().filter(|(plan, _)| plan.pair() == (strategy, sampler)).collect();
        let pooled = rows.iter().fold(Measurement::default(), |pooled, (_, row)| pooled.with_samples_of(row));
        let evidence = Evidence {
            receiver,
            strategy: strategy.to_string(),
            sampler: sampler.to_string(),
            reference: (exact.irradiance.luminance - emission, exact.error_bound),
            exact_variance: answer.variance_of_one(strategy).ok(),
            units: pooled.one,
            samples_per_unit: 1.0,
            hits: pooled.hits,
            one_value: pooled.range.is_one_value().then_some(pooled.range.high),
            signed: strategy.can_be_negative(),
            biased: strategy.is_biased() || !sampler.is_random(),
        };
        if sampler == Sampler::Independent && !strategy.is_biased() {
            evidence
        } else {
            evidence.of_replicates(&replicates(&rows, emission))
        }
    };
    pairs(measured).into_iter().map(of).collect()
}

/// Estimates that are independent whatever the sampler: the mean over all N of each replicate, less what x emits itself;
/// and the number of samples in each.
fn replicates(rows: &[&(&Plan, Measurement)], emission: f64) -> (Vec<f64>, f64) {
    let total: f64 = rows.iter().map(|(plan, _)| f64::from(plan.samples)).sum();
    let mut means = vec![0.0; rows.first().map_or(0, |(_, row)| row.estimates.len())];
    for (plan, row) in rows {
        let share = f64::from(plan.samples) / total;
        means.iter_mut().zip(&row.estimates).for_each(|(mean, estimate)| *mean += share * (estimate - emission));
    }
    (means, total)
}

fn row(plan: &Plan, measured: &Measurement, answer: &Answer) -> Row {
    let mut why = Why::new();
    let replicates = measured.estimates.len();
    let strategy = plan.prepared.strategy();
    let seconds = measured.seconds / replicates as f64;
    let random = plan.sampler.is_random();
    let variance = sample_variance(&measured.estimates);
    let variance_of_mean = or_why(&mut why, "variance_of_mean", variance, || {
        if random { "a variance needs at least two replicates".into() } else { NO_CHANCE.into() }
    });
    let interval =
        interval(plan, measured).map_err(|reason| if random { reason.to_string() } else { NO_CHANCE.into() });
    let variance_interval = interval.map_err(|reason| why.insert("variance_interval", reason)).ok();
    let exact = if plan.sampler == Sampler::Independent {
        answer.variance_of_one(strategy)
    } else {
        Err("the exact variance is known for independent samples".to_owned())
    };
    let variance_exact = exact.map_err(|reason| why.insert("variance_exact", reason)).ok();
    let variance_exact = variance_exact.map(|one| one / f64::from(plan.samples));
    let over_exact = |variance: f64| variance_exact.filter(|exact| *exact > 0.0).map(|exact| variance / exact);
    let variance_ratio = or_why(&mut why, "variance_ratio", variance_of_mean.and_then(over_exact), || {
        "the measured or the exact variance is unknown, or the exact one is zero".into()
    });
    let of_one = measured.one.variance().filter(|_| random && !strategy.is_biased());
    let variance_of_one = or_why(&mut why, "variance_of_one", of_one, || match (random, strategy.is_biased()) {
        (false, _) => NO_CHANCE.into(),
        (true, true) => "an estimate is a quotient of sums, not a mean of samples".into(),
        (true, false) => "there is a single sample".into(),
    });
    let mean = Colour::from(measured.total.map(|sum| sum / replicates as f64));
    let error = answer.irradiance().map(|exact| mean.luminance - exact.irradiance.luminance);
    let error = error.map_err(|reason| why.insert("error", reason.to_owned())).ok();
    let efficiency = variance_of_mean.and_then(|variance| efficiency(variance, seconds));
    Row {
        strategy: strategy.to_string(),
        sampler: plan.sampler.to_string(),
        samples: plan.samples.into(),
        replicates: replicates as u64,
        mean,
        error,
        variance_of_mean,
        variance_interval,
        variance_exact,
        variance_ratio,
        variance_ratio_interval: ratio_interval(&mut why, variance_interval, &over_exact),
        variance_of_one,
        chebyshev: kept(measured, answer, variance_exact).filter(|_| random),
        rays: measured.rays as f64 / replicates as f64,
        seconds,
        setup_rays: measured.setup.rays,
        setup_seconds: measured.setup.seconds() + answer.known_seconds(strategy),
        efficiency: or_why(&mut why, "efficiency", efficiency, || "the variance or the time is zero or unknown".into()),
        why,
    }
}

/// The interval of the measured variance over the exact one.
fn ratio_interval(
    why: &mut Why,
    interval: Option<[f64; 2]>,
    over_exact: &impl Fn(f64) -> Option<f64>,
) -> Option<[f64; 2]> {
    let ratios = interval.and_then(|[lo, hi]| Some([over_exact(lo)?, over_exact(hi)?]));
    or_why(why, "variance_ratio_interval", ratios, || "the variance's interval or the ratio is unknown".into())
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

/// Chebyshev's bound about the exact value, else about the mean; with the exact variance, else the measured one.
fn kept(measured: &Measurement, answer: &Answer, exact: Option<f64>) -> Option<Chebyshev> {
    let (centre, about) = match answer.irradiance() {
        Ok(exact) => (exact.irradiance.luminance, "exact"),
        Err(_) => (sample_mean(&measured.estimates)?, "mean"),
    };
    let sigma = exact.or_else(|| sample_variance(&measured.estimates))?.sqrt();
    let band = chebyshev(&measured.estimates, centre, sigma, DELTA)?;
    Some(Chebyshev { delta: DELTA, bound: band.bound, outside: band.outside, about })
}

/// The strategies and samplers of the rows, in their order.
fn pairs(measured: &[(&Plan, Measurement)]) -> Vec<(Strategy, Sampler)> {
    let mut pairs: Vec<(Strategy, Sampler)> = measured.iter().map(|(plan, _)| plan.pair()).collect();
    pairs.dedup();
    pairs
}

/// One fitted slope per strategy and sampler, in the order of the rows.
fn rates(measured: &[(&Plan, Measurement)]) -> Vec<Rate> {
    let order = pairs(measured);
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
    let no_slope = |reason: Reason| if sampler.is_random() { reason.to_string() } else { NO_CHANCE.to_owned() };
    let fit = fit_rate(points).map_err(|reason| why.insert("slope", no_slope(reason))).ok();
    let regime = fit.and_then(|fit| fit.regime.map_err(|reason| why.insert("regime", reason.to_string())).ok());
    Rate {
        strategy: strategy.to_string(),
        sampler: sampler.to_string(),
        slope: fit.map(|fit| fit.slope),
        interval: fit.map(|fit| fit.interval),
        regime: regime.map(str::to_owned),
        candidates: fit.iter().flat_map(|fit| fit.candidates.names()).map(str::to_owned).collect(),
        why,
    }
}
