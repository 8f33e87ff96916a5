//! Many tests that shall hold together.

use twoforms_comparison::statistics::sidak;

/// What came of one test.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It was made.
    Tested {
        /// The probability of what was seen, or of something less likely, if the hypothesis holds.
        p: f64,
        /// All that led to it, in one line.
        evidence: String,
    },
    /// It could not be made.
    Skipped {
        /// Why, in one line.
        why: String,
    },
}

/// Tests of one kind at a familywise level: if all hypotheses hold, the probability that any test of the family rejects
/// is at most the level. Each is made at the level of Šidák 1967.
#[derive(Clone, Debug)]
pub struct Family {
    name: &'static str,
    level: f64,
    seed: u64,
    outcomes: Vec<Outcome>,
}

impl Family {
    /// The outcomes of tests whose random numbers come from `seed`.
    pub fn new(name: &'static str, level: f64, seed: u64, outcomes: Vec<Outcome>) -> Self {
        Self { name, level, seed, outcomes }
    }

    /// Number of tests made.
    pub fn tested(&self) -> usize {
        self.outcomes.len() - self.skipped()
    }

    /// Number of tests that could not be made.
    pub fn skipped(&self) -> usize {
        self.outcomes.iter().filter(|outcome| matches!(outcome, Outcome::Skipped { .. })).count()
    }

    /// Level of each test.
    pub fn level_of_each(&self) -> f64 {
        sidak(self.level, self.tested())
    }

    /// The evidence of each test that rejects its hypothesis; one whose p is not a number rejects.
    pub fn rejected(&self) -> Vec<&str> {
        let each = self.level_of_each();
        let evidence = |outcome| match outcome {
            &Outcome::Tested { p, ref evidence } if p.is_nan() || p <= each => Some(evidence.as_str()),
            _ => None,
        };
        self.outcomes.iter().filter_map(evidence).collect()
    }

    /// One line: the family's name, level, seed and numbers, and the smallest p.
    pub fn summary(&self) -> String {
        let Self { name, level, seed, .. } = self;
        let (tested, skipped, each) = (self.tested(), self.skipped(), self.level_of_each());
        let p = self.outcomes.iter().map(|o| if let Outcome::Tested { p, .. } = o { *p } else { 1.0 });
        let least = p.fold(1.0, f64::min);
        format!(
            "{name}: {tested} tests at familywise level {level} ({each:.2e} each), seed {seed}, {skipped} skipped, smallest p = {least:.2e}"
        )
    }

    /// Prints the summary and what was skipped.
    ///
    /// # Panics
    /// With the evidence, if any test rejects; or if more than one test in `most_skipped` was skipped.
    pub fn assert_holds(&self, most_skipped: f64) {
        println!("{}", self.summary());
        for outcome in &self.outcomes {
            if let Outcome::Skipped { why } = outcome {
                println!("  skipped: {why}");
            }
        }
        let share = self.skipped() as f64 / self.outcomes.len().max(1) as f64;
        assert!(self.tested() > 0 && share <= most_skipped, "{}", self.summary());
        let rejected = self.rejected();
        assert!(rejected.is_empty(), "{}\n{} rejected:\n{}", self.summary(), rejected.len(), rejected.join("\n"));
    }
}

#[cfg(test)]
mod tests {
    use super::{Family, Outcome};

    fn family(p_values: &[f64]) -> Family {
        let tested = p_values.iter().map(|&p| Outcome::Tested { p, evidence: p.to_string() });
        let skipped = Outcome::Skipped { why: String::new() };
        Family::new("numbers", 0.1, 0, tested.chain([skipped]).collect())
    }

    #[test]
    fn rejects_at_the_level_of_each() {
        let each = 1.0 - libm::sqrt(0.9);
        let family = family(&[each * 1.001, each * 0.999]);
        assert!((family.level_of_each() - each).abs() < 1e-15);
        assert_eq!(family.rejected().len(), 1);
        assert_eq!((family.tested(), family.skipped()), (2, 1));
    }

    #[test]
    fn what_is_not_a_number_is_rejected() {
        assert_eq!(family(&[f64::NAN]).rejected(), ["NaN"]);
    }

    #[test]
    #[should_panic(expected = "1 rejected")]
    fn a_rejection_panics() {
        family(&[0.5, 1e-9]).assert_holds(0.5);
    }

    #[test]
    #[should_panic(expected = "1 skipped")]
    fn too_many_skipped_panics() {
        family(&[0.5]).assert_holds(0.4);
    }
}
