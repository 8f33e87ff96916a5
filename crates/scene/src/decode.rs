//! PNG and JPEG, from bytes to texels.
//!
//! The decoders are `png` and `zune-jpeg`: both are safe against hostile bytes and take next to nothing with them.
//! Colour profiles and gamma in the files are not looked at, as glTF 2.0 has it (section 3.8.3).

use std::io::Cursor;

use png::{BitDepth, ColorType, Transformations};
use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;

use crate::image::Texels;

/// The most texels of one image: 8192 × 8192.
pub(crate) const LARGEST: u64 = 1 << 26;

/// An image without a name.
#[derive(Debug)]
pub(crate) struct Decoded {
    pub width: u32,
    pub height: u32,
    pub texels: Texels,
}

/// Why there is no image.
#[derive(Debug)]
pub(crate) enum Undecoded {
    /// Neither PNG nor JPEG.
    Format,
    /// Too many texels.
    Size(u64, u64),
    /// Broken, and how.
    Fault(String),
}

/// Decodes `bytes` by what they begin with, whatever the file calls them.
pub(crate) fn decode(bytes: &[u8]) -> Result<Decoded, Undecoded> {
    if bytes.starts_with(b"\x89PNG\r\n\x1A\n") {
        png(bytes)
    } else if bytes.starts_with(b"\xFF\xD8\xFF") {
        jpeg(bytes)
    } else {
        Err(Undecoded::Format)
    }
}

fn png(bytes: &[u8]) -> Result<Decoded, Undecoded> {
    let fault = |error: png::DecodingError| Undecoded::Fault(format!("is a broken PNG ({error})"));
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::EXPAND | Transformations::ALPHA);
    decoder.set_ignore_text_chunk(true);
    let (width, height) = decoder.read_header_info().map_err(fault)?.size();
    check(u64::from(width), u64::from(height))?;
    let mut reader = decoder.read_info().map_err(fault)?;
    let size = reader.output_buffer_size().ok_or(Undecoded::Size(width.into(), height.into()))?;
    let mut integers = vec![0; size];
    reader.next_frame(&mut integers).map_err(fault)?;
    reader.finish().map_err(fault)?;
    let texels = match reader.output_color_type() {
        (ColorType::Rgba, BitDepth::Sixteen) => Texels::Sixteen(sixteen(&integers)),
        (ColorType::Rgba, _) => Texels::Eight(integers),
        (ColorType::GrayscaleAlpha, BitDepth::Sixteen) => Texels::Sixteen(grey(&sixteen(&integers))),
        (ColorType::GrayscaleAlpha, _) => Texels::Eight(grey(&integers)),
        _ => return Err(Undecoded::Format),
    };
    Ok(Decoded { width, height, texels })
}

fn sixteen(bytes: &[u8]) -> Vec<u16> {
    bytes.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect()
}

/// Red, green, blue and alpha from grey and alpha.
fn grey<C: Copy>(integers: &[C]) -> Vec<C> {
    integers.chunks_exact(2).flat_map(|texel| [texel[0], texel[0], texel[0], texel[1]]).collect()
}

/// Strictly: what is cut short is broken, and not grey from there on.
fn jpeg(bytes: &[u8]) -> Result<Decoded, Undecoded> {
    let fault = |error: &dyn std::fmt::Display| Undecoded::Fault(format!("is a broken JPEG ({error})"));
    let options = DecoderOptions::default().set_strict_mode(true).jpeg_set_out_colorspace(ColorSpace::RGBA);
    let options = options.set_max_width(usize::from(u16::MAX)).set_max_height(usize::from(u16::MAX));
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|error| fault(&error))?;
    let (width, height) = decoder.dimensions().ok_or_else(|| fault(&"it has no size"))?;
    check(width as u64, height as u64)?;
    let texels = decoder.decode().map_err(|error| fault(&error))?;
    if texels.len() != 4 * width * height {
        return Err(fault(&"it does not have three colours"));
    }
    Ok(Decoded { width: width as u32, height: height as u32, texels: Texels::Eight(texels) })
}

/// Holds a size against the limit before anything of that size is made.
fn check(width: u64, height: u64) -> Result<(), Undecoded> {
    if width * height > LARGEST { Err(Undecoded::Size(width, height)) } else { Ok(()) }
}
