//! The domains of densities, cut into cells, and these into patches: for counting samples and for integrals.
//!
//! All of it is said in binary64 and by other formulas than the program's own: a patch's solid angle is that of its
//! corners, not dA cosθ_y / r².

mod chart;
mod counts;
mod hemisphere;
mod lights;

pub use chart::Chart;
pub use counts::{chi_square, value};
pub use hemisphere::HemisphereCells;
pub use lights::{LightCells, LitDirections};

use twoforms_estimator::measure::{Aim, Measure};
use twoforms_geometry::segment::SurfacePoint;
use twoforms_geometry::vector::{Direction, Vector};

/// A small part of a domain.
#[derive(Clone, Copy, Debug)]
pub struct Patch<P> {
    /// A point in its middle.
    pub at: P,
    /// Its measure.
    pub measure: f64,
    /// The cell that it is part of.
    pub cell: usize,
}

/// A measured domain in cells.
pub trait Domain<M: Measure> {
    /// Number of cells.
    fn cells(&self) -> usize;
    /// The cell that holds a point of the domain.
    fn cell_of(&self, at: &M::Point<f32>) -> usize;
    /// Patches that cover the domain.
    fn patches(&self) -> Vec<Patch<M::Point<f32>>>;
    /// Points that no sample may reach.
    fn beyond(&self) -> Vec<M::Point<f32>>;
    /// The probability that a density over this domain draws a point of it at all: what it integrates to.
    fn mass(&self) -> f64;
    /// How far a sum over the patches may lie from the integral.
    fn resolution(&self) -> f64;
    /// The points that lie to either side of one along each axis, so many roundings of its largest coordinate away.
    fn around(&self, at: &M::Point<f32>, roundings: f32) -> [M::Point<f32>; 6];
}

/// A vector moved to either side along each axis, by so many roundings of its largest coordinate.
fn moved(v: Vector<f32>, roundings: f32) -> [Vector<f32>; 6] {
    let [x, y, z] = v.to_array();
    let step = roundings * 2.0_f32.powi(-24) * x.abs().max(y.abs()).max(z.abs());
    let along = [Vector::new(step, 0.0, 0.0), Vector::new(0.0, step, 0.0), Vector::new(0.0, 0.0, step)];
    std::array::from_fn(|k| if k < 3 { v + along[k] } else { v - along[k - 3] })
}

fn aims_around(aim: &Aim<f32>, roundings: f32) -> [Aim<f32>; 6] {
    moved(aim.psi.vector(), roundings).map(|psi| Aim { psi: Direction::of(psi, 1.0), ..*aim })
}

fn points_around(y: &SurfacePoint<f32>, roundings: f32) -> [SurfacePoint<f32>; 6] {
    moved(y.position, roundings).map(|position| SurfacePoint { position, ..*y })
}
