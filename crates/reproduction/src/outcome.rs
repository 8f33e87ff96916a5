//! Rows of a reproduction: what was published, what is exact, what we measured, and what to make of it.

use serde::Serialize;

use crate::printed::Printed;

/// What is found about one quantity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Finding {
    /// The value without chance, with a bound of its error.
    pub exact: Option<[f64; 2]>,
    /// The value by chance, with its interval.
    pub measured: Option<Measured>,
    /// The quantity may be anything up to this.
    pub at_most: Option<f64>,
    /// What else is to be said.
    pub note: Option<String>,
}

/// A measured value and the interval that holds the true one, but for the row's share of the reproduction's level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// Its interval.
    pub interval: [f64; 2],
}

impl Measured {
    /// A value with a symmetric interval.
    pub fn around(value: f64, half_width: f64) -> Self {
        Self { value, interval: [value - half_width, value + half_width] }
    }

    fn half_width(&self) -> f64 {
        0.5 * (self.interval[1] - self.interval[0])
    }
}

/// What a row says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// What was measured holds what is exact, published or derived, in an interval narrow enough to notice a change.
    Agrees,
    /// Found without chance, and as published or derived where either is given.
    Exact,
    /// Something contradicts something.
    Differs,
    /// The interval is too wide to say.
    Undecided,
}

/// One row.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The experiment that it belongs to.
    pub experiment: String,
    /// What is asked.
    pub quantity: String,
    /// As the source prints it.
    pub published: Option<f64>,
    /// Without chance.
    pub exact: Option<f64>,
    /// By chance.
    pub measured: Option<f64>,
    /// The interval of what was measured.
    pub interval: Option<[f64; 2]>,
    /// What to make of it.
    pub verdict: Verdict,
    /// More in words.
    pub note: Option<String>,
    /// What was printed or derived, with how far it is rounded.
    #[serde(skip)]
    pub expected: [Option<Printed>; 2],
    /// What was found.
    #[serde(skip)]
    pub finding: Finding,
    /// The relative change that it must notice.
    #[serde(skip)]
    pub detects: f64,
}

impl Row {
    /// The row of a finding, judged. `expected` is what was published and what was derived.
    pub fn new(names: [String; 2], expected: [Option<Printed>; 2], finding: Finding, detects: f64) -> Self {
        let [experiment, quantity] = names;
        let mut row = Self {
            experiment,
            quantity,
            published: expected[0].map(|printed| printed.value),
            exact: finding.exact.map(|[value, _]| value),
            measured: finding.measured.map(|measured| measured.value),
            interval: finding.measured.map(|measured| measured.interval),
            verdict: Verdict::Undecided,
            note: finding.note.clone(),
            expected,
            finding,
            detects,
        };
        row.verdict = row.judged();
        row
    }

    fn judged(&self) -> Verdict {
        let expected = self.expected.iter().flatten();
        let [value, error] = self.finding.exact.unwrap_or([f64::NAN, 0.0]);
        let contradicted = |printed: &Printed| {
            let [low, high] = printed.interval();
            !value.is_nan() && !printed.covers(value) && (value + error < low || high < value - error)
        };
        if expected.clone().any(contradicted) {
            return Verdict::Differs;
        }
        let Some(measured) = self.finding.measured else {
            return if value.is_nan() { Verdict::Undecided } else { Verdict::Exact };
        };
        let [low, high] = measured.interval;
        if let Some(most) = self.finding.at_most {
            return if low <= most { Verdict::Agrees } else { Verdict::Differs };
        }
        let exact = (!value.is_nan()).then_some([value - error, value + error]);
        let references: Vec<[f64; 2]> = exact.into_iter().chain(expected.map(Printed::interval)).collect();
        if references.iter().any(|&[from, to]| to < low || high < from) {
            return Verdict::Differs;
        }
        let sharpest = references.iter().copied().min_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
        let [from, to] = sharpest.unwrap_or(measured.interval);
        let (reference, slack) = (0.5 * (from + to), 0.5 * (to - from));
        let narrow = measured.half_width() + slack <= self.widest() * reference.abs() || reference == 0.0;
        if narrow { Verdict::Agrees } else { Verdict::Undecided }
    }

    /// The widest relative half interval, that of the reference included, at which a change by `detects` is certain to be noticed while the interval holds the true
    /// value before it: 2h(1 + d) = d.
    fn widest(&self) -> f64 {
        self.detects / (2.0 * (1.0 + self.detects))
    }

    /// The same row, had the program's results, by chance and without, been larger by so much.
    pub fn perturbed(&self, relative: f64) -> Self {
        let factor = 1.0 + relative;
        let mut finding = self.finding.clone();
        // What is measured changes against what is exact; without a measurement, what is exact against what is printed.
        match &mut finding.measured {
            Some(measured) => {
                let interval = measured.interval.map(|end| end * factor);
                *measured = Measured { value: measured.value * factor, interval };
            }
            None => finding.exact = finding.exact.map(|[value, error]| [value * factor, error]),
        }
        Self::new([self.experiment.clone(), self.quantity.clone()], self.expected, finding, self.detects)
    }
}
