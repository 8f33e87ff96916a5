//! Images: texels as their files hold them.

use std::sync::LazyLock;

/// An image: red, green, blue and alpha of each texel, in the integers of its file, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Name in the file, or its place there.
    pub name: String,
    /// Texels in a row, at least one.
    pub width: u32,
    /// Rows, at least one.
    pub height: u32,
    /// Row by row, four integers each.
    pub(crate) texels: Texels,
}

/// The integers of an image, four a texel.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Texels {
    Eight(Vec<u8>),
    Sixteen(Vec<u16>),
}

/// What the integers of an image mean. Alpha is linear in both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// c / (2ᵇ − 1).
    Linear,
    /// The transfer function of sRGB (IEC 61966-2-1).
    Srgb,
}

impl Image {
    /// The memory that it takes, in bytes.
    pub fn bytes(&self) -> usize {
        match &self.texels {
            Texels::Eight(texels) => texels.len(),
            Texels::Sixteen(texels) => 2 * texels.len(),
        }
    }

    /// The least alpha of its texels.
    pub(crate) fn least_alpha(&self) -> f32 {
        let least = match &self.texels {
            Texels::Eight(texels) => texels.iter().skip(3).step_by(4).min().map(|&c| EIGHT.linear[usize::from(c)]),
            Texels::Sixteen(texels) => texels.iter().skip(3).step_by(4).min().map(|&c| SIXTEEN.linear[usize::from(c)]),
        };
        least.unwrap_or(1.0)
    }

    /// The linear red, green, blue and alpha of the texel in column x and row y, which lie inside the image.
    pub(crate) fn texel(&self, x: usize, y: usize, encoding: Encoding) -> [f32; 4] {
        let at = 4 * (y * self.width as usize + x);
        match &self.texels {
            Texels::Eight(texels) => decoded(&texels[at..at + 4], &EIGHT, encoding),
            Texels::Sixteen(texels) => decoded(&texels[at..at + 4], &SIXTEEN, encoding),
        }
    }
}

/// What integers of one width stand for.
struct Table {
    linear: Vec<f32>,
    srgb: Vec<f32>,
}

static EIGHT: LazyLock<Table> = LazyLock::new(|| Table::new(u32::from(u8::MAX)));
static SIXTEEN: LazyLock<Table> = LazyLock::new(|| Table::new(u32::from(u16::MAX)));

impl Table {
    fn new(largest: u32) -> Self {
        let shares = || (0..=largest).map(|c| f64::from(c) / f64::from(largest));
        Self {
            linear: shares().map(|share| share as f32).collect(),
            srgb: shares().map(|share| linear(share) as f32).collect(),
        }
    }
}

fn decoded<C: Copy + Into<usize>>(texel: &[C], table: &Table, encoding: Encoding) -> [f32; 4] {
    let colour = match encoding {
        Encoding::Linear => &table.linear,
        Encoding::Srgb => &table.srgb,
    };
    let [red, green, blue] = std::array::from_fn(|channel| colour[texel[channel].into()]);
    [red, green, blue, table.linear[texel[3].into()]]
}

/// Linear light from the code value c of sRGB: c / 12.92 up to 0.04045, then ((c + 0.055) / 1.055)^2.4.
fn linear(code: f64) -> f64 {
    if code <= 0.04045 { code / 12.92 } else { libm::pow((code + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::{Encoding, Image, Texels};

    #[test]
    fn integers_are_decoded_and_alpha_is_linear() {
        let texels = Texels::Eight(vec![0, 0, 0, 0, 255, 10, 188, 51]);
        let image = Image { name: String::new(), width: 1, height: 2, texels };
        assert_eq!(image.texel(0, 0, Encoding::Srgb), [0.0; 4]);
        assert_eq!(image.texel(0, 1, Encoding::Linear), [1.0, 10.0 / 255.0, 188.0 / 255.0, 0.2]);
        let [red, green, blue, alpha] = image.texel(0, 1, Encoding::Srgb);
        assert_eq!((red, alpha), (1.0, 0.2));
        assert!((green - 10.0 / 255.0 / 12.92).abs() < 1e-9);
        assert!((blue - 0.502_886_5).abs() < 1e-6, "the standard's middle grey: {blue}");
    }

    /// The power law begins between 10 and 11 of 255.
    #[test]
    fn the_curve_of_srgb_has_two_parts() {
        for (code, expected) in [(10, 0.003_035_27), (11, 0.003_346_54), (64, 0.051_269_5), (128, 0.215_860_5)] {
            let image = Image { name: String::new(), width: 1, height: 1, texels: Texels::Eight(vec![code; 4]) };
            let [found, ..] = image.texel(0, 0, Encoding::Srgb);
            assert!((found / expected - 1.0).abs() < 1e-5, "{code}: {found}");
        }
    }

    #[test]
    fn sixteen_bits_are_the_same_scale() {
        let texels = Texels::Sixteen([0_u16, 17, 188, 255].map(|c| c * 257).to_vec());
        let wide = Image { name: String::new(), width: 1, height: 1, texels };
        let narrow = Image { texels: Texels::Eight(vec![0, 17, 188, 255]), ..wide.clone() };
        for encoding in [Encoding::Linear, Encoding::Srgb] {
            assert_eq!(wide.texel(0, 0, encoding), narrow.texel(0, 0, encoding));
        }
        assert_eq!([wide.bytes(), narrow.bytes()], [8, 4]);
    }
}
