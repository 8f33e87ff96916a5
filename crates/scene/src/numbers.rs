//! Numbers in buffers: little-endian components and what glTF lets them be.

use std::fmt::{self, Display};

use gltf::json::accessor::ComponentType;
use gltf::json::accessor::ComponentType::{F32, I8, I16, U8, U16, U32};

/// The integers that may stand for the numbers of an attribute, beside binary32.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Integers {
    /// None.
    Refused,
    /// Of 8 and 16 bits, normalised or taken as they are.
    Small,
    /// Signed, of 8 and 16 bits, normalised.
    Normalized,
    /// Unsigned, of 8 and 16 bits, normalised.
    Unsigned,
}

impl Integers {
    /// Whether a component of this type is binary32 or an integer that may stand for it.
    pub fn allow(self, component: ComponentType, normalized: bool) -> bool {
        match component {
            F32 => true,
            I8 | I16 => matches!(self, Self::Small) || matches!(self, Self::Normalized) && normalized,
            U8 | U16 => matches!(self, Self::Small) || matches!(self, Self::Unsigned) && normalized,
            U32 => false,
        }
    }
}

impl Display for Integers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Refused => "binary32",
            Self::Small => "binary32 or integers of 8 or 16 bits",
            Self::Normalized => "binary32 or normalized signed integers of 8 or 16 bits",
            Self::Unsigned => "binary32 or normalized unsigned integers of 8 or 16 bits",
        })
    }
}

/// The number in `bytes`, one component of this type. Normalised integers follow glTF 2.0, section 3.11:
/// f = c / (2ᵇ − 1) unsigned, f = max(c / (2ᵇ⁻¹ − 1), −1) signed.
pub(crate) fn number(bytes: &[u8], component: ComponentType, normalized: bool) -> f32 {
    let (value, largest) = match (component, bytes) {
        (F32, &[a, b, c, d]) => return f32::from_le_bytes([a, b, c, d]),
        (I8, &[a]) => (f32::from(a as i8), f32::from(i8::MAX)),
        (I16, &[a, b]) => (f32::from(i16::from_le_bytes([a, b])), f32::from(i16::MAX)),
        (U8, _) => (integer(bytes) as f32, f32::from(u8::MAX)),
        _ => (integer(bytes) as f32, f32::from(u16::MAX)),
    };
    if normalized { (value / largest).max(-1.0) } else { value }
}

/// The unsigned integer in up to four bytes.
pub(crate) fn integer(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte))
}

#[cfg(test)]
mod tests {
    use gltf::json::accessor::ComponentType::{F32, I8, I16, U8, U16};

    use super::{integer, number};

    #[test]
    fn integers_are_little_endian() {
        assert_eq!([integer(&[7]), integer(&[1, 2]), integer(&[1, 2, 3, 4])], [7, 513, 67_305_985]);
    }

    #[test]
    fn numbers_are_taken_as_they_are_or_normalised() {
        assert_eq!(number(&1.5_f32.to_le_bytes(), F32, false), 1.5);
        assert_eq!([number(&[0x80], I8, false), number(&[0x80], I8, true)], [-128.0, -1.0]);
        assert_eq!([number(&[0xFF], U8, false), number(&[0xFF], U8, true)], [255.0, 1.0]);
        let short = (-300_i16).to_le_bytes();
        assert_eq!([number(&short, I16, false), number(&short, I16, true)], [-300.0, -300.0 / 32767.0]);
        assert_eq!(number(&[0, 0x80], U16, true), 32768.0 / 65535.0);
    }
}
