//! A target that emits by a texture, as x meets it.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use twoforms_estimator::cells::Cells;
use twoforms_estimator::rgb::luminance;
use twoforms_scene::Pattern;

use crate::error::Error;
use crate::value::EPSILON;
use crate::visible::Pieces;

/// Most pieces that what x sees of a facet is cut into by the lines of its texture.
pub const MOST: usize = 1 << 18;

/// The radiance of a target by a texture: one bilinear map wherever two linear functions of y, its place in the texture's
/// grid, lie between whole numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Glow {
    pattern: Box<Pattern>,
    /// f_r, RGB.
    f_r: [f64; 3],
    corner: DVec3,
    /// Where that corner lies in the grid.
    place: DVec2,
    /// Change of the two coordinates in the grid per metre.
    slopes: [DVec3; 2],
    /// Change of the coordinates along the sides from that corner per metre.
    duals: [DVec3; 2],
    cells: Arc<Cells>,
}

impl Glow {
    /// The texture of a target that has these corners in the frame of x, times `f_r` (RGB).
    pub fn new(pattern: &Pattern, cells: &Arc<Cells>, corners: &[DVec3], f_r: [f64; 3]) -> Self {
        let (corner, last) = (corners[0], corners[corners.len() - 1]);
        let [e, f] = [corners[1] - corner, last - corner];
        let normal = e.cross(f);
        let [along_e, along_f] = [f.cross(normal), normal.cross(e)].map(|dual| dual / normal.length_squared());
        let [place, next, previous] = pattern.corners_in_grid();
        let slope = |axis: usize| along_e * (next - place)[axis] + along_f * (previous - place)[axis];
        let (slopes, duals) = ([slope(0), slope(1)], [along_e, along_f]);
        Self { pattern: Box::new(pattern.clone()), f_r, corner, place, slopes, duals, cells: cells.clone() }
    }

    /// L_e f_r at a point of the target: red, green, blue, luminance.
    pub fn at(&self, y: DVec3) -> [f64; 4] {
        let l_e = self.pattern.at_grid(self.place(y));
        let rgb: [f64; 3] = std::array::from_fn(|c| l_e[c] * self.f_r[c]);
        [rgb[0], rgb[1], rgb[2], luminance(rgb)]
    }

    /// What rounding of coordinates as large as `reach` moves it in the grid, in texels.
    pub fn slack(&self, reach: f64) -> f64 {
        let steepest = self.slopes[0].length().max(self.slopes[1].length());
        8.0 * EPSILON * (reach * steepest + self.place.abs().max_element())
    }

    /// Luminance times sides that the cell of y emits: what points are drawn in proportion to by `area/luminance`.
    pub fn emitted(&self, y: DVec3) -> f64 {
        self.cells.value(self.duals.map(|dual| dual.dot(y - self.corner)))
    }

    /// The mean of that over the target.
    pub fn mean_emitted(&self) -> f64 {
        self.cells.mean_value()
    }

    /// The pieces, cut along the lines between those cells.
    ///
    /// # Errors
    /// [`Error::TooManyTexels`].
    pub fn cut_in_cells(&self, pieces: &Pieces, target: u32) -> Result<Pieces, Error> {
        let lines = self.cells.lines();
        let mut cut = Pieces::default();
        for polygon in pieces.iter() {
            let mut parts = vec![polygon.to_vec()];
            for &[h0, h1, h2] in &lines {
                let height = |y: DVec3| h0 + (self.duals[0] * h1 + self.duals[1] * h2).dot(y - self.corner);
                parts = parts.iter().flat_map(|part| separated(part, height)).collect();
            }
            for part in &parts {
                cut.push(part);
            }
            if cut.len() > MOST {
                return Err(Error::TooManyTexels { target, limit: MOST });
            }
        }
        Ok(cut)
    }

    fn place(&self, y: DVec3) -> DVec2 {
        self.place + DVec2::from(self.slopes.map(|slope| slope.dot(y - self.corner)))
    }

    /// The pieces, cut along the lines between which the radiance is one bilinear map.
    ///
    /// # Errors
    /// [`Error::TooManyTexels`].
    pub fn cut(&self, pieces: &Pieces, target: u32) -> Result<Pieces, Error> {
        let mut cut = Pieces::default();
        let mut strips = Vec::new();
        for polygon in pieces.iter() {
            self.strips(polygon, 1, &mut strips, target)?;
            for strip in strips.drain(..) {
                let mut parts = Vec::new();
                self.strips(&strip, 0, &mut parts, target)?;
                for part in &parts {
                    cut.push(part);
                }
                if cut.len() > MOST {
                    return Err(Error::TooManyTexels { target, limit: MOST });
                }
            }
        }
        Ok(cut)
    }

    /// Cuts a convex polygon where one coordinate in the grid is a whole number.
    fn strips(&self, polygon: &[DVec3], axis: usize, strips: &mut Vec<Vec<DVec3>>, target: u32) -> Result<(), Error> {
        let height = |y: DVec3| self.place(y)[axis];
        let heights = polygon.iter().map(|&y| height(y));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        let (first, last) = (low.floor() + 1.0, high.ceil() - 1.0);
        if last - first > MOST as f64 {
            return Err(Error::TooManyTexels { target, limit: MOST });
        }
        let mut rest = polygon.to_vec();
        for line in 0..(last - first + 1.0).max(0.0) as usize {
            let [below, above] = halves(&rest, |y| height(y) - (first + line as f64));
            strips.push(below);
            rest = above;
        }
        strips.push(rest);
        Ok(())
    }
}

/// A convex polygon, in two parts where a linear function changes its sign on it.
fn separated(polygon: &[DVec3], height: impl Fn(DVec3) -> f64) -> Vec<Vec<DVec3>> {
    let signs = polygon.iter().map(|&y| height(y));
    let (low, high) = signs.fold((0.0_f64, 0.0_f64), |(low, high), h| (low.min(h), high.max(h)));
    if low < 0.0 && high > 0.0 { halves(polygon, height).to_vec() } else { vec![polygon.to_vec()] }
}

/// The parts of a convex polygon where a linear function is not positive, and where it is not negative.
fn halves(polygon: &[DVec3], height: impl Fn(DVec3) -> f64) -> [Vec<DVec3>; 2] {
    let [mut below, mut above] = [Vec::with_capacity(polygon.len() + 1), Vec::with_capacity(polygon.len() + 1)];
    for (&p, &q) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let (h, next) = (height(p), height(q));
        if h <= 0.0 {
            below.push(p);
        }
        if h >= 0.0 {
            above.push(p);
        }
        if h * next < 0.0 {
            let crossing = p + (q - p) * (h / (h - next));
            below.push(crossing);
            above.push(crossing);
        }
    }
    [below, above]
}
