//! EXR: the numbers themselves.

use std::fmt::Write;
use std::io::Cursor;
use std::path::Path;

use ::exr::error::Error;
use ::exr::image::write::WritableImage;
use ::exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image as ExrImage, Layer};
use ::exr::meta::attribute::{AttributeValue, LineOrder, Text};
use ::exr::meta::header::LayerAttributes;
use ::exr::prelude::Compression;

use crate::attributes;
use crate::error::ReportError;
use crate::file;
use crate::image::{Channel, Image, refused};
use crate::provenance::Provenance;

/// Writes `image` as one part of scanlines: ZIP of 16 lines, binary32, increasing Y, linear Rec. 709 primaries.
///
/// Attributes: `samplesPerPixel` (int), `renderTimeSeconds` (float, where the image has it), `twoforms:provenance`
/// (JSON text, ASCII) and `software`. Equal images give equal bytes.
///
/// # Errors
/// [`ReportError::File`] where `path` cannot be written, otherwise as [`Image::check`].
pub fn write_exr(path: &Path, image: &Image) -> Result<(), ReportError> {
    image.check()?;
    let bytes = encoded(image)?;
    file::save(path, |out| Ok(out.write_all(&bytes)?))
}

fn encoded(image: &Image) -> Result<Vec<u8>, ReportError> {
    let channels = AnyChannels::sort(image.channels.iter().map(channel).collect());
    let layer = Layer::new((image.width, image.height), layer_attributes(image)?, ENCODING, channels);
    let mut bytes = Cursor::new(Vec::new());
    ExrImage::from_layer(layer).write().to_buffered(&mut bytes).map_err(exr_error)?;
    attributes::sorted(bytes.get_ref()).ok_or_else(|| refused("its header is damaged".into(), "report this as a fault"))
}

const ENCODING: Encoding =
    Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };

fn channel(Channel { name, samples }: &Channel) -> AnyChannel<FlatSamples> {
    AnyChannel::new(name.as_str(), FlatSamples::F32(samples.clone()))
}

fn layer_attributes(image: &Image) -> Result<LayerAttributes, ReportError> {
    let samples = i32::try_from(image.samples_per_pixel)
        .map_err(|_| refused(format!("{} samples per pixel", image.samples_per_pixel), "stay below 2147483648"))?;
    let software_name = Some(text(&format!("twoforms {}", image.provenance.version)));
    let mut attributes = LayerAttributes { software_name, ..LayerAttributes::default() };
    let mut add = |name: &str, value| attributes.other.insert(Text::from(name), value);
    add("samplesPerPixel", AttributeValue::I32(samples));
    add("twoforms:provenance", AttributeValue::Text(provenance(&image.provenance)?));
    if let Some(seconds) = image.render_seconds {
        add("renderTimeSeconds", AttributeValue::F32(seconds as f32));
    }
    Ok(attributes)
}

/// The provenance as JSON text.
fn provenance(provenance: &Provenance) -> Result<Text, ReportError> {
    Ok(text(&serde_json::to_string(provenance).map_err(std::io::Error::from)?))
}

/// Text of an attribute, in ASCII: any other character as JSON escapes it, `\u00e9`.
fn text(text: &str) -> Text {
    let mut ascii = String::with_capacity(text.len());
    for unit in text.encode_utf16() {
        match u8::try_from(unit).ok().filter(u8::is_ascii) {
            Some(byte) => ascii.push(char::from(byte)),
            None => {
                let _ = write!(ascii, "\\u{unit:04x}");
            }
        }
    }
    Text::from(ascii.as_str())
}

fn exr_error(error: Error) -> ReportError {
    match error {
        Error::Io(cause) => cause.into(),
        other => refused(other.to_string(), "make it smaller or name its channels otherwise"),
    }
}
