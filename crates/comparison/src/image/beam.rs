//! Beams: the samples of a tile share what the eye sees through it, and what each surface there sees of the lights.

use glam::DVec3;
use twoforms_estimator::batch::Batch;
use twoforms_estimator::estimate::NotFinite;
use twoforms_estimator::strategy::Known;
use twoforms_geometry::frame::Frame;
use twoforms_geometry::lanes;
use twoforms_geometry::vector::round;
use twoforms_geometry::view::{View, Vista};

use super::chunk::{self, AddUp, Aim, Chunk, Look, Piece, Sum};
use super::face::Face;
use super::painter::{Painter, Surface, Varies};
use super::receive::Receive;
use super::{Centre, Crop, Pixel, PixelFilter, Rendering, tile};
use crate::error::BrokenPixel;
use crate::world::Seen;

/// What the eye sees through a tile.
pub(super) struct Beam<'a> {
    painter: &'a Painter<'a>,
    tile: Crop,
    eye: Frame,
    vista: Vista,
    /// The face of each pane of the vista.
    faces: Vec<Face>,
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
        let faces = vista.panes().iter().map(|pane| Face::new(painter.world, eye.x(), pane.triangle)).collect();
        Some(Self { painter, tile, eye, vista, faces, axes })
    }

    /// The pixels of the tile that lie `inside`, row by row; `chunk` is room to work in.
    pub(super) fn pixels(&self, inside: Crop, chunk: &mut Chunk) -> Result<Vec<Pixel>, BrokenPixel> {
        let places: Vec<[u32; 2]> = inside.pixels().collect();
        let centres = self.centres(&places, chunk);
        let sums = self.sums(&places, chunk)?;
        Ok(sums.into_iter().zip(centres).map(|(sum, centre)| Pixel::new(sum.channels, sum.rays, centre)).collect())
    }

    /// What the camera samples of each pixel come to.
    fn sums(&self, places: &[[u32; 2]], chunk: &mut Chunk) -> Result<Vec<Sum>, BrokenPixel> {
        let mut stages: Vec<Option<Stage>> = self.faces.iter().map(|_| None).collect();
        let mut sums = vec![Sum::default(); places.len()];
        let Rendering { spp, strategy, .. } = *self.painter.rendering;
        let mut batch = Batch::new(strategy.pairs());
        chunk.clear();
        for (pixel, &[x, y]) in places.iter().enumerate() {
            for first in (0..spp).step_by(chunk::SIZE) {
                let samples = first..spp.min(first.saturating_add(chunk::SIZE as u32));
                if !chunk.has_room(samples.len()) {
                    self.evaluate(chunk, &mut batch, &mut stages, places, &mut sums)?;
                }
                chunk.push(pixel, samples, self.painter.index(x, y), [x - self.tile.x0, y - self.tile.y0]);
            }
        }
        self.evaluate(chunk, &mut batch, &mut stages, places, &mut sums)?;
        Ok(sums)
    }

    /// Evaluates the samples of a chunk, adds them to the pixels' sums, and empties it.
    fn evaluate(
        &self,
        chunk: &mut Chunk,
        batch: &mut Batch,
        stages: &mut [Option<Stage<'a>>],
        places: &[[u32; 2]],
        sums: &mut [Sum],
    ) -> Result<(), BrokenPixel> {
        let spread = self.painter.rendering.filter == PixelFilter::Box;
        lanes::run(Aim { chunk, axes: self.axes.map(round), samples: self.painter.camera_samples(), spread });
        lanes::run(Look { chunk, vista: &self.vista });
        for pane in 0..self.faces.len() as u32 {
            if chunk.rows_that_meet(pane).next().is_none() {
                continue;
            }
            let stage = stages[pane as usize].get_or_insert_with(|| self.stage(pane as usize));
            self.light(chunk, batch, stage, pane).map_err(|(k, source)| self.broken(chunk, places, k, source))?;
        }
        if let Some(piece) = lanes::run(AddUp { chunk, sums }) {
            return Err(self.not_finite(places[piece.pixel], chunk, piece));
        }
        chunk.clear();
        Ok(())
    }

    /// Samples the lights wherever a pane is met: together, or where its points see the lights too differently one by one.
    fn light(&self, chunk: &mut Chunk, batch: &mut Batch, stage: &Stage, pane: u32) -> Result<(), (usize, NotFinite)> {
        if stage.surface.varies == Varies::Wholly {
            return self.shade_each(chunk, batch, pane);
        }
        let emission = stage.surface.emission;
        if emission != [0.0; 3] {
            for k in chunk.that_meet(pane).collect::<Vec<_>>() {
                chunk.add(k, emission, 0);
            }
        }
        self.receive(chunk, batch, stage, pane)?;
        if stage.surface.varies == Varies::InColour {
            for k in chunk.that_meet(pane).collect::<Vec<_>>() {
                let colour = self.painter.colour(&self.met(chunk, k, pane));
                chunk.colour(k, colour.albedo);
                chunk.add(k, colour.emission, 0);
            }
        }
        Ok(())
    }

    /// Asks about each point by itself.
    fn shade_each(&self, chunk: &mut Chunk, batch: &mut Batch, pane: u32) -> Result<(), (usize, NotFinite)> {
        for k in chunk.that_meet(pane).collect::<Vec<_>>() {
            let shaded = self.painter.shade(&self.met(chunk, k, pane), chunk.stream(k), batch);
            let shaded = shaded.map_err(|source| (k, source))?;
            chunk.add(k, shaded.value, shaded.rays as u32 - 1);
        }
        Ok(())
    }

    /// Adds the light that the pane receives, wherever it is met.
    fn receive(
        &self,
        chunk: &mut Chunk,
        batch: &mut Batch,
        stage: &Stage,
        pane: u32,
    ) -> Result<(), (usize, NotFinite)> {
        let Some(query) = &stage.surface.query else { return Ok(()) };
        if let Some(Lit { view, along }) = &stage.lit {
            let light = self.painter.light_samples();
            let estimator = self.painter.prepared.at(view, query, &Known::default());
            Receive { estimator: &*estimator, light, pane, along: *along }.all(chunk, batch);
            return Ok(());
        }
        for k in chunk.that_meet(pane).collect::<Vec<_>>() {
            let seen = self.met(chunk, k, pane);
            // What is asked knows where the eye is by the frame of the point.
            let Some(query) = self.painter.surface(&seen).query else { continue };
            let received = self.painter.receive(&seen, &query, chunk.stream(k), batch);
            let (value, rays) = received.map_err(|source| (k, source))?;
            chunk.add(k, value, rays as u32);
        }
        Ok(())
    }

    fn stage(&self, index: usize) -> Stage<'a> {
        let pane = &self.vista.panes()[index];
        let centroid = pane.outline.iter().sum::<DVec3>() / pane.outline.len() as f64;
        let seen = self.seen(index, centroid);
        let frame = Frame::new(seen.position, seen.normal);
        let local = |&corner: &DVec3| frame.localize(self.eye.x() + self.eye.to_world(corner)).with_z(0.0);
        let footprint: Vec<DVec3> = pane.outline.iter().map(local).collect();
        let x = self.eye.localize(seen.position);
        let along = [DVec3::X, DVec3::Y].map(|axis| pane.coordinate(self.eye.to_local(frame.to_world(axis)), x));
        let shared = !self.painter.prepared.depends_on_x();
        let view = shared.then(|| View::over(&self.painter.world.geometry, frame, &footprint)).flatten();
        Stage { surface: self.painter.surface(&seen), lit: view.map(|view| Lit { view, along }) }
    }

    /// The point of a pane's plane in a direction from the eye, in its frame.
    fn seen(&self, pane: usize, toward: DVec3) -> Seen {
        self.faces[pane].seen(self.eye.to_world(toward))
    }

    /// The point of a pane that a camera sample meets.
    fn met(&self, chunk: &Chunk, k: usize, pane: u32) -> Seen {
        self.seen(pane as usize, DVec3::from_array(chunk.toward(k).map(f64::from)))
    }

    /// What lies at the centres of pixels.
    fn centres(&self, places: &[[u32; 2]], chunk: &mut Chunk) -> Vec<Option<Centre>> {
        const { assert!((tile::SIDE * tile::SIDE) as usize <= chunk::SIZE) };
        let toward: Vec<DVec3> = places.iter().map(|&place| self.toward_centre(place)).collect();
        chunk.aim(&toward);
        lanes::run(Look { chunk, vista: &self.vista });
        let centre = |(k, &toward)| Some(self.painter.centre_of(&self.seen(chunk.pane(k)?, toward)));
        toward.iter().enumerate().map(centre).collect()
    }

    fn toward_centre(&self, [x, y]: [u32; 2]) -> DVec3 {
        let [first, right, down] = self.axes;
        first + right * (f64::from(x - self.tile.x0) + 0.5) + down * (f64::from(y - self.tile.y0) + 0.5)
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
        let one_by_one = chunk.pane(k).and_then(|pane| {
            let seen = self.seen(pane, DVec3::from_array(chunk.toward(k).map(f64::from)));
            let (query, pairs) = (self.painter.surface(&seen).query?, self.painter.rendering.strategy.pairs());
            self.painter.receive(&seen, &query, chunk.stream(k), &mut Batch::new(pairs)).err()
        });
        one_by_one.unwrap_or_else(|| NotFinite {
            index: 0,
            value: chunk.value.each_ref().map(|channel| channel[k] as f32),
            words: self.painter.words(chunk.stream(k)),
        })
    }
}
