//! One sentence to remember: which strategy had the lowest variance, by what factor, and at what cost.

use crate::document::Document;
use crate::layout::plain;
use crate::number::{count, duration, percent, plus_minus, rounded, significant};
use crate::ranking::{Pooled, Ranking, Unranked};

/// The sentence for `document`.
///
/// Variances of the estimate are compared at the largest N that all strategies share, by their geometric mean over
/// the receivers at which every strategy has a positive variance. The uncertainty is half a 95 % interval: the rows'
/// intervals carried on the log scale, receivers and strategies taken as independent; where it is large, the interval
/// itself is given. Strategies whose ratio to the lowest may be 1 within it are named as tied. Rays and CPU seconds
/// are those of an estimate, mean over the same receivers, without the set-up per receiver. A strategy without any
/// variance, or one whose samples all missed the lights, is named apart.
///
/// # Example
/// "area/uniform had the lowest variance: 41 ± 2 times lower than hemisphere/cosine and 73 ± 4 times lower than
/// hemisphere/uniform (geometric mean over 9 receivers at N = 1024; ± is 95 %), at 0.96 times the rays and 1.3 times
/// the time of hemisphere/cosine."
pub fn sentence(document: &Document) -> String {
    match Ranking::new(document.receivers()) {
        Ok(ranking) => format!("{}{}{}.", apart(&ranking), verdict(&ranking), missed(&ranking)),
        Err(Unranked::Counts) => "The strategies share no sample count, so their variances are not compared.".into(),
        Err(Unranked::Dark) => "All estimates are zero: no sample met a light.".into(),
        Err(Unranked::Constant) => {
            "No receiver shows a variance for every strategy: comparing them needs more replicates or samples.".into()
        }
    }
}

/// Names those without any variance, and at how many receivers if not at all of them.
fn apart(ranking: &Ranking) -> String {
    let said = constant(ranking);
    match (&said[..], &ranking.ranked[..]) {
        ("", _) => String::new(),
        (said, []) => format!("{said} {}", place(ranking, false)),
        (said, [_]) => format!("{said}; "),
        (said, _) => format!("{said}; of the others, "),
    }
}

/// `a and b had no variance at all; c had none at 8 of 9 receivers`.
fn constant(ranking: &Ranking) -> String {
    let mut counts: Vec<usize> = ranking.constant.iter().map(|(_, count)| *count).collect();
    counts.sort_unstable_by(|a, b| b.cmp(a));
    counts.dedup();
    let clause = |count: &usize| {
        let of_count = ranking.constant.iter().filter(|(_, other)| other == count);
        let names = list(&of_count.map(|(name, _)| name.clone()).collect::<Vec<_>>());
        let all = *count == ranking.of;
        let place = if all { "at all".into() } else { format!("at {count} of {} receivers", ranking.of) };
        format!("{names} had no variance {place}")
    };
    counts.iter().map(clause).collect::<Vec<_>>().join("; ")
}

/// What the ranking says.
fn verdict(ranking: &Ranking) -> String {
    match (&ranking.ranked[..], ranking.tied()) {
        ([], _) => String::new(),
        ([only], _) => alone(ranking, only),
        (all, tied) if tied == all.len() => all_tied(ranking, all),
        (all, tied) => won(ranking, &all[..tied], &all[tied..]),
    }
}

/// A single strategy: its variance as it is.
fn alone(ranking: &Ranking, only: &Pooled) -> String {
    let variance = significant(only.log_variance.exp());
    let uncertainty = only.half_width.map(|half| format!(" ± {}", percent(half))).unwrap_or_default();
    let place = place(ranking, only.half_width.is_some());
    format!("{} had a variance of {variance}{uncertainty} {place}, at {}", only.name, cost(std::slice::from_ref(only)))
}

/// No strategy stands out.
fn all_tied(ranking: &Ranking, all: &[Pooled]) -> String {
    let names = list(&names(all));
    format!("{names} had the same variance within its uncertainty {}, at {}", place(ranking, false), cost(all))
}

/// `best` had the lowest variance; `others` follow, lowest first.
fn won(ranking: &Ranking, best: &[Pooled], others: &[Pooled]) -> String {
    let (next, worst) = (&others[0], &others[others.len() - 1]);
    let equal = if best.len() > 1 { ", equal within its uncertainty" } else { "" };
    let compared = if others.len() > 1 { vec![next, worst] } else { vec![next] };
    let lower = |other: &Pooled| format!("{} lower than {}", times(&best[0], other), other.name);
    let factors = list(&compared.into_iter().map(lower).collect::<Vec<_>>());
    let known = best[0].half_width.is_some() && (next.half_width.is_some() || worst.half_width.is_some());
    let (place, cost) = (place(ranking, known), relative_cost(best, next));
    let lowest = if known { "lowest" } else { "lowest measured" };
    format!("{} had the {lowest} variance{equal}: {factors} {place}, at {cost}", list(&names(best)))
}

/// Names those that never met a light.
fn missed(ranking: &Ranking) -> String {
    match &ranking.missed[..] {
        [] => String::new(),
        names => format!("; no sample of {} met a light", list(names)),
    }
}

/// How many times lower, with the uncertainty: `41 ± 2 times`, `12 (7.1 to 20) times`, `about 41 times`.
fn times(low: &Pooled, high: &Pooled) -> String {
    let (log_factor, half_width) = low.log_factor(high);
    let factor = log_factor.exp();
    match half_width {
        None => format!("about {} times (no interval)", rounded(factor, 2)),
        Some(half) if half < 0.3 => format!("{} times", plus_minus(factor, factor * half)),
        Some(half) => {
            let [lo, hi] = [-half, half].map(|side| rounded((log_factor + side).exp(), 2));
            format!("{} ({lo} to {hi}) times", rounded(factor, 2))
        }
    }
}

/// Where the figures hold: `(geometric mean over 7 of 9 receivers at N = 1024; ± is 95 %)`.
fn place(ranking: &Ranking, with_uncertainty: bool) -> String {
    let over = match (&ranking.receivers[..], ranking.of) {
        ([name], 1) => format!("at {}, N = {}", plain(name), ranking.samples),
        (pooled, all) if pooled.len() == all => {
            format!("geometric mean over {all} receivers at N = {}", ranking.samples)
        }
        (pooled, all) => format!("geometric mean over {} of {all} receivers at N = {}", pooled.len(), ranking.samples),
    };
    let note = if with_uncertainty { "; ± is 95 %" } else { "" };
    format!("({over}{note})")
}

/// Rays and time against another strategy's, or as they are where a ratio has no meaning.
fn relative_cost(of: &[Pooled], to: &Pooled) -> String {
    if to.rays == 0.0 || to.seconds == 0.0 {
        return cost(of);
    }
    let rays = of.iter().map(|pooled| rounded(pooled.rays / to.rays, 2));
    let time = of.iter().map(|pooled| rounded(pooled.seconds / to.seconds, 2));
    format!("{} times the rays and {} times the time of {}", each(rays), each(time), to.name)
}

/// Rays and time of an estimate.
fn cost(of: &[Pooled]) -> String {
    let rays = of.iter().map(|pooled| count(pooled.rays));
    let time = of.iter().map(|pooled| duration(pooled.seconds));
    format!("{} rays and {} an estimate", each(rays), each(time))
}

fn names(of: &[Pooled]) -> Vec<String> {
    of.iter().map(|pooled| pooled.name.clone()).collect()
}

/// One figure where all are the same, else all in order.
fn each(figures: impl Iterator<Item = String>) -> String {
    let mut figures: Vec<String> = figures.collect();
    figures.dedup();
    list(&figures)
}

/// `a`, `a and b`, `a, b and c`.
fn list(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [init @ .., last] => format!("{} and {last}", init.join(", ")),
    }
}
