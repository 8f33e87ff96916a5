//! Numbers as a source prints them.

/// A number with as many digits as were printed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Printed {
    /// The number.
    pub value: f64,
    /// How far the number that was printed may lie from it, below and above.
    pub slack: [f64; 2],
    /// How many digits it was printed with, from the first that is not zero; none where it was computed.
    pub digits: usize,
}

impl Printed {
    /// The number in `text`, which was rounded to its last digit, or cut off there; `None` where it is none.
    ///
    /// ```
    /// use twoforms_reproduction::printed::Printed;
    ///
    /// let variance = Printed::read("0.916", true).expect("a number");
    /// assert!(variance.covers(11.0 / 12.0));
    /// assert!(!Printed::read("0.916", false).expect("a number").covers(11.0 / 12.0));
    /// ```
    pub fn read(text: &str, truncated: bool) -> Option<Self> {
        let value: f64 = text.trim().parse().ok().filter(|value: &f64| value.is_finite())?;
        let (mantissa, exponent) = text.trim().split_once(['e', 'E']).unwrap_or((text.trim(), "0"));
        let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        let unit = 10_f64.powi(exponent.parse::<i32>().ok()? - i32::try_from(decimals).ok()?);
        let half = 0.5 * unit;
        let slack = match (truncated, value < 0.0) {
            (false, _) => [half, half],
            (true, false) => [0.0, unit],
            (true, true) => [unit, 0.0],
        };
        let digits = mantissa.chars().filter(char::is_ascii_digit).skip_while(|&digit| digit == '0').count();
        Some(Self { value, slack, digits })
    }

    /// A number that was computed to the last digits of binary64.
    pub fn computed(value: f64) -> Self {
        Self { value, slack: [ROUNDING * value.abs(); 2], digits: 0 }
    }

    /// The same number where its source says that it may be off by so much.
    pub fn within(self, error: f64) -> Self {
        Self { slack: self.slack.map(|slack| slack.max(error)), ..self }
    }

    /// Whether a number may have been printed so, but for the last bits of its own.
    pub fn covers(&self, number: f64) -> bool {
        let rounding = 1e-9 * (self.slack[0] + self.slack[1]);
        (self.value - self.slack[0] - rounding..=self.value + self.slack[1] + rounding).contains(&number)
    }

    /// The interval that it stands for.
    pub fn interval(&self) -> [f64; 2] {
        [self.value - self.slack[0], self.value + self.slack[1]]
    }
}

/// What the operations of a formula may round, relatively.
const ROUNDING: f64 = 1e-14;
