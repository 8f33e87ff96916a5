//! Images: the radiance toward a camera, by one strategy.

mod admitted;
mod beam;
mod chunk;
mod face;
mod painter;
mod receive;
mod samples;
mod tile;

use rayon::prelude::*;
use twoforms_estimator::moments::Moments;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_scene::Camera;

use crate::error::{BrokenPixel, ComparisonError};
use crate::world::World;
use chunk::Chunk;
use painter::Painter;
use tile::tiles;

/// Where in a pixel its samples lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelFilter {
    /// Uniform over the pixel.
    Box,
    /// All at its centre.
    Point,
}

/// What a pixel shows of the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// Irradiance: f_r = 1.
    Irradiance,
    /// Radiance toward the camera, by the surface's own f_r.
    Radiance,
    /// The same with surfaces that reflect diffusely alone, by their albedo.
    Diffuse,
}

/// What to render, and how.
#[derive(Clone, Debug)]
pub struct Rendering {
    /// The strategy for direct light.
    pub strategy: Strategy,
    /// The sampler of light samples.
    pub sampler: Sampler,
    /// Width of the image in pixels.
    pub width: u32,
    /// Height of the image in pixels.
    pub height: u32,
    /// The rectangle of pixels to render.
    pub crop: Crop,
    /// Camera samples per pixel.
    pub spp: u32,
    /// Light samples per camera sample.
    pub light_samples: u32,
    /// Where camera samples lie.
    pub filter: PixelFilter,
    /// Whether single-sided surfaces seen from behind are black.
    pub cull: bool,
    /// What each pixel shows.
    pub quantity: Shown,
    /// The seed.
    pub seed: u64,
}

/// A rectangle of pixels: x0 <= x < x1, y0 <= y < y1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crop {
    /// First column.
    pub x0: u32,
    /// One past the last column.
    pub x1: u32,
    /// First row.
    pub y0: u32,
    /// One past the last row.
    pub y1: u32,
}

impl Crop {
    /// Number of columns.
    pub fn width(&self) -> u32 {
        self.x1 - self.x0
    }

    /// Number of rows.
    pub fn height(&self) -> u32 {
        self.y1 - self.y0
    }

    /// What lies in another rectangle too; the two must overlap.
    fn within(&self, other: Self) -> Self {
        let Self { x0, x1, y0, y1 } = other;
        Self { x0: self.x0.max(x0), x1: self.x1.min(x1), y0: self.y0.max(y0), y1: self.y1.min(y1) }
    }

    /// Whether some pixel lies in another rectangle too.
    fn meets(&self, other: Self) -> bool {
        self.x0 < other.x1 && other.x0 < self.x1 && self.y0 < other.y1 && other.y0 < self.y1
    }

    /// The four quarters of a square with sides of an even number of pixels.
    fn quarters(self) -> impl Iterator<Item = Self> {
        let half = self.width() / 2;
        let corners = [(0, 0), (half, 0), (0, half), (half, half)];
        corners.into_iter().map(move |(dx, dy)| {
            let (x0, y0) = (self.x0 + dx, self.y0 + dy);
            Self { x0, x1: x0 + half, y0, y1: y0 + half }
        })
    }

    /// The pixels, row by row.
    fn pixels(self) -> impl Iterator<Item = [u32; 2]> {
        (self.y0..self.y1).flat_map(move |y| (self.x0..self.x1).map(move |x| [x, y]))
    }
}

/// One pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// Mean over the camera samples, RGB.
    pub mean: [f64; 3],
    /// Sample variance (n − 1) of one camera sample, RGB; zero for a single sample.
    pub variance: [f64; 3],
    /// Rays asked for, camera rays included.
    pub rays: u64,
    /// What lies at the pixel's centre.
    pub centre: Option<Centre>,
}

impl Pixel {
    /// A pixel from the moments of its camera samples, RGB.
    fn new(channels: [Moments; 3], rays: u64, centre: Option<Centre>) -> Self {
        let variance = channels.map(|m| m.variance().unwrap_or(0.0));
        Self { mean: channels.map(|m| m.mean), variance, rays, centre }
    }
}

/// What lies at a pixel's centre, found in binary64 and rounded to what image files hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Centre {
    /// World position in metres.
    pub position: [f32; 3],
    /// Geometric unit normal on the side that is seen.
    pub normal: [f32; 3],
    /// Distance along the camera's axis in metres.
    pub depth: f32,
    /// ρ, RGB.
    pub albedo: [f32; 3],
}

impl Rendering {
    /// Renders the crop's pixels, row by row from the top, in parallel on rayon's threads; the pixels do not depend on
    /// how many there are. `progress` is told of pixels done, from any thread.
    ///
    /// # Errors
    /// When the strategy or the number of samples is impossible with the sampler, or a sample is not finite.
    pub fn run(
        &self,
        world: &World,
        camera: &Camera,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<Vec<Pixel>, ComparisonError> {
        self.admit(world)?;
        let painter = Painter::new(self, world, camera);
        let mut image = vec![Pixel::default(); self.crop.width() as usize * self.crop.height() as usize];
        tiles(self.crop, &mut image).into_par_iter().try_for_each_init(Chunk::new, |chunk, mut tile| {
            let pixels = painter.tile(tile.square, chunk)?;
            tile.fill(&pixels);
            progress(pixels.len() as u64);
            Ok::<(), BrokenPixel>(())
        })?;
        Ok(image)
    }
}
