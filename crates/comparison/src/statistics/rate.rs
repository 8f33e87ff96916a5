//! The rate at which variance falls with the number of samples.

use super::log_variance::LogVariance;
use super::reason::Reason;
use super::regime::Candidates;
use super::student::Z_95;

/// The fitted line's slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateFit {
    /// d ln variance / d ln N.
    pub slope: f64,
    /// 95 % interval of the slope.
    pub interval: [f64; 2],
    /// Birge's ratio √(χ²/(n − 2)), at least 1: how far the points scatter beyond their own errors.
    pub birge: f64,
    /// Name of the one regime of [`REGIMES`](super::REGIMES) whose slope lies in the interval, or why there is none.
    pub regime: Result<&'static str, Reason>,
    /// All regimes whose slopes lie in the interval.
    pub candidates: Candidates,
}

/// Slope of ln s² against ln N by least squares, weighted by the known errors of ln s².
///
/// With x = ln N, y = ln s² and weights w = 1/se²: slope = Σ w (x − x̄) y / Σ w (x − x̄)², x̄ = Σ w x / Σ w, with the
/// standard error 1/√(Σ w (x − x̄)²) (Bevington 1969, chapter 6). As the errors are known, the interval is slope ± z
/// times it. Where the points scatter more than their errors allow, because they do not lie on a line, it is widened
/// by Birge's ratio √(χ²/(n − 2)) (Birge 1932).
///
/// `points` holds N and the variance measured there; sample counts where none could be measured are left out by the
/// caller.
///
/// # Errors
/// [`Reason::FewPoints`] with fewer than two different N.
pub fn fit_rate(points: &[(u64, LogVariance)]) -> Result<RateFit, Reason> {
    let line = Line::through(points).ok_or_else(|| Reason::FewPoints { points: distinct(points) })?;
    let birge = line.birge(points);
    let half = Z_95 * line.standard_error * birge;
    let interval = [line.slope - half, line.slope + half];
    let candidates = Candidates::within(interval, line.logarithm(points));
    Ok(RateFit { slope: line.slope, interval, birge, regime: the_only(candidates), candidates })
}

/// The name of the only candidate, or why there is none.
fn the_only(candidates: Candidates) -> Result<&'static str, Reason> {
    let mut names = candidates.names();
    let first = names.next().ok_or(Reason::NoRegime)?;
    if names.next().is_none() { Ok(first) } else { Err(Reason::SeveralRegimes { found: candidates }) }
}

struct Line {
    slope: f64,
    standard_error: f64,
    centre: [f64; 2],
}

impl Line {
    fn through(points: &[(u64, LogVariance)]) -> Option<Self> {
        let [total, sum_x, sum_y] = sums(points, |x, y| [1.0, x, y]);
        let centre @ [x_mean, y_mean] = [sum_x / total, sum_y / total];
        let [s_xx, s_xy] = sums(points, |x, y| [(x - x_mean) * (x - x_mean), (x - x_mean) * (y - y_mean)]);
        (distinct(points) > 1).then(|| Self { slope: s_xy / s_xx, standard_error: 1.0 / s_xx.sqrt(), centre })
    }

    /// The slope of ln (1 + log₂ N) through the same points.
    fn logarithm(&self, points: &[(u64, LogVariance)]) -> f64 {
        let [x_mean, _] = self.centre;
        let factor = |x: f64| libm::log(1.0 + x / std::f64::consts::LN_2);
        let [s_xx, s_xf] = sums(points, |x, _| [(x - x_mean) * (x - x_mean), (x - x_mean) * factor(x)]);
        s_xf / s_xx
    }

    fn birge(&self, points: &[(u64, LogVariance)]) -> f64 {
        let [x_mean, y_mean] = self.centre;
        let residual = |x: f64, y: f64| y - y_mean - self.slope * (x - x_mean);
        let [chi2] = sums(points, |x, y| [residual(x, y) * residual(x, y)]);
        if points.len() > 2 { (chi2 / (points.len() - 2) as f64).sqrt().max(1.0) } else { 1.0 }
    }
}

/// Weighted sums of functions of (ln N, ln s²).
fn sums<const K: usize>(points: &[(u64, LogVariance)], f: impl Fn(f64, f64) -> [f64; K]) -> [f64; K] {
    points.iter().fold([0.0; K], |sums, (samples, measured)| {
        let weight = 1.0 / (measured.standard_error() * measured.standard_error());
        let values = f(libm::log(*samples as f64), libm::log(measured.variance()));
        std::array::from_fn(|k| sums[k] + weight * values[k])
    })
}

fn distinct(points: &[(u64, LogVariance)]) -> usize {
    let mut counts: Vec<u64> = points.iter().map(|(samples, _)| *samples).collect();
    counts.sort_unstable();
    counts.dedup();
    counts.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::REGIMES;

    /// Replicates whose variance is exactly proportional to `variance`, all with the same relative spread.
    fn point(samples: u64, variance: f64, replicates: u32) -> (u64, LogVariance) {
        let values: Vec<f64> = (0..replicates).map(|k| f64::from(k % 10) * variance.sqrt()).collect();
        (samples, LogVariance::from_replicates(&values).expect("spread is known"))
    }

    fn power_law(exponent: f64, replicates: u32) -> Vec<(u64, LogVariance)> {
        [1, 4, 16, 64, 256].map(|n: u64| point(n, libm::pow(n as f64, exponent), replicates)).to_vec()
    }

    #[test]
    fn an_exact_power_law_gives_its_slope_and_name() {
        for (slope, name) in REGIMES {
            let fit = fit_rate(&power_law(slope, 1000)).expect("five points");
            assert!((fit.slope - slope).abs() < 1e-12, "{fit:?}");
            assert_eq!((fit.regime, fit.birge), (Ok(name), 1.0));
        }
    }

    #[test]
    fn a_wide_interval_has_no_name_and_neither_has_a_strange_slope() {
        let two = [point(1, 1.0, 40), point(2, 0.4, 40)];
        let undecided = fit_rate(&two).map(|fit| fit.regime);
        assert!(
            matches!(undecided, Ok(Err(Reason::SeveralRegimes { found })) if found.to_string() == "1/N or 1/N^1.5")
        );
        assert_eq!(fit_rate(&power_law(-2.5, 1000)).map(|fit| fit.regime), Ok(Err(Reason::NoRegime)));
    }

    #[test]
    fn a_logarithm_is_no_other_regime() {
        let net = [4, 16, 64, 256].map(|n: u64| {
            let size = n as f64;
            point(n, (1.0 + size.log2()) * size.powi(-3), 1000)
        });
        let fit = fit_rate(&net).expect("four points");
        assert!(fit.slope > -2.8 && fit.regime == Ok("1/N^3"), "{fit:?}");
    }

    #[test]
    fn the_sharper_points_carry_the_slope() {
        let points = [point(1, 1.0, 10_000), point(4, 0.25, 10_000), point(16, 1.0, 100)];
        let slope = fit_rate(&points).map(|fit| fit.slope);
        assert!(slope.is_ok_and(|slope| (-1.0..-0.9).contains(&slope)), "{slope:?}");
    }

    #[test]
    fn points_off_the_line_widen_the_interval() {
        let bent: Vec<_> = [(1, 1.0), (4, 0.25), (16, 0.01), (64, 0.000_1)].map(|(n, v)| point(n, v, 1000)).to_vec();
        let fit = fit_rate(&bent).expect("four points");
        assert!(fit.birge > 5.0, "{fit:?}");
        assert!(fit.interval[1] - fit.interval[0] > 0.5, "{fit:?}");
    }

    #[test]
    fn needs_two_sample_counts() {
        assert_eq!(fit_rate(&[]), Err(Reason::FewPoints { points: 0 }));
        let same = [point(4, 1.0, 100), point(4, 2.0, 100)];
        assert_eq!(fit_rate(&same), Err(Reason::FewPoints { points: 1 }));
    }
}
