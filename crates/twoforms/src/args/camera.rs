//! Cameras and images.

use clap::Args;

use super::whole::between;

/// Which camera looks, and how large its image is.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Camera")]
pub struct CameraArgs {
    /// The scene's camera of this name or number, or auto: the whole scene from outside [default: the first, if any]
    #[arg(long, value_name = "NAME|INDEX|auto", conflicts_with = "view")]
    pub camera: Option<String>,
    /// A camera at e that looks at t (metres), with a vertical field of view in degrees
    #[arg(long, value_name = "EX,EY,EZ,TX,TY,TZ,FOV", allow_hyphen_values = true, value_parser = view)]
    pub view: Option<[f64; 7]>,
    /// Width of the image in pixels [default: from the height and the camera's aspect]
    #[arg(long, value_name = "PIXELS", allow_negative_numbers = true, value_parser = between::<u32>(1, 65536))]
    pub width: Option<u32>,
    /// Height of the image in pixels; the camera's vertical field of view is kept [default: 512]
    #[arg(long, value_name = "PIXELS", allow_negative_numbers = true, value_parser = between::<u32>(1, 65536))]
    pub height: Option<u32>,
}

/// Width and height in pixels.
pub type ImageSize = [u32; 2];

/// Pixels on a side where nothing is said.
const DEFAULT_SIZE: u32 = 512;

impl CameraArgs {
    /// The size of the image for a camera of this aspect (width over height).
    pub fn size(&self, aspect: Option<f64>) -> ImageSize {
        let aspect = aspect.unwrap_or(1.0);
        let pixels = |size: f64| (size.round() as u32).clamp(1, 65536);
        match (self.width, self.height) {
            (Some(width), Some(height)) => [width, height],
            (Some(width), None) => [width, pixels(f64::from(width) / aspect)],
            (None, height) => {
                let height = height.unwrap_or(DEFAULT_SIZE);
                [pixels(f64::from(height) * aspect), height]
            }
        }
    }
}

/// A part of an image as fractions x0, x1, y0, y1 from the top left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CropWindow(pub [f64; 4]);

pub(super) fn crop(text: &str) -> Result<CropWindow, String> {
    let window @ [x0, x1, y0, y1] = super::receivers::numbers(text, "x0,x1,y0,y1")?;
    let within = window.iter().all(|f| (0.0..=1.0).contains(f));
    let ordered = x0 < x1 && y0 < y1;
    if within && ordered { Ok(CropWindow(window)) } else { Err("needs 0 <= x0 < x1 <= 1 and 0 <= y0 < y1 <= 1".into()) }
}

fn view(text: &str) -> Result<[f64; 7], String> {
    let view: [f64; 7] = super::receivers::numbers(text, "ex,ey,ez,tx,ty,tz,fov")?;
    if view[..3] == view[3..6] {
        return Err("the eye and what it looks at are the same point".into());
    }
    if !(view[6] > 0.0 && view[6] < 180.0) {
        return Err("the field of view must lie between 0 and 180 degrees".into());
    }
    Ok(view)
}
