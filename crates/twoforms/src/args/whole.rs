//! Whole numbers within limits.

/// A parser of whole numbers from `least` to `most`, which `T` can hold.
pub(super) fn between<T: TryFrom<u64>>(least: u64, most: u64) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| {
        let within = text.trim().parse().ok().filter(|number| (least..=most).contains(number));
        let number = within.and_then(|number| T::try_from(number).ok());
        number.ok_or_else(|| format!("needs a whole number from {least} to {most}"))
    }
}

#[cfg(test)]
mod tests {
    use super::between;

    #[test]
    fn numbers_within_the_limits_are_read_and_all_else_is_refused_with_them() {
        let count = between::<u32>(1, 10);
        assert_eq!([count("1"), count(" 10 ")], [Ok(1), Ok(10)]);
        for text in ["0", "11", "-1", "1.5", "1e1", "", "x", "99999999999999999999"] {
            assert_eq!(count(text), Err("needs a whole number from 1 to 10".into()), "{text}");
        }
    }
}
