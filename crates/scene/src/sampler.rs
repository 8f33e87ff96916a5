//! Samplers: which texels stand around a point of an image.

use gltf::json::texture::{MagFilter, Sampler as Json, WrappingMode};
use gltf::json::validation::Checked::{self, Valid};

/// What lies beyond the edge of an image, along one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// The image again, every second one turned around.
    Mirrored,
    /// Its last texel.
    Clamp,
}

/// What lies between the centres of texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The bilinear map between the four around.
    #[default]
    Linear,
    /// The nearest one.
    Nearest,
}

/// How an image is looked up: glTF's sampler, its `magFilter`. Images are not reduced: `minFilter` is not looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sampler {
    /// Along the rows and along the columns.
    pub wrap: [Wrap; 2],
    /// Between texels.
    pub filter: Filter,
}

impl Sampler {
    /// The file's sampler; `None` where a value is none of glTF's.
    pub(crate) fn read(sampler: &Json) -> Option<Self> {
        let filter = match sampler.mag_filter {
            None | Some(Valid(MagFilter::Linear)) => Filter::Linear,
            Some(Valid(MagFilter::Nearest)) => Filter::Nearest,
            Some(Checked::Invalid) => return None,
        };
        Some(Self { wrap: [wrap(sampler.wrap_s)?, wrap(sampler.wrap_t)?], filter })
    }
}

fn wrap(mode: Checked<WrappingMode>) -> Option<Wrap> {
    match mode {
        Valid(WrappingMode::Repeat) => Some(Wrap::Repeat),
        Valid(WrappingMode::MirroredRepeat) => Some(Wrap::Mirrored),
        Valid(WrappingMode::ClampToEdge) => Some(Wrap::Clamp),
        Checked::Invalid => None,
    }
}

impl Wrap {
    /// The texel of `count` that stands at the whole number `i`, inside the image or beyond.
    pub(crate) fn index(self, i: f64, count: u32) -> usize {
        let n = f64::from(count);
        if (0.0..n).contains(&i) {
            return i as usize;
        }
        let inside = match self {
            Self::Repeat => i.rem_euclid(n),
            Self::Mirrored => {
                let turned = i.rem_euclid(2.0 * n);
                if turned < n { turned } else { 2.0 * n - 1.0 - turned }
            }
            Self::Clamp => i.clamp(0.0, n - 1.0),
        };
        inside as usize
    }
}

#[cfg(test)]
mod tests {
    use super::Wrap;

    #[test]
    fn edges_repeat_turn_around_or_last() {
        let row = |wrap: Wrap| [-7, -4, -3, -1, 0, 2, 3, 5, 6, 8].map(|i| wrap.index(f64::from(i), 3));
        assert_eq!(row(Wrap::Repeat), [2, 2, 0, 2, 0, 2, 0, 2, 0, 2]);
        assert_eq!(row(Wrap::Mirrored), [0, 2, 2, 0, 0, 2, 2, 0, 0, 2]);
        assert_eq!(row(Wrap::Clamp), [0, 0, 0, 0, 0, 2, 2, 2, 2, 2]);
    }

    #[test]
    fn no_place_is_too_far() {
        for wrap in [Wrap::Repeat, Wrap::Mirrored, Wrap::Clamp] {
            for far in [1e300, -1e300, 9e15, -9e15, f64::MAX] {
                assert!(wrap.index(far, 7) < 7);
            }
        }
    }
}
