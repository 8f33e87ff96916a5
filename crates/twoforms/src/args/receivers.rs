//! Receivers: where the light is measured.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use glam::DVec3;

/// Where the light is measured: any mixture of these. Without any, the scene's own receivers; without those, an 8×8 grid
/// through its camera.
#[derive(Clone, Debug, Default, PartialEq, Args)]
#[command(next_help_heading = "Receivers")]
pub struct ReceiverArgs {
    /// A position and a normal in metres, or @FILE.csv with one of them in each line (repeatable)
    #[arg(long, value_name = "X,Y,Z,NX,NY,NZ", allow_hyphen_values = true)]
    pub at: Vec<At>,
    /// A named receiver of the scene (repeatable)
    #[arg(long, value_name = "NAME")]
    pub receiver: Vec<String>,
    /// What the centre of a pixel sees; 0,0 is top left (repeatable)
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub pixel: Vec<Pair>,
    /// What the centres of a grid of cells over the camera's image see
    #[arg(long, value_name = "W,H", allow_hyphen_values = true, value_parser = grid)]
    pub grid: Option<Pair>,
    /// Albedo for radiance where no surface lies under a receiver: one number, or r,g,b
    #[arg(long, value_name = "RHO", allow_hyphen_values = true)]
    pub albedo: Option<Colour>,
}

/// A receiver given by numbers, or a file of them.
#[derive(Clone, Debug, PartialEq)]
pub enum At {
    /// Position and unit normal.
    Point(DVec3, DVec3),
    /// A file with a receiver in each line.
    File(PathBuf),
}

impl FromStr for At {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.strip_prefix('@') {
            Some("") => Err("names no file; the form is @FILE.csv".into()),
            Some(path) => Ok(Self::File(path.into())),
            None => point(text).map(|(position, normal)| Self::Point(position, normal)),
        }
    }
}

/// Six numbers to a position and a unit normal.
pub fn point(text: &str) -> Result<(DVec3, DVec3), String> {
    let [x, y, z, nx, ny, nz] = numbers(text, "x,y,z,nx,ny,nz")?;
    let normal = DVec3::new(nx, ny, nz);
    let unit = (normal / normal.abs().max_element()).try_normalize().ok_or("the normal has no direction")?;
    Ok((DVec3::new(x, y, z), unit))
}

/// Two whole numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pair(pub [u32; 2]);

impl FromStr for Pair {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts: Vec<u32> = text.split(',').filter_map(|part| part.trim().parse().ok()).collect();
        let count = text.split(',').count();
        parts.try_into().ok().filter(|_| count == 2).map(Self).ok_or("needs two whole numbers, as in 3,4".into())
    }
}

/// Cells of the largest grid: each is a receiver with all its rows in memory.
const MOST_CELLS: u64 = 1 << 20;

fn grid(text: &str) -> Result<Pair, String> {
    let grid @ Pair([columns, rows]) = text.parse()?;
    let cells = u64::from(columns) * u64::from(rows);
    let within = (1..=MOST_CELLS).contains(&cells);
    if within { Ok(grid) } else { Err(format!("has {cells} cells; a grid has 1 to {MOST_CELLS}")) }
}

/// Linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour(pub [f32; 3]);

impl FromStr for Colour {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let rgb = match text.parse::<f64>() {
            Ok(grey) => [grey; 3],
            Err(_) => numbers(text, "one number, or r,g,b")?,
        };
        let valid = rgb.iter().all(|c| (0.0..=1.0).contains(c));
        if valid { Ok(Self(rgb.map(|c| c as f32))) } else { Err("an albedo lies between 0 and 1".into()) }
    }
}

/// Exactly K finite numbers, separated by commas.
pub(super) fn numbers<const K: usize>(text: &str, form: &str) -> Result<[f64; K], String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let number = |part: &&str| match part.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("\"{part}\" is not a finite number; the form is {form}")),
    };
    let values = parts.iter().map(number).collect::<Result<Vec<f64>, String>>()?;
    let count = values.len();
    values.try_into().map_err(|_| format!("has {count} numbers where {K} are needed; the form is {form}"))
}

#[cfg(test)]
mod tests {
    use super::{At, Colour, Pair, grid, point};
    use glam::DVec3;

    #[test]
    fn a_point_may_have_minus_signs_and_a_normal_of_any_length() {
        assert_eq!(point("-1,2,-3e-1,0,0,-7"), Ok((DVec3::new(-1.0, 2.0, -0.3), DVec3::NEG_Z)));
        assert_eq!(point("0,0,0,1e-300,0,0").map(|(_, n)| n), Ok(DVec3::X));
        assert_eq!("@a.csv".parse(), Ok(At::File("a.csv".into())));
    }

    #[test]
    fn what_is_not_a_point_is_refused_with_the_form() {
        for (text, says) in [
            ("1,2,3", "3 numbers where 6"),
            ("0,0,0,0,0,0", "no direction"),
            ("a,0,0,0,0,1", "\"a\""),
            ("NaN,0,0,0,0,1", "finite"),
        ] {
            assert!(point(text).is_err_and(|error| error.contains(says)), "{text}");
        }
    }

    #[test]
    fn pairs_and_colours() {
        assert_eq!("3, 4".parse(), Ok(Pair([3, 4])));
        assert!("3".parse::<Pair>().is_err() && "3,4,5".parse::<Pair>().is_err() && "-1,2".parse::<Pair>().is_err());
        assert_eq!(grid("1024,1024"), Ok(Pair([1024, 1024])));
        assert!(grid("0,3").is_err() && grid("1024,1025").is_err());
        assert_eq!("0.5".parse(), Ok(Colour([0.5; 3])));
        assert!("0.5,2,0".parse::<Colour>().is_err());
    }
}
