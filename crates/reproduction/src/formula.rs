//! Formulas in text, as functions of named numbers.

use std::collections::BTreeMap;

use exmex::{Differentiate, Express, FlatEx};

/// A formula of the axes' coordinates; other names are constants.
#[derive(Clone, Debug)]
pub struct Formula {
    expression: FlatEx<f64>,
    /// For each of the expression's names, in its order: an axis, or a constant's value.
    names: Vec<Name>,
}

#[derive(Clone, Copy, Debug)]
enum Name {
    Axis(usize),
    Constant(f64),
}

impl Formula {
    /// The formula in `text`, of `axes` and `constants`.
    ///
    /// # Errors
    /// Where it is none, or has names that are neither.
    pub fn new(text: &str, axes: &[String], constants: &BTreeMap<String, f64>) -> Result<Self, String> {
        let expression = FlatEx::<f64>::parse(text).map_err(|error| format!("\"{text}\" is no formula: {error}"))?;
        Self::of(expression, axes, constants)
    }

    fn of(expression: FlatEx<f64>, axes: &[String], constants: &BTreeMap<String, f64>) -> Result<Self, String> {
        let named = |name: &String| {
            let axis = axes.iter().position(|axis| axis == name).map(Name::Axis);
            let known = axis.or_else(|| constants.get(name).copied().map(Name::Constant));
            known.ok_or_else(|| {
                let names = axes.iter().chain(constants.keys()).cloned().collect::<Vec<_>>().join(", ");
                format!("\"{name}\" is neither an axis nor a constant: there are {names}; give others under constants")
            })
        };
        let names = expression.var_names().iter().map(named).collect::<Result<_, _>>()?;
        Ok(Self { expression, names })
    }

    /// The derivative with respect to an axis.
    ///
    /// # Errors
    /// Where a function in it has none.
    pub fn derivative(&self, axis: &str, axes: &[String], constants: &BTreeMap<String, f64>) -> Result<Self, String> {
        let position = self.expression.var_names().iter().position(|name| name == axis);
        let derived = match position {
            Some(index) => self.expression.clone().partial(index),
            None => FlatEx::parse("0"),
        };
        let derived = derived.map_err(|error| format!("it has no derivative: {error}"))?;
        Self::of(derived, axes, constants)
    }

    /// Its value at a point; NaN where it has none.
    pub fn at(&self, point: &[f64]) -> f64 {
        let value = |name: &Name| match *name {
            Name::Axis(axis) => point[axis],
            Name::Constant(value) => value,
        };
        let mut values = [0.0; MOST_NAMES];
        let Some(values) = values.get_mut(..self.names.len()) else { return f64::NAN };
        self.names.iter().zip(&mut *values).for_each(|(name, slot)| *slot = value(name));
        self.expression.eval(values).unwrap_or(f64::NAN)
    }
}

/// Most names in a formula.
const MOST_NAMES: usize = 16;

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::Formula;

    #[test]
    fn names_are_axes_or_constants_in_any_order() {
        let axes = ["y".to_owned(), "x".to_owned()];
        let constants = BTreeMap::from([("h".to_owned(), 3.0)]);
        let formula = Formula::new("5*x^4 + h*y", &axes, &constants).expect("a formula");
        assert_eq!(formula.at(&[2.0, 1.0]), 11.0);
        assert_eq!(formula.derivative("x", &axes, &constants).expect("one").at(&[0.0, 1.0]), 20.0);
        assert!(Formula::new("5*z", &axes, &constants).expect_err("no z").contains("\"z\" is neither"));
        assert!(Formula::new("5*(x", &axes, &constants).is_err());
    }
}
