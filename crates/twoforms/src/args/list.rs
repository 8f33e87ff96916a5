//! Lists of names, in which commas within brackets belong to a name.

use std::fmt;
use std::str::FromStr;

use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_reproduction::stage::once;

/// Strategies, in the order given, each once.
#[derive(Clone, Debug, PartialEq)]
pub struct StrategyList(pub Vec<Strategy>);

/// Samplers, in the order given, each once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SamplerList(pub Vec<Sampler>);

impl Default for StrategyList {
    fn default() -> Self {
        Self(Strategy::defaults())
    }
}

impl FromStr for StrategyList {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        parsed(text).map(Self)
    }
}

impl FromStr for SamplerList {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        parsed(text).map(Self)
    }
}

impl fmt::Display for StrategyList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&joined(&self.0))
    }
}

impl fmt::Display for SamplerList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&joined(&self.0))
    }
}

fn joined(names: &[impl ToString]) -> String {
    names.iter().map(ToString::to_string).collect::<Vec<_>>().join(",")
}

/// What the names in a list stand for, each once.
fn parsed<T: Copy + PartialEq + FromStr<Err: fmt::Display>>(text: &str) -> Result<Vec<T>, String> {
    let one = |name: &str| match name {
        "" => Err("has an empty name: put one comma between names, and none at the ends".to_owned()),
        _ => name.parse().map_err(|error: T::Err| error.to_string()),
    };
    names(text).into_iter().map(one).collect::<Result<Vec<T>, String>>().map(|items| once(&items))
}

/// Splits at the commas outside brackets.
fn names(text: &str) -> Vec<&str> {
    let mut depth = 0_i32;
    let split = text.split(move |c| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        c == ',' && depth == 0
    });
    split.map(str::trim).collect()
}

#[cfg(test)]
mod tests {
    use super::{StrategyList, names};

    #[test]
    fn commas_in_brackets_belong_to_the_name() {
        assert_eq!(names("a,b(c:2,d:1), e"), ["a", "b(c:2,d:1)", "e"]);
    }

    #[test]
    fn a_strategy_named_twice_is_compared_once() {
        let list: Result<StrategyList, _> = "area/uniform,area/uniform".parse();
        assert_eq!(list.map(|list| list.0.len()), Ok(1));
    }

    #[test]
    fn an_empty_name_is_refused_as_such() {
        for text in ["", ",", "area/uniform,", ",area/uniform"] {
            assert!(text.parse::<StrategyList>().is_err_and(|error| error.contains("empty name")), "{text:?}");
        }
    }
}
