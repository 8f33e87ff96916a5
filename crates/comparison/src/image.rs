//! Images: the radiance toward a camera, by one strategy.

use glam::DVec3;
use rayon::prelude::*;
use twoforms_estimator::density::Density;
use twoforms_estimator::estimator::{Estimator, NotFinite};
use twoforms_estimator::formulation::Formulation;
use twoforms_estimator::moments::Moments;
use twoforms_estimator::query::Query;
use twoforms_estimator::sampler::{Sampler, Stream};
use twoforms_estimator::strategy::{Kernel, NotSampled, Prepared, Strategy};
use twoforms_estimator::xi::{Draws, Key};
use twoforms_geometry::frame::Frame;
use twoforms_geometry::view::{Effort, View};
use twoforms_scene::Camera;

use crate::error::{BrokenPixel, ComparisonError};
use crate::viewpoint;
use crate::world::{Seen, World};

/// Where in a pixel its samples lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelFilter {
    /// Uniform over the pixel.
    Box,
    /// All at its centre.
    Point,
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
    /// Whether radiance is asked for, or irradiance.
    pub radiance: bool,
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

/// What lies at a pixel's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Centre {
    /// World position in metres.
    pub position: [f64; 3],
    /// Geometric unit normal on the side that is seen.
    pub normal: [f64; 3],
    /// Distance along the camera's axis in metres.
    pub depth: f64,
    /// ρ, RGB.
    pub albedo: [f32; 3],
}

/// Light samples at one x from which gathering a view costs less than casting rays.
const GATHER_FROM: u32 = 16;

impl Rendering {
    /// Renders the crop's pixels, row by row from the top, in parallel on rayon's threads; the pixels do not depend on
    /// how many there are. `progress` is told of pixels done, from any thread.
    ///
    /// # Errors
    /// When the strategy has no sampler, or a sample is not finite.
    pub fn run(
        &self,
        world: &World,
        camera: &Camera,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<Vec<Pixel>, ComparisonError> {
        let painter = Painter::new(self, world, camera)?;
        let rows: Result<Vec<Vec<Pixel>>, BrokenPixel> = (self.crop.y0..self.crop.y1)
            .into_par_iter()
            .map(|y| {
                let row = (self.crop.x0..self.crop.x1).map(|x| painter.pixel(x, y)).collect();
                progress(u64::from(self.crop.width()));
                row
            })
            .collect();
        Ok(rows?.concat())
    }
}

/// A rendering with all that does not depend on the pixel.
struct Painter<'a> {
    rendering: &'a Rendering,
    world: &'a World,
    camera: &'a Camera,
    prepared: Prepared,
    camera_key: Key,
    light_key: Key,
}

/// The value of one camera sample.
struct Shaded {
    value: [f64; 3],
    rays: u64,
}

impl<'a> Painter<'a> {
    fn new(rendering: &'a Rendering, world: &'a World, camera: &'a Camera) -> Result<Self, NotSampled> {
        let key = |name: &str| Key::new([rendering.seed].into_iter().chain(Key::words_of(name)));
        let names = format!("{}\n{}", rendering.strategy.density_name(), rendering.sampler);
        Ok(Self {
            rendering,
            world,
            camera,
            prepared: rendering.strategy.prepare(&world.lights)?,
            camera_key: key("camera"),
            light_key: key(&names),
        })
    }

    fn pixel(&self, x: u32, y: u32) -> Result<Pixel, BrokenPixel> {
        let Rendering { spp, width, strategy, .. } = *self.rendering;
        let index = y * width + x;
        let mut channels = [Moments::default(); 3];
        let mut rays = 0;
        for sample in 0..spp {
            let broken = |source| BrokenPixel { strategy, x, y, sample, source };
            let shaded = self.camera_sample(x, y, [index, sample]).map_err(broken)?;
            channels = std::array::from_fn(|c| channels[c] + Moments::of(&[shaded.value[c]]));
            rays += shaded.rays;
        }
        Ok(Pixel {
            mean: channels.map(|m| m.mean),
            variance: channels.map(|m| m.variance().unwrap_or(0.0)),
            rays,
            centre: self.centre(x, y),
        })
    }

    fn camera_sample(&self, x: u32, y: u32, stream: [u32; 2]) -> Result<Shaded, NotFinite> {
        let [dx, dy] = match self.rendering.filter {
            PixelFilter::Box => Stream { sampler: Sampler::Independent, draws: Draws { key: self.camera_key, stream } }
                .xi(0)
                .uv()
                .map(f64::from),
            PixelFilter::Point => [0.5; 2],
        };
        match self.look(f64::from(x) + dx, f64::from(y) + dy) {
            None => Ok(Shaded { value: [0.0; 3], rays: 1 }),
            Some(seen) => self.shade(&seen, stream),
        }
    }

    /// L_e of what is seen, plus what it reflects: the mean of the light samples.
    fn shade(&self, seen: &Seen, stream: [u32; 2]) -> Result<Shaded, NotFinite> {
        let Rendering { light_samples, cull, radiance, .. } = *self.rendering;
        let emission = if radiance { self.world.emission(seen) } else { [0.0; 3] };
        let emission = emission.map(f64::from);
        let material = self.world.scene.material_of(seen.triangle);
        let culled = cull && !seen.front && !material.double_sided;
        if culled || (radiance && material.albedo == [0.0; 3]) {
            return Ok(Shaded { value: emission, rays: 1 });
        }
        let query = if radiance {
            Query::radiance(&self.world.lights, material.albedo)
        } else {
            Query::irradiance(&self.world.lights)
        };
        let effort = if light_samples >= GATHER_FROM { Effort::Gather } else { Effort::Cast };
        let view = View::new(&self.world.geometry, Frame::new(seen.position, seen.normal), effort);
        let draws = Draws { key: self.light_key, stream };
        let kernel = Secondary { sampler: self.rendering.sampler, draws, n: light_samples };
        let (value, rays) = self.prepared.run(&view, &query, kernel)?;
        Ok(Shaded { value: std::array::from_fn(|c| emission[c] + value[c]), rays: rays + 1 })
    }

    fn look(&self, x: f64, y: f64) -> Option<Seen> {
        let Rendering { width, height, .. } = *self.rendering;
        self.world.see(&viewpoint::ray(self.camera, [x, y], [width, height]))
    }

    fn centre(&self, x: u32, y: u32) -> Option<Centre> {
        let seen = self.look(f64::from(x) + 0.5, f64::from(y) + 0.5)?;
        let toward: DVec3 = seen.position - self.camera.position;
        Some(Centre {
            position: seen.position.to_array(),
            normal: seen.normal.to_array(),
            depth: toward.dot(self.camera.forward),
            albedo: self.world.scene.albedo(seen.triangle),
        })
    }
}

/// The mean of n light samples, and the rays it took.
struct Secondary {
    sampler: Sampler,
    draws: Draws,
    n: u32,
}

impl Kernel for Secondary {
    type Output = Result<([f64; 3], u64), NotFinite>;

    fn run<F: Formulation, D: Density<F::Measure>>(self, estimator: &Estimator<F, D>) -> Self::Output {
        let estimate = estimator.secondary(self.n, Stream { sampler: self.sampler, draws: self.draws })?;
        Ok((estimate.value, estimate.rays))
    }
}
