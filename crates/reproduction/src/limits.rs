//! Limits of numbers in a file, held where they are read, so that errors point at them.

use std::fmt::Display;

use serde::de::{Deserialize, Deserializer, Error};
use toml::Spanned;
use twoforms_comparison::request::{self, MOST_PIXELS};

/// Most replicates.
const MOST_REPLICATES: u32 = 100_000_000;

/// A value that is as it must be, or `needs` in the error.
fn kept<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    from: D,
    holds: impl Fn(&T) -> bool,
    needs: impl Display,
) -> Result<T, D::Error> {
    let value = T::deserialize(from)?;
    if holds(&value) { Ok(value) } else { Err(Error::custom(format!("needs {needs}"))) }
}

/// A seed: TOML's whole numbers have a sign.
pub(crate) fn seed<'de, D: Deserializer<'de>>(from: D) -> Result<u64, D::Error> {
    const MOST: u64 = i64::MAX as u64;
    let seed = u64::deserialize(from).ok().filter(|seed| *seed <= MOST);
    seed.ok_or_else(|| Error::custom(format!("needs a whole number from 0 to {MOST}")))
}

pub(crate) fn above_zero_always<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    kept(from, |&number: &f64| number > 0.0 && number.is_finite(), "a number above 0")
}

pub(crate) fn above_zero<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    above_zero_always(from).map(Some)
}

pub(crate) fn share<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    request::share(f64::deserialize(from)?).map(Some).map_err(Error::custom)
}

pub(crate) fn count<'de, D: Deserializer<'de>>(from: D) -> Result<Option<u32>, D::Error> {
    kept(from, |&count: &u32| count > 0, format!("a whole number from 1 to {}", u32::MAX)).map(Some)
}

pub(crate) fn counts<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Vec<u32>>, D::Error> {
    let needs = format!("whole numbers from 1 to {}, at least one", u32::MAX);
    kept(from, |counts: &Vec<u32>| !counts.is_empty() && counts.iter().all(|&count| count > 0), needs).map(Some)
}

pub(crate) fn replicates<'de, D: Deserializer<'de>>(from: D) -> Result<Option<u32>, D::Error> {
    let needs = format!("a whole number from 2 to {MOST_REPLICATES}");
    kept(from, |count| (2..=MOST_REPLICATES).contains(count), needs).map(Some)
}

pub(crate) fn side<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Spanned<u32>>, D::Error> {
    let needs = format!("a whole number from 1 to {MOST_PIXELS}");
    kept(from, |side: &Spanned<u32>| (1..=MOST_PIXELS).contains(side.get_ref()), needs).map(Some)
}

pub(crate) fn names<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Vec<Spanned<String>>>, D::Error> {
    kept(from, |names: &Vec<_>| !names.is_empty(), "at least one name; leave the key out for those by default")
        .map(Some)
}

/// Two numbers, no more: an array of two would be read from the first of many.
fn pair<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D, needs: &str) -> Result<[T; 2], D::Error> {
    let numbers = Vec::deserialize(from)?;
    numbers.try_into().map_err(|_| Error::custom(format!("needs {needs}")))
}

pub(crate) fn nested<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[u32; 2]>, D::Error> {
    const NEEDS: &str = "[outer, inner] of at least [2, 1]";
    let [outer, inner] = pair(from, NEEDS)?;
    if outer >= 2 && inner >= 1 { Ok(Some([outer, inner])) } else { Err(Error::custom(format!("needs {NEEDS}"))) }
}

pub(crate) fn interval<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[f64; 2]>, D::Error> {
    const NEEDS: &str = "[a', b'] with a' <= b'";
    let [low, high] = pair(from, NEEDS)?;
    if low <= high { Ok(Some([low, high])) } else { Err(Error::custom(format!("needs {NEEDS}"))) }
}

pub(crate) fn domain<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Vec<[f64; 2]>>, D::Error> {
    let sides = Vec::<Vec<f64>>::deserialize(from)?.into_iter().map(TryInto::try_into);
    sides.collect::<Result<_, _>>().map(Some).map_err(|_| Error::custom("needs [a, b] along each axis"))
}

/// Pairs of numbers, and where the file has them.
type Pairs = Spanned<Vec<[u32; 2]>>;

pub(crate) fn pixels<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Pairs>, D::Error> {
    let read = Spanned::<Vec<Vec<u32>>>::deserialize(from)?;
    let span = read.span();
    let pixels = read.into_inner().into_iter().map(TryInto::try_into).collect::<Result<_, _>>();
    let wrong = |_| Error::custom("needs pixels as [x, y] each");
    Ok(Some(Spanned::new(span, pixels.map_err(wrong)?)))
}
