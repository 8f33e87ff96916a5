//! Cameras and images.

use clap::Args;
use twoforms_comparison::points::numbers;
use twoforms_comparison::request::{CameraChoice, MOST_PIXELS, Viewpoint};

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
    pub view: Option<Viewpoint>,
    /// Width of the image in pixels [default: from the height and the camera's aspect]
    #[arg(long, value_name = "PIXELS", allow_negative_numbers = true, value_parser = between::<u32>(1, MOST_PIXELS.into()))]
    pub width: Option<u32>,
    /// Height of the image in pixels; the camera's vertical field of view is kept [default: 512]
    #[arg(long, value_name = "PIXELS", allow_negative_numbers = true, value_parser = between::<u32>(1, MOST_PIXELS.into()))]
    pub height: Option<u32>,
}

impl CameraArgs {
    /// What they choose.
    pub fn choice(&self) -> CameraChoice {
        CameraChoice { camera: self.camera.clone(), view: self.view, width: self.width, height: self.height }
    }
}

/// A part of an image as fractions x0, x1, y0, y1 from the top left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CropWindow(pub [f64; 4]);

pub(super) fn crop(text: &str) -> Result<CropWindow, String> {
    let window @ [x0, x1, y0, y1] = numbers(text, "x0,x1,y0,y1")?;
    let within = window.iter().all(|f| (0.0..=1.0).contains(f));
    let ordered = x0 < x1 && y0 < y1;
    if within && ordered { Ok(CropWindow(window)) } else { Err("needs 0 <= x0 < x1 <= 1 and 0 <= y0 < y1 <= 1".into()) }
}

fn view(text: &str) -> Result<Viewpoint, String> {
    Viewpoint::try_from(numbers(text, "ex,ey,ez,tx,ty,tz,fov")?)
}
