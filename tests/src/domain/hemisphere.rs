//! The hemisphere around N_x.

use std::f64::consts::TAU;

use twoforms_estimator::measure::{Aim, SolidAngle};
use twoforms_geometry::vector::{Direction, Vector, round};

use super::{Domain, Patch, aims_around};

/// Cells of equal solid angle: a grid in cosθ and φ.
#[derive(Clone, Copy, Debug)]
pub struct HemisphereCells {
    /// Patches along each side of a cell.
    pub fine: usize,
    /// The probability that a density draws a direction above the horizon.
    pub mass: f64,
    /// How far a sum over the patches may lie from the integral.
    pub resolution: f64,
}

const ROWS: usize = 8;
const COLUMNS: usize = 16;

impl HemisphereCells {
    /// For densities that are linear in cosθ: the value in the middle of a patch is the mean.
    pub const EVEN: Self = Self { fine: 4, mass: 1.0, resolution: 1e-6 };
}

fn toward(cos_theta: f64, turns: f64) -> Aim<f32> {
    let (sin_phi, cos_phi) = libm::sincos(TAU * turns);
    let sin_theta = ((1.0 - cos_theta) * (1.0 + cos_theta)).sqrt();
    let psi = glam::DVec3::new(cos_phi * sin_theta, sin_phi * sin_theta, cos_theta);
    Aim::anywhere(Direction::of(Vector::from(round(psi)), 1.0))
}

impl Domain<SolidAngle> for HemisphereCells {
    fn cells(&self) -> usize {
        ROWS * COLUMNS
    }

    fn cell_of(&self, aim: &Aim<f32>) -> usize {
        let [x, y, z] = aim.psi.vector().to_array().map(f64::from);
        let turns = (libm::atan2(y, x) / TAU).rem_euclid(1.0);
        let row = ((z * ROWS as f64) as usize).min(ROWS - 1);
        row * COLUMNS + ((turns * COLUMNS as f64) as usize).min(COLUMNS - 1)
    }

    /// dω = dcosθ dφ.
    fn patches(&self) -> Vec<Patch<Aim<f32>>> {
        let fine = self.fine;
        let (rows, columns) = (ROWS * fine, COLUMNS * fine);
        let measure = TAU / (rows * columns) as f64;
        let middle = |k: usize, n: usize| (k as f64 + 0.5) / n as f64;
        let patch = |row, column| {
            let at = toward(middle(row, rows), middle(column, columns));
            Patch { at, measure, cell: row / fine * COLUMNS + column / fine }
        };
        (0..rows).flat_map(|row| (0..columns).map(move |column| patch(row, column))).collect()
    }

    /// Below the horizon.
    fn beyond(&self) -> Vec<Aim<f32>> {
        [-1.0, -0.5, -1e-6].iter().flat_map(|&cos| [0.0, 0.3, 0.7].map(|turns| toward(cos, turns))).collect()
    }

    fn mass(&self) -> f64 {
        self.mass
    }

    fn resolution(&self) -> f64 {
        self.resolution
    }

    fn around(&self, aim: &Aim<f32>, roundings: f32) -> [Aim<f32>; 6] {
        aims_around(aim, roundings)
    }
}
