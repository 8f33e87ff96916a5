//! Camera samples side by side: where they look, what they meet, what that is worth.

use std::ops::Range;

use glam::DVec3;
use twoforms_estimator::batch::Batch;
use twoforms_estimator::estimator::Estimator;
use twoforms_estimator::moments::Moments;
use twoforms_estimator::numbers::{BATCH, Numbers};
use twoforms_estimator::sampler::{ROW, Row, Sampler};
use twoforms_estimator::xi::Key;
use twoforms_geometry::lanes::{Instructions, Kernel};
use twoforms_geometry::real::{Mask, Real, Word};
use twoforms_geometry::vector::{Vector, round};
use twoforms_geometry::view::Vista;

/// Camera samples that go together.
pub(super) const SIZE: usize = 512;
/// The pane of a sample that meets nothing.
const NOTHING: u32 = u32::MAX;

/// Some camera samples of a tile. Arrays have one entry a sample.
pub(super) struct Chunk {
    /// Which samples they are.
    pub(super) pieces: Vec<Piece>,
    len: usize,
    streams: [[u32; SIZE]; 2],
    /// The pixel's corner in the tile, in pixels.
    corner: [[f32; SIZE]; 2],
    /// Direction from the eye, in its frame.
    toward: [[f32; SIZE]; 3],
    /// 1/t to the surface along it.
    per_t: [f32; SIZE],
    /// The pane it meets.
    pane: [u32; SIZE],
    /// Mean of the light samples, RGB.
    pub(super) value: [[f64; SIZE]; 3],
    /// Rays asked for by light samples.
    rays: [u32; SIZE],
}

/// Consecutive camera samples of one pixel.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Which pixel of the tile.
    pub(super) pixel: usize,
    /// Its camera samples.
    pub(super) samples: Range<u32>,
    /// Where in the chunk the first is.
    pub(super) start: usize,
}

impl Piece {
    /// Where in the chunk they are.
    pub(super) fn places(&self) -> Range<usize> {
        self.start..self.start + self.samples.len()
    }
}

impl Chunk {
    /// No samples.
    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            pieces: Vec::new(),
            len: 0,
            streams: [[0; SIZE]; 2],
            corner: [[0.0; SIZE]; 2],
            toward: [[0.0; SIZE]; 3],
            per_t: [0.0; SIZE],
            pane: [NOTHING; SIZE],
            value: [[0.0; SIZE]; 3],
            rays: [0; SIZE],
        })
    }

    /// Removes all samples.
    pub(super) fn clear(&mut self) {
        self.pieces.clear();
        self.value = [[0.0; SIZE]; 3];
        self.rays = [0; SIZE];
        self.len = 0;
    }

    /// Whether so many more samples find room.
    pub(super) fn has_room(&self, more: usize) -> bool {
        self.len + more <= SIZE
    }

    /// Holds directions from the eye, in its frame, of so many samples: as many as there is room for at most.
    pub(super) fn aim(&mut self, directions: &[DVec3]) {
        self.clear();
        self.len = directions.len();
        for (k, &direction) in directions.iter().enumerate() {
            [self.toward[0][k], self.toward[1][k], self.toward[2][k]] = round(direction);
        }
    }

    /// Adds camera samples of a pixel with this number in the image and this corner in the tile.
    pub(super) fn push(&mut self, pixel: usize, samples: Range<u32>, number: u32, [x, y]: [u32; 2]) {
        let piece = Piece { pixel, samples, start: self.len };
        for (k, sample) in piece.places().zip(piece.samples.clone()) {
            (self.streams[0][k], self.streams[1][k]) = (number, sample);
            (self.corner[0][k], self.corner[1][k]) = (x as f32, y as f32);
        }
        self.len += piece.samples.len();
        self.pieces.push(piece);
    }

    /// The panes that are met, once each.
    pub(super) fn panes(&self) -> Vec<u32> {
        let mut met: Vec<u32> = Vec::new();
        let mut last = NOTHING;
        for &pane in &self.pane[..self.len] {
            if pane != last && pane != NOTHING && !met.contains(&pane) {
                met.push(pane);
            }
            last = pane;
        }
        met
    }

    /// The samples that meet a pane.
    pub(super) fn that_meet(&self, pane: u32) -> impl Iterator<Item = usize> + use<'_> {
        (0..self.len).filter(move |&k| self.pane[k] == pane)
    }

    /// Direction of a sample in the frame of the eye.
    pub(super) fn toward(&self, k: usize) -> [f32; 3] {
        [self.toward[0][k], self.toward[1][k], self.toward[2][k]]
    }

    /// The pane that a sample meets.
    pub(super) fn pane(&self, k: usize) -> Option<usize> {
        (self.pane[k] != NOTHING).then_some(self.pane[k] as usize)
    }

    /// The stream of a sample.
    pub(super) fn stream(&self, k: usize) -> [u32; 2] {
        [self.streams[0][k], self.streams[1][k]]
    }

    /// Which random numbers the camera samples from `k` on take: each pixel has a stream, and its samples follow each other
    /// in it.
    #[inline(always)]
    fn row(&self, k: usize, samples: &Samples) -> Row {
        let (mut streams, mut first) = ([[0; ROW]; 2], [0; ROW]);
        for lane in 0..ROW.min(SIZE - k) {
            streams[0][lane] = self.streams[0][k + lane];
            first[lane] = self.streams[1][k + lane] * samples.each;
        }
        Row { key: samples.key, n: samples.spp * samples.each, streams, first }
    }

    /// Adds to the value of a sample, RGB, and to its rays.
    pub(super) fn add(&mut self, k: usize, value: [f64; 3], rays: u32) {
        for c in 0..3 {
            self.value[c][k] += value[c];
        }
        self.rays[k] += rays;
    }

    /// Rays asked for by the light samples of some camera samples.
    pub(super) fn rays(&self, places: Range<usize>) -> u64 {
        self.rays[places].iter().map(|&rays| u64::from(rays)).sum()
    }
}

/// Where the camera samples look.
pub(super) struct Aim<'c> {
    pub(super) chunk: &'c mut Chunk,
    /// Direction through the tile's first corner, and what a pixel to the right and a pixel down add to it.
    pub(super) axes: [[f32; 3]; 3],
    pub(super) samples: Samples,
    /// Whether samples are spread over the pixel.
    pub(super) spread: bool,
}

impl Kernel for Aim<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real>(self) {
        let [first, right, down] = self.axes;
        let chunk = self.chunk;
        let (samples, mut numbers) = (&self.samples, Numbers::new(1));
        for k in (0..chunk.len).step_by(R::LANES) {
            let [dx, dy] = if self.spread {
                samples.fill(&chunk.row(k, samples), 1, &mut numbers);
                numbers.from(0).xi::<R>(0).uv()
            } else {
                [R::splat(0.5), R::splat(0.5)]
            };
            let (x, y) = (R::load(&chunk.corner[0][k..]) + dx, R::load(&chunk.corner[1][k..]) + dy);
            let toward = Vector::<R>::splat(first) + Vector::splat(right) * x + Vector::splat(down) * y;
            toward.x.store(&mut chunk.toward[0][k..]);
            toward.y.store(&mut chunk.toward[1][k..]);
            toward.z.store(&mut chunk.toward[2][k..]);
        }
    }
}

/// What is met in the directions of a chunk.
pub(super) struct Look<'c> {
    pub(super) chunk: &'c mut Chunk,
    pub(super) vista: &'c Vista,
}

impl Kernel for Look<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real>(self) {
        let Self { chunk, vista } = self;
        for k in (0..chunk.len).step_by(R::LANES) {
            let [x, y, z] = chunk.toward.each_ref();
            let (glimpse, some) = vista.look(Vector::new(R::load(&x[k..]), R::load(&y[k..]), R::load(&z[k..]))).parts();
            glimpse.per_t.store(&mut chunk.per_t[k..]);
            R::select_word(some, glimpse.pane, R::Word::splat(NOTHING)).store(&mut chunk.pane[k..]);
        }
    }
}

/// Adds the camera samples of each piece to what their pixels come to; answers with the first piece whose value is not
/// finite.
pub(super) struct AddUp<'c> {
    pub(super) chunk: &'c Chunk,
    pub(super) sums: &'c mut [Sum],
}

/// What the samples of one pixel come to so far.
#[derive(Clone, Default)]
pub(super) struct Sum {
    /// Of the values, RGB.
    pub(super) channels: [Moments; 3],
    /// Rays asked for.
    pub(super) rays: u64,
}

impl<'c> Kernel for AddUp<'c> {
    type Output = Option<&'c Piece>;

    #[inline(always)]
    fn run<R: Real>(self) -> Option<&'c Piece> {
        let Self { chunk, sums } = self;
        for piece in &chunk.pieces {
            let (sum, places) = (&mut sums[piece.pixel], piece.places());
            for c in 0..3 {
                sum.channels[c] = sum.channels[c] + Moments::by::<R::Wide>(&chunk.value[c][places.clone()]);
            }
            sum.rays += chunk.rays(places.clone()) + places.len() as u64;
            if !sum.channels.iter().all(|moments| moments.mean.is_finite()) {
                return Some(piece);
            }
        }
        None
    }
}

/// The samples of a pixel, shared out among its camera samples.
#[derive(Clone, Copy)]
pub(super) struct Samples {
    pub(super) sampler: Sampler,
    pub(super) key: Key,
    /// How many of the pixel's samples each camera sample has.
    pub(super) each: u32,
    /// Camera samples of a pixel.
    pub(super) spp: u32,
    pub(super) instructions: Instructions,
}

impl Samples {
    fn fill(&self, row: &Row, length: usize, numbers: &mut Numbers) {
        row.fill(self.sampler, self.instructions, length, numbers);
    }
}

/// The light samples of the camera samples that meet one pane, from where they meet it.
pub(super) struct Receive<'e> {
    pub(super) estimator: &'e dyn Estimator,
    pub(super) light: Samples,
    pub(super) pane: u32,
    /// The vectors that give the coordinates of a point of the pane from its direction.
    pub(super) along: [[f32; 3]; 2],
}

/// Indices of light samples that go together: each for a row of camera samples.
const AT_ONCE: usize = BATCH / ROW;

impl Receive<'_> {
    /// Samples the lights for all of the chunk that meets the pane, a row of camera samples at a time.
    pub(super) fn all(&self, chunk: &mut Chunk) {
        let mut batch = Batch::new(self.estimator.pairs());
        batch.from_points = true;
        for k in (0..chunk.len).step_by(ROW) {
            if self.look_from(chunk, k, &mut batch) {
                self.row(chunk, k, &mut batch);
            }
        }
    }

    /// Where the light samples of a row look from, the same for each index; whether any of the row meets the pane.
    fn look_from(&self, chunk: &Chunk, k: usize, batch: &mut Batch) -> bool {
        let instructions = self.light.instructions;
        let any = instructions.run(LookFrom { chunk, k, pane: self.pane, along: self.along, batch });
        for index in 1..AT_ONCE.min(self.light.each as usize) {
            for c in 0..3 {
                batch.start[c].copy_within(..ROW, index * ROW);
            }
            batch.wanted.copy_within(..ROW, index * ROW);
        }
        any
    }

    fn row(&self, chunk: &mut Chunk, k: usize, batch: &mut Batch) {
        let mut row = chunk.row(k, &self.light);
        let (mut sums, mut divisors) = ([[0.0; ROW]; 3], [[0.0; ROW]; 3]);
        for start in (0..self.light.each as usize).step_by(AT_ONCE) {
            let indices = AT_ONCE.min(self.light.each as usize - start);
            batch.length = indices * ROW;
            row.fill(self.light.sampler, self.light.instructions, indices, &mut batch.numbers);
            self.estimator.evaluate(self.light.instructions, batch);
            add(&mut sums, &batch.worth, indices);
            if self.estimator.is_quotient() {
                add(&mut divisors, &batch.divisor, indices);
            }
            row.first.iter_mut().for_each(|first| *first += indices as u32);
            for (entry, rays) in batch.rays[..batch.length].iter().enumerate() {
                chunk.rays[k + entry % ROW] += rays;
            }
        }
        for lane in (0..ROW).filter(|&lane| batch.wanted[lane] == 1) {
            let of_lane = |sums: &[[f64; ROW]; 3]| [sums[0][lane], sums[1][lane], sums[2][lane]];
            let value = self.estimator.estimate(of_lane(&sums), of_lane(&divisors), self.light.each);
            for c in 0..3 {
                chunk.value[c][k + lane] += value[c];
            }
        }
    }
}

/// Adds what a batch holds for each index to the sums of a row.
fn add(sums: &mut [[f64; ROW]; 3], values: &[[f32; BATCH]; 3], indices: usize) {
    for c in 0..3 {
        for index in 0..indices {
            for lane in 0..ROW {
                sums[c][lane] += f64::from(values[c][index * ROW + lane]);
            }
        }
    }
}

/// Where a row of camera samples meets a pane, in the frame of the view from it.
struct LookFrom<'c> {
    chunk: &'c Chunk,
    k: usize,
    pane: u32,
    along: [[f32; 3]; 2],
    batch: &'c mut Batch,
}

impl Kernel for LookFrom<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<R: Real>(self) -> bool {
        let Self { chunk, k: first, pane, along: [u, v], batch } = self;
        let mut any = false;
        for lane in (0..ROW).step_by(R::LANES) {
            let k = first + lane;
            let inside = R::below(R::Word::counting(k as u32), R::Word::splat(chunk.len as u32));
            let wanted = inside & R::same(R::Word::load(&chunk.pane[k..]), R::Word::splat(pane));
            any |= wanted.any();
            let [x, y, z] =
                [R::load(&chunk.toward[0][k..]), R::load(&chunk.toward[1][k..]), R::load(&chunk.toward[2][k..])];
            let (toward, t) = (Vector::new(x, y, z), R::one() / R::load(&chunk.per_t[k..]));
            (Vector::splat(u).dot(toward) * t).store(&mut batch.start[0][lane..]);
            (Vector::splat(v).dot(toward) * t).store(&mut batch.start[1][lane..]);
            R::zero().store(&mut batch.start[2][lane..]);
            R::select_word(wanted, R::Word::splat(1), R::Word::splat(0)).store(&mut batch.wanted[lane..]);
        }
        any
    }
}
