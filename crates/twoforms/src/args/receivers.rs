//! Receivers: where the light is measured.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use glam::DVec3;
use twoforms_comparison::points::{self, numbers};
use twoforms_comparison::request::{Colour, Grid};

/// Where the light is measured: any mixture of these. Without any, the scene's own receivers; without those, an 8×8 grid
/// through its camera.
#[derive(Clone, Debug, Args)]
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
    pub grid: Option<Grid>,
    /// Albedo for radiance where no surface lies under a receiver: one number, or r,g,b
    #[arg(long, value_name = "RHO", allow_hyphen_values = true, value_parser = albedo)]
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
            None => points::parsed(text).map(|(position, normal)| Self::Point(position, normal)),
        }
    }
}

impl ReceiverArgs {
    /// Positions and unit normals.
    ///
    /// # Errors
    /// Where a file of them cannot be read, or is none.
    pub fn points(&self) -> Result<Vec<(DVec3, DVec3)>, String> {
        let mut all = Vec::new();
        for at in &self.at {
            match at {
                At::Point(position, normal) => all.push((*position, *normal)),
                At::File(path) => all.extend(points::read(path)?),
            }
        }
        Ok(all)
    }
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

fn grid(text: &str) -> Result<Grid, String> {
    let Pair(cells) = text.parse()?;
    Grid::try_from(cells)
}

fn albedo(text: &str) -> Result<Colour, String> {
    let rgb = text.parse().map_or_else(|_| numbers(text, "one number, or r,g,b"), |grey| Ok([grey; 3]));
    Colour::try_from(rgb?)
}

#[cfg(test)]
mod tests {
    use super::{At, Pair, albedo, grid};
    use glam::DVec3;

    #[test]
    fn a_receiver_is_six_numbers_or_a_file() {
        assert_eq!("-1,2,-3e-1,0,0,-7".parse(), Ok(At::Point(DVec3::new(-1.0, 2.0, -0.3), DVec3::NEG_Z)));
        assert_eq!("@a.csv".parse(), Ok(At::File("a.csv".into())));
        assert!("1,2,3".parse::<At>().is_err() && "@".parse::<At>().is_err());
    }

    #[test]
    fn pairs_grids_and_albedos() {
        assert_eq!("3, 4".parse(), Ok(Pair([3, 4])));
        assert!("3".parse::<Pair>().is_err() && "3,4,5".parse::<Pair>().is_err() && "-1,2".parse::<Pair>().is_err());
        assert!(grid("3,4").is_ok() && grid("0,3").is_err() && grid("x").is_err());
        assert_eq!(albedo("0.5"), albedo("0.5,0.5,0.5"));
        assert!(albedo("0.5").is_ok() && albedo("0.5,2,0").is_err() && albedo("red").is_err());
    }
}
