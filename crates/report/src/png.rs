//! An 8-bit sRGB preview.

use std::path::Path;

use ::png::{BitDepth, ColorType, Encoder, EncodingError, SrgbRenderingIntent};

use crate::error::ReportError;
use crate::file;
use crate::image::{Image, refused};

/// Writes R, G and B of `image` as an 8-bit sRGB PNG at exposure 0: 1.0 is white.
///
/// It is for looking at, not for measuring: values above 1 are shown as white and those below 0 as black. The numbers
/// themselves are in the EXR file.
///
/// # Errors
/// [`ReportError::File`] where `path` cannot be written, otherwise as [`Image::check`].
pub fn write_png(path: &Path, image: &Image) -> Result<(), ReportError> {
    image.check()?;
    let too_large = |_| refused(format!("{} × {} pixels", image.width, image.height), "make it smaller");
    let (width, height) =
        (u32::try_from(image.width).map_err(too_large)?, u32::try_from(image.height).map_err(too_large)?);
    let pixels = pixels(image)?;
    file::save(path, |out| {
        let mut encoder = Encoder::new(out, width, height);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
        let written =
            encoder.write_header().and_then(|mut png| png.write_image_data(&pixels).and_then(|()| png.finish()));
        written.map_err(encoding_error)
    })
}

/// RGB bytes, row by row.
fn pixels(image: &Image) -> Result<Vec<u8>, ReportError> {
    let [r, g, b] = image.rgb()?;
    let pixel = |((r, g), b): ((&f32, &f32), &f32)| [*r, *g, *b].map(srgb_byte);
    Ok(r.iter().zip(g).zip(b).flat_map(pixel).collect())
}

/// A linear value as a byte of sRGB.
fn srgb_byte(linear: f32) -> u8 {
    (255.0 * srgb(f64::from(linear).clamp(0.0, 1.0))).round() as u8
}

/// The transfer function of sRGB (IEC 61966-2-1): 12.92 c up to c = 0.0031308, then 1.055 c^(1/2.4) − 0.055.
fn srgb(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

fn encoding_error(error: EncodingError) -> ReportError {
    match error {
        EncodingError::IoError(cause) => cause.into(),
        other => refused(other.to_string(), "make it smaller"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transfer_function_joins_up_and_saturates() {
        assert!((srgb(0.003_130_8) - srgb(0.003_130_800_001)).abs() < 1e-7);
        // 0.5 linear is byte 188, 0.18 (mid grey) is 118: IEC 61966-2-1 by hand.
        assert_eq!([0.0, 0.002, 0.18, 0.5, 1.0].map(srgb_byte), [0, 7, 118, 188, 255]);
        assert_eq!([-1.0, 17.0].map(srgb_byte), [0, 255]);
    }
}
