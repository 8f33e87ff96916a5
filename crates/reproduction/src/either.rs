//! Values that a file may write in one of two ways.

use std::fmt;

use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};

/// A density along an axis.
#[derive(Clone, Debug)]
pub enum Density {
    /// `"uniform"`.
    Named(String),
    /// By its formulas.
    Given(Given),
}

/// A density by its formulas in the axis's name; the inverse in `xi`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Given {
    /// p; the derivative of F unless said.
    pub pdf: Option<String>,
    /// F.
    pub cdf: String,
    /// F⁻¹; found numerically unless said.
    pub inverse: Option<String>,
}

/// Receivers by place.
#[derive(Clone, Debug, PartialEq)]
pub enum At {
    /// Position and a normal of any length.
    Point([f64; 6]),
    /// A file with one in each line.
    File(String),
}

/// A camera of a scene, by name or number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CameraName(pub String);

impl<'de> Deserialize<'de> for Density {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(OfDensity)
    }
}

impl<'de> Deserialize<'de> for At {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(OfAt)
    }
}

impl<'de> Deserialize<'de> for CameraName {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(OfCamera)
    }
}

struct OfDensity;

impl<'de> Visitor<'de> for OfDensity {
    type Value = Density;

    fn expecting(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str("\"uniform\" or { cdf = \"…\" }")
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<Density, E> {
        Ok(Density::Named(word.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Density, A::Error> {
        Given::deserialize(MapAccessDeserializer::new(map)).map(Density::Given)
    }
}

struct OfAt;

impl<'de> Visitor<'de> for OfAt {
    type Value = At;

    fn expecting(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str("[x, y, z, nx, ny, nz] or \"@FILE.csv\"")
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<At, E> {
        match word.strip_prefix('@') {
            Some(path) if !path.is_empty() => Ok(At::File(path.to_owned())),
            _ => Err(E::custom(format!("\"{word}\" names no file of receivers; the form is \"@FILE.csv\""))),
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, numbers: A) -> Result<At, A::Error> {
        let numbers = Vec::deserialize(SeqAccessDeserializer::new(numbers))?;
        let wrong = |_| A::Error::custom("needs six numbers: [x, y, z, nx, ny, nz]");
        numbers.try_into().map(At::Point).map_err(wrong)
    }
}

struct OfCamera;

impl Visitor<'_> for OfCamera {
    type Value = CameraName;

    fn expecting(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str("a camera's name or number, or \"auto\"")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<CameraName, E> {
        Ok(CameraName(name.to_owned()))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<CameraName, E> {
        Ok(CameraName(number.to_string()))
    }
}
