//! A textured target in cells: what it emits from place to place, as a density follows it.

use glam::DVec2;
use twoforms_scene::Pattern;

use crate::rgb::luminance;

/// Most cells along a side of a target.
const MOST: f64 = 128.0;
/// Most cells of all targets, but for one each.
const MOST_OF_ALL: f64 = 1_048_576.0;
/// Cells along a texel: a texture that is bilinear between the centres of texels changes its slope at each half.
const PER_TEXEL: f64 = 2.0;

/// Cells of equal area on a target, row by row in the unit square from which its points are drawn, with the mean luminance of
/// each times the sides that emit.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    size: [usize; 2],
    /// Whether the target is a triangle, where u is the square of a coordinate.
    triangle: bool,
    values: Vec<f64>,
}

impl Cells {
    /// The cells of a target that emits to so many sides, one of `targets` in all.
    pub fn new(pattern: &Pattern, triangle: bool, sides: f64, targets: usize) -> Self {
        let [a, b, d] = pattern.corners_in_grid();
        let most = (MOST_OF_ALL / targets as f64).sqrt().clamp(1.0, MOST);
        let count = |texels: f64| (PER_TEXEL * texels).round().clamp(1.0, most) as usize;
        let along = |from: DVec2, to: DVec2| (to - from).abs().max_element();
        let size = if triangle {
            [along(a, b).max(along(a, d)), along(b, d)].map(count)
        } else {
            [along(a, b), along(a, d)].map(count)
        };
        let mut cells = Self { size, triangle, values: Vec::new() };
        cells.values = (0..size[0] * size[1]).map(|k| sides * luminance(cells.mean(pattern, k))).collect();
        cells
    }

    /// Mean luminance times sides of each cell.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Mean luminance times sides over the target.
    pub fn mean_value(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }

    /// That of the cell that holds a point with the coordinates (b, d): y = corner + b e + d f.
    pub fn value(&self, coordinates: [f64; 2]) -> f64 {
        self.values[self.cell(coordinates)]
    }

    /// The lines between the cells: where one of the functions h₀ + h₁ b + h₂ d of the coordinates is zero.
    pub fn lines(&self) -> Vec<[f64; 3]> {
        let inner = |n: usize| (1..n).map(move |k| k as f64 / n as f64);
        let [n, m] = self.size;
        let line = |triangle: [f64; 3], other: [f64; 3]| if self.triangle { triangle } else { other };
        let across = inner(n).map(|u| line([-u.sqrt(), 1.0, 1.0], [-u, 1.0, 0.0]));
        across.chain(inner(m).map(|v| line([0.0, -v, 1.0 - v], [-v, 0.0, 1.0]))).collect()
    }

    /// The first and the last u and v of a cell.
    pub(crate) fn bounds(&self, k: usize) -> [[f64; 2]; 2] {
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

    /// The target's coordinates of a point of the unit square.
    fn coordinates(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        if self.triangle {
            let s = u.sqrt();
            [s * (1.0 - v), s * v]
        } else {
            [u, v]
        }
    }

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
