//! Painting an image: tiles by beams, or pixels ray by ray.

use glam::DVec3;
use twoforms_estimator::batch::Batch;
use twoforms_estimator::estimate::NotFinite;
use twoforms_estimator::moments::Moments;
use twoforms_estimator::query::Query;
use twoforms_estimator::secondary::secondary_in;
use twoforms_estimator::strategy::{Known, Prepared};
use twoforms_estimator::xi::Key;
use twoforms_geometry::frame::Frame;
use twoforms_geometry::lanes::Instructions;
use twoforms_geometry::ray::Ray;
use twoforms_geometry::vector::round;
use twoforms_geometry::view::{Effort, View};
use twoforms_scene::Camera;

use super::beam::Beam;
use super::chunk::Chunk;
use super::samples::Samples;
use super::{Centre, Crop, Pixel, PixelFilter, Rendering, Shown};
use crate::error::BrokenPixel;
use crate::place::Reflection;
use crate::viewpoint;
use crate::world::{Seen, World};

/// Light samples at one x from which gathering a view costs less than casting rays.
const GATHER_FROM: u32 = 16;

/// A rendering with all that does not depend on the pixel.
pub(super) struct Painter<'a> {
    pub(super) rendering: &'a Rendering,
    pub(super) world: &'a World,
    pub(super) camera: &'a Camera,
    pub(super) prepared: Prepared,
    pub(super) camera_key: Key,
    pub(super) light_key: Key,
}

/// The value of one camera sample.
pub(super) struct Shaded {
    pub(super) value: [f64; 3],
    pub(super) rays: u64,
}

/// What a surface adds to a camera sample by itself, and what is asked of the light that it receives; nothing where it
/// reflects none.
pub(super) struct Surface<'w> {
    pub(super) emission: [f64; 3],
    pub(super) query: Option<Query<'w>>,
    pub(super) varies: Varies,
}

/// How far a surface is not the same all over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Varies {
    /// It is.
    No,
    /// It is asked about as if it were white and dark: what it adds and how it colours what it receives is told for each of its
    /// points, by [`Painter::colour`].
    InColour,
    /// In its highlight too: what is said of it holds at one point, and each is asked about by itself.
    Wholly,
}

/// What a surface that varies in colour is at one point.
pub(super) struct Colour {
    /// L_e toward the eye, RGB.
    pub(super) emission: [f64; 3],
    /// ρ, RGB.
    pub(super) albedo: [f64; 3],
}

impl<'a> Painter<'a> {
    pub(super) fn new(rendering: &'a Rendering, world: &'a World, camera: &'a Camera) -> Self {
        let key = |name: &str| Key::new([rendering.seed].into_iter().chain(Key::words_of(name)));
        let names = format!("{}\n{}", rendering.strategy.density_name(), rendering.sampler);
        Self {
            rendering,
            world,
            camera,
            prepared: rendering.strategy.prepare(&world.lights),
            camera_key: key("camera"),
            light_key: key(&names),
        }
    }

    /// The pixels of a tile that lie in the crop, row by row: by beams, or where those see too much by beams through its
    /// quarters, and at last by a ray for each sample. How is decided by the tile alone.
    pub(super) fn tile(&self, tile: Crop, chunk: &mut Chunk) -> Result<Vec<Pixel>, BrokenPixel> {
        let inside = tile.within(self.rendering.crop);
        if let Some(beam) = Beam::new(self, tile) {
            return beam.pixels(inside, chunk);
        }
        if tile.width() == 1 {
            return inside.pixels().map(|[x, y]| self.pixel(x, y)).collect();
        }
        self.quarters(tile, inside, chunk)
    }

    fn quarters(&self, tile: Crop, inside: Crop, chunk: &mut Chunk) -> Result<Vec<Pixel>, BrokenPixel> {
        let mut pixels = vec![Pixel::default(); inside.width() as usize * inside.height() as usize];
        for quarter in tile.quarters().filter(|quarter| quarter.meets(inside)) {
            let part = quarter.within(inside);
            for ([x, y], pixel) in part.pixels().zip(self.tile(quarter, chunk)?) {
                pixels[((y - inside.y0) * inside.width() + x - inside.x0) as usize] = pixel;
            }
        }
        Ok(pixels)
    }

    /// A pixel ray by ray.
    fn pixel(&self, x: u32, y: u32) -> Result<Pixel, BrokenPixel> {
        let Rendering { spp, strategy, .. } = *self.rendering;
        let mut channels: [Vec<f64>; 3] = Default::default();
        let (mut rays, mut batch) = (0, Batch::new(strategy.pairs()));
        for sample in 0..spp {
            let broken = |source| BrokenPixel { strategy, x, y, sample, source };
            let shaded = self.camera_sample(x, y, [self.index(x, y), sample], &mut batch).map_err(broken)?;
            channels.iter_mut().zip(shaded.value).for_each(|(channel, value)| channel.push(value));
            rays += shaded.rays;
        }
        Ok(Pixel::new(channels.each_ref().map(|channel| Moments::of(channel)), rays, self.centre(x, y)))
    }

    /// The pixel's number in the whole image.
    pub(super) fn index(&self, x: u32, y: u32) -> u32 {
        y * self.rendering.width + x
    }

    fn camera_sample(&self, x: u32, y: u32, stream: [u32; 2], batch: &mut Batch) -> Result<Shaded, NotFinite> {
        let [dx, dy] = match self.rendering.filter {
            PixelFilter::Box => {
                self.camera_samples().stream(stream).xi(stream[1], 1).from(0).xi(0).uv().map(<f64 as From<f32>>::from)
            }
            PixelFilter::Point => [0.5; 2],
        };
        let (x, y) = (f64::from(x) + dx, f64::from(y) + dy);
        if self.world.geometry.is_veiled() {
            return self.shade_through(x, y, stream, batch);
        }
        match self.look(x, y) {
            None => Ok(Shaded { value: [0.0; 3], rays: 1 }),
            Some(seen) => self.shade(&seen, stream, batch),
        }
    }

    /// What is seen through surfaces that are not opaque, each by the same light samples.
    fn shade_through(&self, x: f64, y: f64, stream: [u32; 2], batch: &mut Batch) -> Result<Shaded, NotFinite> {
        let mut sum = Shaded { value: [0.0; 3], rays: 1 };
        for (seen, weight) in self.world.see_through(&self.ray(x, y)) {
            let Shaded { value, rays } = self.shade(&seen, stream, batch)?;
            sum.value = std::array::from_fn(|c| sum.value[c] + weight * value[c]);
            sum.rays += rays - 1;
        }
        Ok(sum)
    }

    /// What a surface shows of itself and asks of the light.
    pub(super) fn surface(&self, seen: &Seen) -> Surface<'a> {
        let Rendering { cull, quantity, .. } = *self.rendering;
        let (scene, radiance) = (&self.world.scene, quantity != Shown::Irradiance);
        let material = scene.material_of(seen.triangle);
        let varies = match quantity {
            _ if !radiance || scene.is_uniform(seen.triangle) => Varies::No,
            Shown::Radiance if material.may_be_glossy() => Varies::Wholly,
            _ => Varies::InColour,
        };
        let emission = if radiance && varies != Varies::InColour { self.world.emission(seen) } else { [0.0; 3] };
        let query = match varies {
            _ if cull && !seen.front && !material.double_sided => None,
            Varies::InColour => Some(Query::radiance(&self.world.lights, [1.0; 3])),
            _ => self.query(seen),
        };
        Surface { emission: emission.map(f64::from), query, varies }
    }

    /// What is asked of the light at what is seen; nothing where that reflects none.
    fn query(&self, seen: &Seen) -> Option<Query<'a>> {
        let (world, lights) = (self.world, &self.world.lights);
        let highlight = match self.rendering.quantity {
            Shown::Irradiance => return Some(Query::irradiance(lights)),
            Shown::Diffuse => None,
            Shown::Radiance => world.highlight(seen),
        };
        let albedo = world.albedo(seen);
        let reflection = match highlight {
            Some(surface) => Reflection::Glossy { surface, eye: self.camera.position },
            None if albedo == [0.0; 3] => return None,
            None => Reflection::Lambertian(albedo),
        };
        Some(reflection.query(lights, &Frame::new(seen.position, seen.normal)))
    }

    /// What a surface that varies in colour is where it is seen.
    pub(super) fn colour(&self, seen: &Seen) -> Colour {
        let (emission, albedo) = (self.world.emission(seen), self.world.albedo(seen));
        Colour { emission: emission.map(f64::from), albedo: albedo.map(f64::from) }
    }

    /// L_e of what is seen, plus what it reflects.
    pub(super) fn shade(&self, seen: &Seen, stream: [u32; 2], batch: &mut Batch) -> Result<Shaded, NotFinite> {
        let Surface { mut emission, query, varies } = self.surface(seen);
        let (mut value, mut rays) = ([0.0; 3], 0);
        if let Some(query) = query {
            (value, rays) = self.receive(seen, &query, stream, batch)?;
        }
        if varies == Varies::InColour {
            let colour = self.colour(seen);
            (emission, value) = (colour.emission, std::array::from_fn(|c| value[c] * colour.albedo[c]));
        }
        Ok(Shaded { value: std::array::from_fn(|c| emission[c] + value[c]), rays: rays + 1 })
    }

    /// The mean of the light samples at one point, and the rays it took.
    pub(super) fn receive(
        &self,
        seen: &Seen,
        query: &Query,
        stream: [u32; 2],
        batch: &mut Batch,
    ) -> Result<([f64; 3], u64), NotFinite> {
        let samples = self.light_samples();
        let effort = if samples.each >= GATHER_FROM { Effort::Gather } else { Effort::Cast };
        let view = View::new(&self.world.geometry, Frame::new(seen.position, seen.normal), effort);
        let (stream, first) = (samples.stream(stream), stream[1] * samples.each);
        let estimator = self.prepared.at(&view, query, &Known::default());
        let estimate = secondary_in(batch, &*estimator, stream, first..first + samples.each)?;
        Ok((estimate.value, estimate.rays))
    }

    /// The random words of a camera sample's first light sample.
    pub(super) fn words(&self, stream: [u32; 2]) -> Vec<[u32; 2]> {
        let samples = self.light_samples();
        samples.stream(stream).xi(stream[1] * samples.each, 1).words(0)
    }

    /// Where in its pixel each camera sample lies.
    pub(super) fn camera_samples(&self) -> Samples {
        self.samples(self.camera_key, 1)
    }

    /// The light samples of a pixel.
    pub(super) fn light_samples(&self) -> Samples {
        self.samples(self.light_key, self.rendering.light_samples)
    }

    fn samples(&self, key: Key, each: u32) -> Samples {
        let Rendering { sampler, spp, .. } = *self.rendering;
        Samples { sampler, key, each, spp, instructions: Instructions::best() }
    }

    /// Direction from the camera through a point of the image, in pixels.
    pub(super) fn toward(&self, x: f64, y: f64) -> DVec3 {
        self.ray(x, y).direction
    }

    fn look(&self, x: f64, y: f64) -> Option<Seen> {
        self.world.see(&self.ray(x, y))
    }

    fn ray(&self, x: f64, y: f64) -> Ray {
        let Rendering { width, height, .. } = *self.rendering;
        viewpoint::ray(self.camera, [x, y], [width, height])
    }

    fn centre(&self, x: u32, y: u32) -> Option<Centre> {
        Some(self.centre_of(&self.look(f64::from(x) + 0.5, f64::from(y) + 0.5)?))
    }

    /// What is kept of the surface at a pixel's centre.
    pub(super) fn centre_of(&self, seen: &Seen) -> Centre {
        let toward: DVec3 = seen.position - self.camera.position;
        Centre {
            position: round(seen.position),
            normal: round(seen.normal),
            depth: toward.dot(self.camera.forward) as f32,
            albedo: self.world.albedo(seen),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use twoforms_estimator::sampler::Sampler;
    use twoforms_estimator::strategy::Strategy;
    use twoforms_estimator::technique::Kind;
    use twoforms_scene::Scene;

    use super::Painter;
    use crate::image::{Crop, Pixel, PixelFilter, Rendering, Shown};
    use crate::viewpoint;
    use crate::world::World;

    fn world(name: &str) -> World {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenes/{name}.gltf"));
        World::new(Scene::load(&path).expect("a scene of the project")).expect("a scene with lights")
    }

    fn rendering(strategy: Strategy, quantity: Shown) -> Rendering {
        let crop = Crop { x0: 0, x1: 48, y0: 0, y1: 48 };
        Rendering {
            strategy,
            sampler: Sampler::Independent,
            width: 48,
            height: 48,
            crop,
            spp: 5,
            light_samples: 18,
            filter: PixelFilter::Box,
            cull: false,
            quantity,
            seed: 3,
        }
    }

    /// What arithmetic may add to a sample, as a share of it. Means and deviations of samples then differ by no more than that share
    /// of their root mean square.
    const ARITHMETIC: f64 = 3e-6;
    /// The same where the plane of a light is grazed, by points a hundred times nearer to it than to the light: how near is a
    /// difference of coordinates, each rounded for a beam's footprint and for a ray's end.
    const GRAZED: f64 = 2e-5;

    /// Whether two pixels saw the same, by as many rays, but for rounding and for this share of their values.
    fn differ(one: &Pixel, other: &Pixel, share: f64) -> bool {
        let apart = |c: usize| {
            let [deviation, of_other] = [one, other].map(|pixel| pixel.variance[c].sqrt());
            let rounding = ARITHMETIC * one.mean[c].hypot(deviation);
            let close = |a: f64, b: f64| (a - b).abs() <= share * (a.abs() + b.abs()) + rounding;
            !(close(one.mean[c], other.mean[c]) && close(deviation, of_other))
        };
        (0..3).any(apart) || one.rays != other.rays || one.centre.is_some() != other.centre.is_some()
    }

    /// Beams and rays draw the same samples, which differ by rounding alone, in few pixels because the plane of a light is grazed, and
    /// by more within rounding of an edge.
    #[test]
    fn beams_see_what_rays_see() {
        let mut pixels = [0, 0];
        let names = ["cornell-box", "two-lights", "square-light", "nori-light-3", "tiny-far-light", "furnace"];
        for (name, polished) in names.map(|name| (name, false)).into_iter().chain([("two-lights", true)]) {
            let mut world = world(name);
            for material in &mut world.scene.materials {
                (material.specular, material.roughness) = if polished { (1.0, 0.4) } else { (0.0, 1.0) };
            }
            let auto = viewpoint::auto(&world.scene.mesh);
            let camera = world.scene.cameras.first().or(auto.as_ref()).expect("a camera");
            for strategy in Strategy::all_in_images() {
                if polished && strategy.needs_unoccluded() {
                    continue;
                }
                let rendering = rendering(
                    strategy,
                    if strategy == Strategy::from(Kind::HemisphereUniform) {
                        Shown::Irradiance
                    } else {
                        Shown::Radiance
                    },
                );
                let painter = Painter::new(&rendering, &world, camera);
                let beams = rendering.run(&world, camera, &|_| ()).expect("finite samples");
                let rays = rendering.crop.pixels().map(|[x, y]| painter.pixel(x, y).expect("finite samples"));
                let pairs: Vec<_> = beams.iter().zip(rays).collect();
                let differing = |share: f64| pairs.iter().filter(|(beam, ray)| differ(beam, ray, share)).count();
                let [rounded, more] = [0.0, GRAZED].map(differing);
                pixels[0] += more;
                pixels[1] += pairs.len();
                assert!(
                    rounded * 50 <= pairs.len() && more <= 8,
                    "{name}, {strategy}: {rounded}, {more} pixels differ"
                );
            }
        }
        let [differing, all] = pixels;
        assert!(all > 0 && differing * 500 < all, "{differing} of {all} pixels differ");
    }
}
