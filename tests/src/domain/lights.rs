//! The targets of all lights, as points or as the directions toward them.

use glam::DVec3;
use twoforms_estimator::density::Picking;
use twoforms_estimator::measure::{Aim, SolidAngle, SurfaceArea};
use twoforms_geometry::segment::SurfacePoint;
use twoforms_geometry::view::View;

use super::chart::{Chart, fan_area, fan_solid_angle};
use super::{Domain, HemisphereCells, Patch, aims_around, points_around};

/// Cells along each side of a target.
const CELLS: usize = 8;
/// Patches along each side of a cell.
const FINE: usize = 8;

/// A grid over each target.
#[derive(Clone, Debug)]
pub struct LightCells<'p> {
    charts: Vec<Chart>,
    picker: &'p Picking<'p>,
    resolution: f64,
}

impl<'p> LightCells<'p> {
    /// The targets as `view` meets them, picked by `picker`.
    pub fn new(view: &View, picker: &'p Picking<'p>) -> Self {
        let targets = 0..view.geometry().targets().len() as u32;
        Self { charts: targets.map(|k| Chart::new(view, k)).collect(), picker, resolution: 1e-6 }
    }

    /// The same for a density that varies over a target, and ends where it meets the horizon: what patches that are wide as x
    /// sees them, or cut by the horizon, may add.
    pub fn varying(view: &View, picker: &'p Picking<'p>) -> Self {
        Self { resolution: 5e-3, ..Self::new(view, picker) }
    }

    fn cell(&self, target: u32, point: DVec3) -> usize {
        let [row, column] = self.charts[target as usize]
            .coordinates(point)
            .map(|c| ((c * CELLS as f64).max(0.0) as usize).min(CELLS - 1));
        (target as usize * CELLS + row) * CELLS + column
    }

    /// Every patch: its chart, its middle, its corners, and its cell.
    fn grid(&self) -> impl Iterator<Item = (&Chart, DVec3, [DVec3; 4], usize)> {
        const N: usize = CELLS * FINE;
        let at = |k: usize| k as f64 / N as f64;
        let middle = move |k: usize| (k as f64 + 0.5) / N as f64;
        self.charts.iter().flat_map(move |chart| {
            (0..N * N).map(move |k| {
                let (i, j) = (k / N, k % N);
                let corners =
                    [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(|[i, j]| chart.point([at(i), at(j)]));
                let cell = (chart.index() as usize * CELLS + i / FINE) * CELLS + j / FINE;
                (chart, chart.point([middle(i), middle(j)]), corners, cell)
            })
        })
    }
}

impl Domain<SurfaceArea> for LightCells<'_> {
    fn cells(&self) -> usize {
        self.charts.len() * CELLS * CELLS
    }

    fn cell_of(&self, y: &SurfacePoint<f32>) -> usize {
        self.cell(y.target, DVec3::from_array(y.position.to_array().map(f64::from)))
    }

    fn patches(&self) -> Vec<Patch<SurfacePoint<f32>>> {
        let patch = |(chart, middle, corners, cell): (&Chart, DVec3, [DVec3; 4], usize)| Patch {
            at: chart.surface_point(middle),
            measure: fan_area(&corners),
            cell,
        };
        self.grid().map(patch).collect()
    }

    /// The targets are all there is.
    fn beyond(&self) -> Vec<SurfacePoint<f32>> {
        Vec::new()
    }

    /// A point is drawn, whether it faces x or not, where a target is picked.
    fn mass(&self) -> f64 {
        self.picker.mass()
    }

    fn resolution(&self) -> f64 {
        self.resolution
    }

    fn around(&self, y: &SurfacePoint<f32>, roundings: f32) -> [SurfacePoint<f32>; 6] {
        points_around(y, roundings)
    }
}

impl Domain<SolidAngle> for LightCells<'_> {
    fn cells(&self) -> usize {
        self.charts.len() * CELLS * CELLS
    }

    fn cell_of(&self, aim: &Aim<f32>) -> usize {
        self.cell(aim.target, self.charts[aim.target as usize].along(aim.psi))
    }

    fn patches(&self) -> Vec<Patch<Aim<f32>>> {
        let patch = |(chart, middle, corners, cell): (&Chart, DVec3, [DVec3; 4], usize)| Patch {
            at: chart.aim(middle),
            measure: fan_solid_angle(&corners),
            cell,
        };
        self.grid().map(patch).collect()
    }

    /// Beside each target, away from it, and at nothing in particular.
    fn beyond(&self) -> Vec<Aim<f32>> {
        let around = |chart: &Chart| {
            let beside = [[0.5, -0.25], [0.5, 1.25], [1.5, 0.5]].map(|at| chart.aim(chart.point(at)));
            let through = chart.aim(chart.point([0.5, 0.5]));
            [&beside[..], &[chart.aim(-chart.point([0.5, 0.5])), Aim::anywhere(through.psi)]].concat()
        };
        self.charts.iter().flat_map(around).collect()
    }

    /// The probability that the point drawn faces x: Σ p_A × facing area.
    fn mass(&self) -> f64 {
        let mass = |chart: &Chart| f64::from(self.picker.density::<f32>(chart.index())) * chart.facing_area();
        self.charts.iter().map(mass).sum()
    }

    /// What a patch cut by the horizon, or one that is wide as x sees it, may add.
    fn resolution(&self) -> f64 {
        2e-3
    }

    fn around(&self, aim: &Aim<f32>, roundings: f32) -> [Aim<f32>; 6] {
        aims_around(aim, roundings)
    }
}

/// Directions in which some target lies, by the first that does: for a density that asks them all.
#[derive(Clone, Debug)]
pub struct LitDirections<'p>(LightCells<'p>);

/// How far beside a target, in its coordinates, a direction counts as toward it.
const BESIDE: f64 = 1e-6;

impl<'p> LitDirections<'p> {
    /// The targets as `view` meets them, picked by `picker`.
    pub fn new(view: &View, picker: &'p Picking<'p>) -> Self {
        Self(LightCells::new(view, picker))
    }

    /// The first target along a direction, or else the one that it misses by least.
    fn first(&self, aim: &Aim<f32>) -> &Chart {
        let miss = |chart: &&Chart| {
            let miss = chart.miss(aim.psi);
            if miss <= BESIDE { 0.0 } else { miss }
        };
        let nearest = self.0.charts.iter().min_by(|one, other| miss(one).total_cmp(&miss(other)));
        nearest.expect("a light")
    }
}

impl Domain<SolidAngle> for LitDirections<'_> {
    fn cells(&self) -> usize {
        Domain::<SolidAngle>::cells(&self.0)
    }

    fn cell_of(&self, aim: &Aim<f32>) -> usize {
        let chart = self.first(aim);
        self.0.cell(chart.index(), chart.along(aim.psi))
    }

    fn patches(&self) -> Vec<Patch<Aim<f32>>> {
        let mut patches = Domain::<SolidAngle>::patches(&self.0);
        patches.retain(|patch| self.first(&patch.at).index() == patch.at.target);
        patches.into_iter().map(|patch| Patch { at: Aim::anywhere(patch.at.psi), ..patch }).collect()
    }

    /// Below the horizon.
    fn beyond(&self) -> Vec<Aim<f32>> {
        HemisphereCells::EVEN.beyond()
    }

    /// The probability that the point drawn lies above the horizon and off x's plane.
    fn mass(&self) -> f64 {
        let mass = |chart: &Chart| f64::from(self.0.picker.density::<f32>(chart.index())) * chart.open_area();
        self.0.charts.iter().map(mass).sum()
    }

    fn resolution(&self) -> f64 {
        5e-3
    }

    fn around(&self, aim: &Aim<f32>, roundings: f32) -> [Aim<f32>; 6] {
        aims_around(aim, roundings)
    }
}
