//! Beams: the samples of a tile share what the eye sees through it, and what each surface there sees of the lights.

use glam::DVec3;
use twoforms_estimator::density::Density;
use twoforms_estimator::estimator::{Estimator, NotFinite};
use twoforms_estimator::formulation::Formulation;
use twoforms_estimator::moments::Moments;
use twoforms_estimator::strategy::Kernel;
use twoforms_geometry::frame::Frame;
use twoforms_geometry::lanes::{self, Instructions};
use twoforms_geometry::real::Real;
use twoforms_geometry::vector::{Vector, round};
use twoforms_geometry::view::{Pane, View, Vista};

use super::chunk::{self, Chunk, LightSamples, Look, Piece, Receive};
use super::painter::{Painter, Surface};
use super::{Centre, Crop, Pixel, PixelFilter};
use crate::error::BrokenPixel;
use crate::world::Seen;

/// What the eye sees through a tile.
pub(super) struct Beam<'a> {
    painter: &'a Painter<'a>,
    tile: Crop,
    eye: Frame,
    vista: Vista,
    /// Direction through the tile's first corner, and what a pixel to the right and a pixel down add to it.
    axes: [DVec3; 3],
}

/// A surface seen through the tile.
struct Stage<'a> {
    surface: Surface<'a>,
    lit: Option<Lit<'a>>,
}

/// What all of the surface seen through the tile sees of the lights.
struct Lit<'a> {
    view: View<'a>,
    /// The vectors that give the coordinates of a point of the pane from its direction.
    along: [[f32; 3]; 2],
}

/// What the samples of one pixel come to so far.
#[derive(Clone, Default)]
struct Sum {
    channels: [Moments; 3],
    rays: u64,
}

impl<'a> Beam<'a> {
    /// The beam through a tile; none where too much is seen through it.
    pub(super) fn new(painter: &'a Painter<'a>, tile: Crop) -> Option<Self> {
        let eye = Frame::new(painter.camera.position, painter.camera.forward);
        let toward = |x: u32, y: u32| eye.to_local(painter.toward(f64::from(x), f64::from(y)));
        let Crop { x0, x1, y0, y1 } = tile;
        let corners = [toward(x0, y0), toward(x1, y0), toward(x1, y1), toward(x0, y1)];
        let vista = Vista::new(&painter.world.geometry, &eye, &corners)?;
        let side = f64::from(tile.width());
        let axes = [corners[0], (corners[1] - corners[0]) / side, (corners[3] - corners[0]) / side];
        Some(Self { painter, tile, eye, vista, axes })
    }

    /// The pixels of the tile that lie `inside`, row by row.
    pub(super) fn pixels(&self, inside: Crop) -> Result<Vec<Pixel>, BrokenPixel> {
        let places: Vec<[u32; 2]> = inside.pixels().collect();
        let mut stages: Vec<Option<Stage>> = self.vista.panes().iter().map(|_| None).collect();
        let mut sums = vec![Sum::default(); places.len()];
        let (mut chunk, spp) = (Chunk::new(), self.painter.rendering.spp);
        for (pixel, &[x, y]) in places.iter().enumerate() {
            for first in (0..spp).step_by(chunk::SIZE) {
                let samples = first..spp.min(first.saturating_add(chunk::SIZE as u32));
                if !chunk.has_room(samples.len()) {
                    self.evaluate(&mut chunk, &mut stages, &places, &mut sums)?;
                }
                chunk.push(pixel, samples, self.painter.index(x, y), [x - self.tile.x0, y - self.tile.y0]);
            }
        }
        self.evaluate(&mut chunk, &mut stages, &places, &mut sums)?;
        let pixel = |(&[x, y], sum): (&[u32; 2], &Sum)| Pixel::new(sum.channels, sum.rays, self.centre(x, y));
        Ok(places.iter().zip(&sums).map(pixel).collect())
    }

    /// Evaluates the samples of a chunk, adds them to the pixels' sums, and empties it.
    fn evaluate(
        &self,
        chunk: &mut Chunk,
        stages: &mut [Option<Stage<'a>>],
        places: &[[u32; 2]],
        sums: &mut [Sum],
    ) -> Result<(), BrokenPixel> {
        let spread = self.painter.rendering.filter == PixelFilter::Box;
        let key = self.painter.camera_key;
        lanes::run(Look { chunk, vista: &self.vista, axes: self.axes.map(round), key, spread });
        for pane in chunk.panes() {
            let stage = stages[pane as usize].get_or_insert_with(|| self.stage(&self.vista.panes()[pane as usize]));
            self.light(chunk, stage, pane).map_err(|(k, source)| self.broken(chunk, places, k, source))?;
        }
        for piece in &chunk.pieces {
            let [x, y] = places[piece.pixel];
            let finite = lanes::run(AddPiece { chunk, piece, sum: &mut sums[piece.pixel] });
            if !finite {
                return Err(self.not_finite([x, y], chunk, piece));
            }
        }
        chunk.clear();
        Ok(())
    }

    /// Samples the lights wherever a pane is met: together, or where its points see the lights too differently one by one.
    fn light(&self, chunk: &mut Chunk, stage: &Stage, pane: u32) -> Result<(), (usize, NotFinite)> {
        let emission = stage.surface.emission;
        if emission != [0.0; 3] {
            for k in chunk.that_meet(pane).collect::<Vec<_>>() {
                chunk.add(k, emission, 0);
            }
        }
        let Some(query) = &stage.surface.query else { return Ok(()) };
        let rendering = self.painter.rendering;
        if let Some(Lit { view, along }) = &stage.lit {
            let light =
                LightSamples { sampler: rendering.sampler, key: self.painter.light_key, n: rendering.light_samples };
            self.painter.prepared.run(view, query, Lighting { chunk, light, pane, along: *along });
            return Ok(());
        }
        for k in chunk.that_meet(pane).collect::<Vec<_>>() {
            let toward = DVec3::from_array(chunk.toward(k).map(f64::from));
            let seen = self.seen(&self.vista.panes()[pane as usize], toward);
            let (value, rays) = self.painter.receive(&seen, query, chunk.stream(k)).map_err(|source| (k, source))?;
            chunk.add(k, value, rays as u32);
        }
        Ok(())
    }

    fn stage(&self, pane: &Pane) -> Stage<'a> {
        let centroid = pane.outline.iter().sum::<DVec3>() / pane.outline.len() as f64;
        let seen = self.seen(pane, centroid);
        let frame = Frame::new(seen.position, seen.normal);
        let local = |&corner: &DVec3| frame.localize(self.eye.x() + self.eye.to_world(corner)).with_z(0.0);
        let footprint: Vec<DVec3> = pane.outline.iter().map(local).collect();
        let x = self.eye.localize(seen.position);
        let along = [DVec3::X, DVec3::Y].map(|axis| pane.coordinate(self.eye.to_local(frame.to_world(axis)), x));
        let view = View::over(&self.painter.world.geometry, frame, &footprint);
        Stage { surface: self.painter.surface(&seen), lit: view.map(|view| Lit { view, along }) }
    }

    /// The point of a pane's triangle in a direction from the eye, in its frame.
    fn seen(&self, pane: &Pane, toward: DVec3) -> Seen {
        let triangle = self.painter.world.geometry.mesh().triangle(pane.triangle);
        let (cross, toward) = (triangle.cross().normalize(), self.eye.to_world(toward));
        let distance = cross.dot(triangle.a.as_dvec3() - self.eye.x()) / cross.dot(toward);
        let front = cross.dot(toward) < 0.0;
        let normal = if front { cross } else { -cross };
        Seen { position: self.eye.x() + toward * distance, normal, distance, triangle: pane.triangle, front }
    }

    fn centre(&self, x: u32, y: u32) -> Option<Centre> {
        let [first, right, down] = self.axes;
        let (right_by, down_by) = (f64::from(x - self.tile.x0) + 0.5, f64::from(y - self.tile.y0) + 0.5);
        let toward = first + right * right_by + down * down_by;
        let (glimpse, some) = self.vista.look(Vector::from(round(toward))).parts();
        some.then(|| self.painter.centre_of(&self.seen(&self.vista.panes()[glimpse.pane as usize], toward)))
    }

    fn broken(&self, chunk: &Chunk, places: &[[u32; 2]], k: usize, source: NotFinite) -> BrokenPixel {
        let pixel = chunk.pieces.iter().find(|piece| piece.places().contains(&k)).map_or(0, |piece| piece.pixel);
        let [x, y] = places[pixel];
        BrokenPixel { strategy: self.painter.rendering.strategy, x, y, sample: chunk.stream(k)[1], source }
    }

    /// The first camera sample of a piece whose value is not finite.
    fn not_finite(&self, [x, y]: [u32; 2], chunk: &Chunk, piece: &Piece) -> BrokenPixel {
        let broken = |k: &usize| chunk.value.iter().any(|channel| !channel[*k].is_finite());
        let k = piece.places().find(broken).unwrap_or(piece.start);
        let source = self.source_of(chunk, k);
        BrokenPixel { strategy: self.painter.rendering.strategy, x, y, sample: chunk.stream(k)[1], source }
    }

    /// The light sample that is not finite, found one by one; if it is finite there, the camera sample's value, beside the
    /// random words of its first light sample.
    fn source_of(&self, chunk: &Chunk, k: usize) -> NotFinite {
        let pane = self.vista.panes().get(chunk.pane(k) as usize);
        let one_by_one = pane.and_then(|pane| {
            let seen = self.seen(pane, DVec3::from_array(chunk.toward(k).map(f64::from)));
            self.painter.receive(&seen, &self.painter.surface(&seen).query?, chunk.stream(k)).err()
        });
        one_by_one.unwrap_or_else(|| NotFinite {
            index: 0,
            value: chunk.value.each_ref().map(|channel| channel[k] as f32),
            words: self.painter.light_stream(chunk.stream(k)).xi(0).words(),
        })
    }
}

/// Adds the camera samples of a piece to what their pixel comes to; says whether all is finite.
struct AddPiece<'c> {
    chunk: &'c Chunk,
    piece: &'c Piece,
    sum: &'c mut Sum,
}

impl lanes::Kernel for AddPiece<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<R: Real>(self) -> bool {
        let places = self.piece.places();
        for c in 0..3 {
            self.sum.channels[c] = self.sum.channels[c] + Moments::by::<R::Wide>(&self.chunk.value[c][places.clone()]);
        }
        self.sum.rays += self.chunk.rays(places.clone()) + places.len() as u64;
        self.sum.channels.iter().all(|moments| moments.mean.is_finite())
    }
}

/// [`Receive`] with its estimator yet to be chosen.
struct Lighting<'c> {
    chunk: &'c mut Chunk,
    light: LightSamples,
    pane: u32,
    along: [[f32; 3]; 2],
}

impl Kernel for Lighting<'_> {
    type Output = ();

    fn run<F: Formulation, D: Density<F::Measure>>(self, estimator: &Estimator<F, D>) {
        let Self { chunk, light, pane, along } = self;
        Instructions::best().run(Receive { chunk, estimator, light, pane, along });
    }
}
