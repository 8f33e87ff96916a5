//! Coverage of the statistics, by simulation: how often a 95 % interval holds the truth.
//!
//! `cargo test -p twoforms-comparison --test statistics -- --nocapture` prints what was measured.

mod random;
mod rates;
mod two_values;
mod variances;

/// Coverage counted over trials.
#[derive(Clone, Copy, Default)]
struct Coverage {
    trials: u32,
    given: u32,
    kept: u32,
    below: u32,
    width: f64,
}

impl Coverage {
    /// Counts one interval, or its refusal, against the truth.
    fn count(&mut self, interval: Option<[f64; 2]>, truth: f64) {
        self.trials += 1;
        let Some([lo, hi]) = interval else { return };
        self.given += 1;
        self.kept += u32::from(lo <= truth && truth <= hi);
        self.below += u32::from(hi < truth);
        self.width += (hi - lo) / truth.abs();
    }

    /// Share of the given intervals that held the truth.
    fn share(&self) -> f64 {
        f64::from(self.kept) / f64::from(self.given)
    }

    /// Three standard errors and a bit (one-sided level 0.001) of a share measured over these trials whose true value
    /// is `share`.
    fn slack(&self, share: f64) -> f64 {
        3.09 * (share * (1.0 - share) / f64::from(self.given)).sqrt()
    }

    /// Share given, coverage, share of intervals below the truth, and mean width over the truth.
    fn report(&self) -> String {
        let percent = |count: u32, of: u32| 100.0 * f64::from(count) / f64::from(of);
        format!(
            "given {:5.1} %  coverage {:5.1} %  below {:4.1} %  width {:.2}",
            percent(self.given, self.trials),
            100.0 * self.share(),
            percent(self.below, self.given),
            self.width / f64::from(self.given)
        )
    }
}
