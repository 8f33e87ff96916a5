//! What is asked of the light and where, as a command line or a file says it.

use std::f64::consts::PI;

use glam::DVec3;
use serde::Deserialize;

/// Where the light is measured, and what is asked there. Without any place: the scene's own receivers; without those, a grid
/// through its camera.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// What is asked.
    pub asked: Asked,
    /// Radiance without highlights.
    pub lambert: bool,
    /// Positions in metres and unit normals.
    pub points: Vec<(DVec3, DVec3)>,
    /// Receivers of the scene, by name.
    pub receivers: Vec<String>,
    /// What the centres of these pixels see.
    pub pixels: Vec<[u32; 2]>,
    /// What the centres of these cells of the image see.
    pub grid: Option<Grid>,
    /// ρ for radiance where no surface lies under a receiver.
    pub albedo: Option<Colour>,
    /// Who looks.
    pub camera: CameraChoice,
}

/// A part of a request that means nothing beside the rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Idle {
    /// An albedo, where irradiance is asked: it does not depend on a surface.
    Albedo,
    /// Leaving highlights out, where irradiance is asked.
    Lambert,
    /// The image's width or height, where neither pixels nor a grid look through it.
    Size,
    /// A camera of the scene, beside one that is given by numbers.
    Camera,
}

impl Request {
    /// What of it means nothing beside the rest, if anything.
    pub fn idle(&self) -> Option<Idle> {
        let irradiance = self.asked == Asked::Irradiance;
        let CameraChoice { camera, view, width, height } = &self.camera;
        let idle = [
            (Idle::Albedo, irradiance && self.albedo.is_some()),
            (Idle::Lambert, irradiance && self.lambert),
            (Idle::Size, (width.or(*height)).is_some() && self.pixels.is_empty() && self.grid.is_none()),
            (Idle::Camera, camera.is_some() && view.is_some()),
        ];
        idle.into_iter().find(|(_, is_idle)| *is_idle).map(|(idle, _)| idle)
    }
}

/// What is asked of the light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Asked {
    /// ∫ L_e cosθ dω: f_r = 1.
    #[default]
    Irradiance,
    /// ∫ L_e f_r cosθ dω toward the camera, with the surface's own emission.
    Radiance,
}

impl Asked {
    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Irradiance => "irradiance",
            Self::Radiance => "radiance",
        }
    }
}

/// Which camera looks, and how large its image is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CameraChoice {
    /// The scene's camera of this name or number, or `auto`; the first unless said.
    pub camera: Option<String>,
    /// A camera given by numbers, in place of the scene's.
    pub view: Option<Viewpoint>,
    /// Width of the image in pixels; from the height and the camera's aspect unless said.
    pub width: Option<u32>,
    /// Height of the image in pixels.
    pub height: Option<u32>,
}

/// Pixels on a side where nothing is said.
const DEFAULT_SIZE: u32 = 512;
/// Most pixels on a side.
pub const MOST_PIXELS: u32 = 65536;

impl CameraChoice {
    /// Width and height in pixels of the image for a camera of this aspect (width over height).
    pub fn size(&self, aspect: Option<f64>) -> [u32; 2] {
        let aspect = aspect.unwrap_or(1.0);
        let pixels = |size: f64| (size.round() as u32).clamp(1, MOST_PIXELS);
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

/// A camera at an eye that looks at a target, with a vertical field of view.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Vec<f64>")]
pub struct Viewpoint {
    /// World position in metres.
    pub eye: DVec3,
    /// What it looks at, in metres.
    pub target: DVec3,
    /// Vertical field of view in radians.
    pub field_of_view: f64,
}

impl TryFrom<Vec<f64>> for Viewpoint {
    type Error = String;

    fn try_from(numbers: Vec<f64>) -> Result<Self, String> {
        let seven = <[f64; 7]>::try_from(numbers);
        seven.map_err(|_| "needs seven numbers: an eye, what it looks at, and degrees".to_owned())?.try_into()
    }
}

impl TryFrom<[f64; 7]> for Viewpoint {
    type Error = String;

    /// Eye, target and the field of view in degrees.
    fn try_from(numbers: [f64; 7]) -> Result<Self, String> {
        let [ex, ey, ez, tx, ty, tz, degrees] = finite(numbers)?;
        let (eye, target, field_of_view) = (DVec3::new(ex, ey, ez), DVec3::new(tx, ty, tz), degrees.to_radians());
        if eye == target {
            return Err("the eye and what it looks at are the same point".into());
        }
        if !(field_of_view > 0.0 && field_of_view < PI) {
            return Err("the field of view must lie between 0 and 180 degrees".into());
        }
        Ok(Self { eye, target, field_of_view })
    }
}

/// Cells over a camera's image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "Vec<u32>")]
pub struct Grid(pub [u32; 2]);

/// Cells of the largest grid: each is a receiver with all its rows in memory.
const MOST_CELLS: u64 = 1 << 20;

impl TryFrom<Vec<u32>> for Grid {
    type Error = String;

    fn try_from(numbers: Vec<u32>) -> Result<Self, String> {
        <[u32; 2]>::try_from(numbers).map_err(|_| "needs two numbers: [columns, rows]".to_owned())?.try_into()
    }
}

impl TryFrom<[u32; 2]> for Grid {
    type Error = String;

    fn try_from([columns, rows]: [u32; 2]) -> Result<Self, String> {
        let cells = u64::from(columns) * u64::from(rows);
        let within = (1..=MOST_CELLS).contains(&cells);
        if within { Ok(Self([columns, rows])) } else { Err(format!("has {cells} cells; a grid has 1 to {MOST_CELLS}")) }
    }
}

/// An albedo, linear RGB, each between 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "GreyOrRgb")]
pub struct Colour(pub [f32; 3]);

#[derive(Deserialize)]
#[serde(untagged, expecting = "an albedo is one number, or [r, g, b]")]
enum GreyOrRgb {
    Grey(f64),
    Rgb([f64; 3]),
}

impl TryFrom<GreyOrRgb> for Colour {
    type Error = String;

    fn try_from(albedo: GreyOrRgb) -> Result<Self, String> {
        match albedo {
            GreyOrRgb::Grey(grey) => Self::try_from([grey; 3]),
            GreyOrRgb::Rgb(rgb) => Self::try_from(rgb),
        }
    }
}

impl TryFrom<[f64; 3]> for Colour {
    type Error = String;

    fn try_from(rgb: [f64; 3]) -> Result<Self, String> {
        let valid = rgb.iter().all(|c| (0.0..=1.0).contains(c));
        if valid { Ok(Self(rgb.map(|c| c as f32))) } else { Err("an albedo lies between 0 and 1".into()) }
    }
}

/// Position and unit normal of a receiver from x, y, z and a normal of any length.
///
/// # Errors
/// Where a number is not finite, or the normal has no direction.
pub fn point(numbers: [f64; 6]) -> Result<(DVec3, DVec3), String> {
    let [x, y, z, nx, ny, nz] = finite(numbers)?;
    let normal = DVec3::new(nx, ny, nz);
    let unit = (normal / normal.abs().max_element()).try_normalize().ok_or("the normal has no direction")?;
    Ok((DVec3::new(x, y, z), unit))
}

/// A share or a chance, neither nothing nor all.
///
/// # Errors
/// What is needed, where it is none.
pub fn share(number: f64) -> Result<f64, &'static str> {
    if 0.0 < number && number < 1.0 { Ok(number) } else { Err("needs a number between 0 and 1, such as 0.01") }
}

fn finite<const K: usize>(numbers: [f64; K]) -> Result<[f64; K], String> {
    match numbers.iter().find(|number| !number.is_finite()) {
        None => Ok(numbers),
        Some(number) => Err(format!("\"{number}\" is not a finite number")),
    }
}

#[cfg(test)]
mod tests {
    use super::{Asked, CameraChoice, Colour, Grid, Idle, Request, Viewpoint, point, share};
    use glam::DVec3;

    #[test]
    fn a_normal_may_have_any_length_but_none() {
        assert_eq!(point([-1.0, 2.0, -0.3, 0.0, 0.0, -7.0]), Ok((DVec3::new(-1.0, 2.0, -0.3), DVec3::NEG_Z)));
        assert_eq!(point([0.0, 0.0, 0.0, 1e-300, 0.0, 0.0]).map(|(_, n)| n), Ok(DVec3::X));
        assert!(point([0.0; 6]).is_err_and(|error| error.contains("no direction")));
        assert!(point([f64::NAN, 0.0, 0.0, 0.0, 0.0, 1.0]).is_err_and(|error| error.contains("finite")));
    }

    #[test]
    fn what_means_nothing_beside_the_rest_is_idle() {
        let (of_radiance, albedo) = (Request { asked: Asked::Radiance, ..Request::default() }, Colour([0.5; 3]));
        assert_eq!((Request::default().idle(), of_radiance.idle()), (None, None));
        let lit = |asked| Request { asked, albedo: Some(albedo), ..Request::default() };
        assert_eq!((lit(Asked::Irradiance).idle(), lit(Asked::Radiance).idle()), (Some(Idle::Albedo), None));
        let diffuse = |asked| Request { asked, lambert: true, ..Request::default() };
        assert_eq!((diffuse(Asked::Irradiance).idle(), diffuse(Asked::Radiance).idle()), (Some(Idle::Lambert), None));
        let sized = |camera: CameraChoice| Request { camera, ..Request::default() };
        let wide = sized(CameraChoice { width: Some(8), ..CameraChoice::default() });
        let high = sized(CameraChoice { height: Some(8), ..CameraChoice::default() });
        assert_eq!((wide.idle(), high.idle()), (Some(Idle::Size), Some(Idle::Size)));
        let gridded = Request { grid: Some(Grid([2, 2])), ..wide.clone() };
        assert_eq!((gridded.idle(), Request { pixels: vec![[0, 0]], ..wide }.idle()), (None, None));
        let view = Viewpoint::try_from([0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 40.0]).ok();
        let both = sized(CameraChoice { camera: Some("0".into()), view, ..CameraChoice::default() });
        assert_eq!(both.idle(), Some(Idle::Camera));
    }

    #[test]
    fn a_share_is_neither_nothing_nor_all() {
        assert_eq!(share(0.01), Ok(0.01));
        assert!([0.0, 1.0, -0.1, f64::NAN].into_iter().all(|number| share(number).is_err()));
    }

    #[test]
    fn grids_colours_and_views_have_limits() {
        assert_eq!(Grid::try_from([1024, 1024]), Ok(Grid([1024, 1024])));
        assert!(Grid::try_from([0, 3]).is_err() && Grid::try_from([1024, 1025]).is_err());
        assert_eq!(Colour::try_from([0.5; 3]), Ok(Colour([0.5; 3])));
        assert!(Colour::try_from([0.5, 2.0, 0.0]).is_err() && Colour::try_from([f64::NAN; 3]).is_err());
        let view = |z: f64, fov: f64| Viewpoint::try_from([0.0, 0.0, 0.0, 0.0, 0.0, z, fov]);
        assert!(view(1.0, 40.0).is_ok() && view(0.0, 40.0).is_err());
        assert!(view(1.0, 0.0).is_err() && view(1.0, 180.0).is_err());
    }
}
