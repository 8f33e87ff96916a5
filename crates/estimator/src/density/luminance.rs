//! Points on the lights by what they emit.

use std::borrow::Cow;

use glam::{DVec2, DVec3};
use twoforms_geometry::real::{Real, Word};
use twoforms_geometry::segment::SurfacePoint;
use twoforms_geometry::view::{Vantage, View};
use twoforms_scene::Pattern;

use super::Ready;
use super::lights::{OnLights, Spread};
use crate::lights::Lights;
use crate::measure::SurfaceArea;
use crate::query::Query;
use crate::rgb::luminance;
use crate::selection::{Picker, Piece, Selection};

/// Most cells along a side of a target.
const MOST: f64 = 128.0;
/// Most cells of all targets, but for one each.
const MOST_OF_ALL: f64 = 1_048_576.0;
/// Cells along a texel: a texture that is bilinear between the centres of texels changes its slope at each half.
const PER_TEXEL: f64 = 2.0;
/// Samples that lie side by side, at most.
const LANES: usize = 16;

/// Emitted luminance: Y(y) dA times the sides that emit, Y being the mean luminance over the cell of y. A target that emits
/// by a texture falls into cells of equal area, half a texel long where these are not too many, any other is one cell.
#[derive(Clone, Copy, Debug)]
pub struct ByLuminance<'t> {
    cells: &'t Cells,
    lights: &'t Lights,
}

/// The cells of all targets.
#[derive(Clone, Debug)]
struct Cells {
    /// Each cell in the unit square of its target: its first u, its width in u, its first v, its width in v.
    places: Vec<[f32; 4]>,
    targets: Vec<u32>,
    /// Y times sides over each target that is one cell.
    whole: Vec<[f32; 1]>,
    /// The cells of the targets that have several.
    grids: Vec<Option<Grid>>,
}

/// The cells of one target, row by row, in the unit square from which its points are drawn.
#[derive(Clone, Debug)]
struct Grid {
    size: [usize; 2],
    /// Whether the target is a triangle, where u is the square of a coordinate.
    triangle: bool,
    /// Y times sides over each.
    values: Vec<f32>,
}

impl Grid {
    /// The cells of a target, at most so many along a side.
    fn new(pattern: &Pattern, triangle: bool, sides: f64, most: f64) -> Self {
        let [a, b, d] = pattern.corners_in_grid();
        let count = |texels: f64| (PER_TEXEL * texels).round().clamp(1.0, most) as usize;
        let along = |from: DVec2, to: DVec2| (to - from).abs().max_element();
        let size = if triangle {
            [along(a, b).max(along(a, d)), along(b, d)].map(count)
        } else {
            [along(a, b), along(a, d)].map(count)
        };
        let mut grid = Self { size, triangle, values: Vec::new() };
        let mean = |k: usize| sides * luminance(grid.mean(pattern, k));
        grid.values = (0..size[0] * size[1]).map(|k| mean(k) as f32).collect();
        grid
    }

    /// The first and the last u and v of a cell.
    fn bounds(&self, k: usize) -> [[f64; 2]; 2] {
        let [n, m] = self.size;
        let share = |k: usize, n: usize| [k as f64 / n as f64, (k + 1) as f64 / n as f64];
        [share(k / m, n), share(k % m, m)]
    }

    /// Mean of L_e over a cell, RGB: over the two triangles of its four corners, which may be one.
    fn mean(&self, pattern: &Pattern, k: usize) -> [f64; 3] {
        let [[u0, u1], [v0, v1]] = self.bounds(k);
        let [p, q, r, s] = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]].map(|uv| self.coordinates(uv));
        let halves = [[p, q, r], [p, r, s]].map(|half| (doubled_area(half), half));
        let total: f64 = halves.iter().map(|(area, _)| area).sum();
        let mut sum = [0.0; 3];
        for (area, half) in halves.into_iter().filter(|(area, _)| *area > 0.0) {
            let mean = pattern.mean_over(half);
            sum = std::array::from_fn(|c| sum[c] + mean[c] * (area / total));
        }
        sum
    }

    /// The target's coordinates, y = corner + b e + d f, of a point of the unit square.
    fn coordinates(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        if self.triangle {
            let s = u.sqrt();
            [s * (1.0 - v), s * v]
        } else {
            [u, v]
        }
    }

    /// The cell at such coordinates.
    fn cell(&self, [b, d]: [f64; 2]) -> usize {
        let [n, m] = self.size;
        let s = b + d;
        let [u, v] = if self.triangle { [s * s, d / s] } else { [b, d] };
        let place = |u: f64, n: usize| ((u * n as f64).max(0.0) as usize).min(n - 1);
        place(u, n) * m + place(v, m)
    }
}

fn doubled_area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
}

impl Cells {
    fn new(lights: &Lights) -> (Self, Vec<Piece>) {
        let mut cells = Self { places: Vec::new(), targets: Vec::new(), whole: Vec::new(), grids: Vec::new() };
        let mut pieces = Vec::new();
        let most = (MOST_OF_ALL / lights.targets() as f64).sqrt().clamp(1.0, MOST);
        for target in 0..lights.targets() as u32 {
            let sides = lights.sides(target);
            let value = sides * luminance(lights.radiance(target).map(f64::from));
            let grid = |pattern| Grid::new(pattern, lights.is_triangle(target), sides, most);
            let grid = lights.pattern(target).map(grid);
            let area = lights.areas()[target as usize];
            match &grid {
                None => cells.push(&mut pieces, target, [[0.0, 1.0]; 2], value * area),
                Some(grid) => {
                    let share = area / grid.values.len() as f64;
                    for (k, &value) in grid.values.iter().enumerate() {
                        cells.push(&mut pieces, target, grid.bounds(k), f64::from(value) * share);
                    }
                }
            }
            cells.whole.push([value as f32]);
            cells.grids.push(grid);
        }
        // Beyond the last: where nothing is picked.
        cells.push(&mut Vec::new(), 0, [[0.0, 1.0]; 2], 0.0);
        (cells, pieces)
    }

    fn push(&mut self, pieces: &mut Vec<Piece>, target: u32, [u, v]: [[f64; 2]; 2], measure: f64) {
        pieces.push(Piece { target, measure });
        self.places.push([u[0] as f32, (u[1] - u[0]) as f32, v[0] as f32, (v[1] - v[0]) as f32]);
        self.targets.push(target);
    }
}

impl ByLuminance<'_> {
    /// Y times sides at a point of a target in the frame of x.
    fn value(&self, view: &View, target: u32, y: [f32; 3]) -> f32 {
        let (grid, pattern) = (&self.cells.grids[target as usize], self.lights.pattern(target));
        let (Some(grid), Some(pattern)) = (grid, pattern) else { return self.cells.whole[target as usize][0] };
        let frame = view.frame();
        let y = frame.x() + frame.to_world(DVec3::from_array(y.map(f64::from)));
        grid.values[grid.cell(pattern.coordinates(y))]
    }

    #[cold]
    #[inline(never)]
    fn values<R: Real>(self, from: Vantage<R>, y: SurfacePoint<R>) -> R {
        R::apart(
            #[inline(always)]
            || {
                let (mut at, mut targets, mut values) = ([[0.0; LANES]; 3], [0; LANES], [0.0; LANES]);
                for (axis, coordinate) in at.iter_mut().zip(from.from_x(y.position).to_array()) {
                    coordinate.store(axis);
                }
                y.target.store(&mut targets);
                for k in 0..R::LANES {
                    values[k] = self.value(from.view(), targets[k], [at[0][k], at[1][k], at[2][k]]);
                }
                R::load(&values)
            },
        )
    }
}

impl Spread for ByLuminance<'_> {
    #[inline(always)]
    fn point<R: Real>(&self, from: &Vantage<R>, piece: R::Word, [u, v]: [R; 2]) -> SurfacePoint<R> {
        let target = R::gather_word(
            piece,
            #[inline(always)]
            |k| self.cells.targets[k as usize],
        );
        let [u0, width, v0, height] = R::gather(
            piece,
            #[inline(always)]
            |k| &self.cells.places[k as usize],
        );
        from.facet(target).point([u0 + width * u, v0 + height * v], target)
    }

    /// Y times sides.
    #[inline(always)]
    fn per_area<R: Real>(&self, from: &Vantage<R>, y: &SurfacePoint<R>) -> R {
        if self.lights.are_textured() {
            return self.values(*from, *y);
        }
        let [value] = R::gather(
            y.target,
            #[inline(always)]
            |k| &self.cells.whole[k as usize],
        );
        value
    }
}

/// `area/luminance`: over all lights together, in proportion to the power that leaves each place, in luminance.
#[derive(Clone, Debug)]
pub struct LuminanceOnLights(Box<Emitting>);

/// All that is worked out for a scene.
#[derive(Clone, Debug)]
struct Emitting {
    cells: Cells,
    lights: Lights,
    picker: Picker,
}

impl Ready for LuminanceOnLights {
    type Measure = SurfaceArea;
    type At<'a> = OnLights<'a, ByLuminance<'a>>;

    fn prepare(lights: &Lights, selection: Selection) -> Self {
        let (cells, pieces) = Cells::new(lights);
        let picker = Picker::over(selection, lights, &pieces, Vec::new);
        Self(Box::new(Emitting { cells, lights: lights.clone(), picker }))
    }

    fn depends_on_x(&self) -> bool {
        false
    }

    fn at<'a>(&'a self, _: &View, _: &Query) -> OnLights<'a, ByLuminance<'a>> {
        let Emitting { cells, lights, picker } = &*self.0;
        OnLights { picker: Cow::Borrowed(picker), spread: ByLuminance { cells, lights } }
    }
}
