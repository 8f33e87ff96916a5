//! Numbers for people.

/// What stands for a value that is not there.
pub(crate) const NONE: &str = "–";

/// Four significant digits: `0.1234`, `1234`, `12340`; in powers of ten below 10⁻³ and from 10⁵ on: `1.234e-7`.
pub(crate) fn significant(value: f64) -> String {
    rounded(value, 4)
}

/// `digits` significant digits, written like [`significant`].
pub(crate) fn rounded(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.*e}", digits - 1);
    match exponent(value, digits) {
        exponent @ -3..5 => fixed(value, (digits as i32 - 1 - exponent).max(0)),
        _ => scientific,
    }
}

/// Like [`significant`], without zeros at the end of a fraction.
pub(crate) fn short(value: f64) -> String {
    let text = significant(value);
    if text.contains('.') && !text.contains('e') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// A whole number in full below 10⁹, else [`significant`].
pub(crate) fn count(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e9 { format!("{value:.0}") } else { significant(value) }
}

/// A share in percent, two significant digits: `3.1 %`.
pub(crate) fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let text = if percent == 0.0 { "0".to_owned() } else { fixed(percent, 1 - exponent(percent, 2)) };
    format!("{text} %")
}

/// Seconds in the unit that suits, three significant digits: `12.3 µs`.
pub(crate) fn duration(seconds: f64) -> String {
    let (unit, scale) = match seconds {
        s if s < 1e-6 => ("ns", 1e9),
        s if s < 1e-3 => ("µs", 1e6),
        s if s < 1.0 => ("ms", 1e3),
        _ => ("s", 1.0),
    };
    format!("{} {unit}", rounded(seconds * scale, 3))
}

/// A value with its uncertainty, both to the uncertainty's first digit (its second too, where the first is a one):
/// `41 ± 2`, `0.96 ± 0.13`; from 10⁶ on `(1.23 ± 0.05)e7`.
pub(crate) fn plus_minus(value: f64, half: f64) -> String {
    if value.abs() >= 1e6 {
        let power = exponent(value, 4);
        let scale = 10f64.powi(power);
        return format!("({})e{power}", plus_minus(value / scale, half / scale));
    }
    if half == 0.0 {
        return format!("{} ± 0", significant(value));
    }
    let first = exponent(half, 1);
    let places = if half / 10f64.powi(first) < 1.95 { 1 - first } else { -first };
    format!("{} ± {}", fixed(value, places), fixed(half, places))
}

/// `value` rounded to `places` after the point; negative ones round to tens, hundreds, …
fn fixed(value: f64, places: i32) -> String {
    let unit = 10f64.powi(-places);
    match usize::try_from(places) {
        Ok(places) => format!("{value:.places$}"),
        Err(_) => format!("{:.0}", (value / unit).round() * unit),
    }
}

/// The power of ten of `value` once rounded to `digits` significant digits.
fn exponent(value: f64, digits: usize) -> i32 {
    let scientific = format!("{value:.*e}", digits - 1);
    scientific.split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_significant_digits() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1.000"),
            (0.999_96, "1.000"),
            (-0.012_345_6, "-0.01235"),
            (0.000_999_96, "0.001000"),
            (0.000_999_94, "9.999e-4"),
            (12_345.6, "12346"),
            (99_999.9, "1.000e5"),
            (1.5e-300, "1.500e-300"),
        ] {
            assert_eq!(significant(value), text);
        }
        assert_eq!([short(0.25), short(100.0), short(0.0), short(2e-9)], ["0.25", "100", "0", "2.000e-9"]);
        assert_eq!([count(1024.0), count(1987.34), count(0.5)], ["1024", "1987", "0.5000"]);
    }

    #[test]
    fn shares_and_times() {
        assert_eq!([percent(0.0), percent(0.031_2), percent(0.1), percent(1.234)], ["0 %", "3.1 %", "10 %", "120 %"]);
        assert_eq!([duration(0.0), duration(12.34e-9), duration(9.999e-6)], ["0 ns", "12.3 ns", "10.0 µs"]);
        assert_eq!([duration(0.5), duration(1234.0)], ["500 ms", "1234 s"]);
    }

    #[test]
    fn a_value_has_the_digits_that_its_uncertainty_allows() {
        for (value, half, text) in [
            (41.234, 2.1, "41 ± 2"),
            (41.234, 1.42, "41.2 ± 1.4"),
            (0.9612, 0.0312, "0.96 ± 0.03"),
            (41_234.0, 2100.0, "41000 ± 2000"),
            (41_234.0, 1420.0, "41200 ± 1400"),
            (5.0, 0.96, "5.0 ± 1.0"),
            (12_345_678.0, 500_000.0, "(1.23 ± 0.05)e7"),
        ] {
            assert_eq!(plus_minus(value, half), text);
        }
    }
}
