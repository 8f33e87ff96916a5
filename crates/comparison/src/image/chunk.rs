//! Camera samples side by side: where they look, what they meet, what that is worth.

use std::ops::Range;

use glam::DVec3;
use twoforms_estimator::moments::Moments;
use twoforms_estimator::numbers::{BATCH, Numbers};
use twoforms_estimator::sampler::{ROW, ROWS, Row};
use twoforms_geometry::lanes::Kernel;
use twoforms_geometry::real::{Real, Word};
use twoforms_geometry::vector::{Vector, round};
use twoforms_geometry::view::Vista;

use super::samples::Samples;

/// Camera samples that go together.
pub(super) const SIZE: usize = 512;
/// The pane of a sample that meets nothing.
const NOTHING: u32 = u32::MAX;

/// Some camera samples of a tile. Arrays have one entry a sample, and stand on lines of the cache.
#[repr(C, align(64))]
pub(super) struct Chunk {
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
    pub(super) rays: [u32; SIZE],
    /// Which samples they are.
    pub(super) pieces: Vec<Piece>,
    len: usize,
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
        self.value.iter_mut().for_each(|channel| channel[..self.len].fill(0.0));
        self.rays[..self.len].fill(0);
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

    /// Where the rows begin in which some sample meets a pane.
    pub(super) fn rows_that_meet(&self, pane: u32) -> impl Iterator<Item = usize> + use<'_> {
        let meets = move |&from: &usize| self.pane[from..from + ROW].contains(&pane);
        (0..self.len).step_by(ROW).filter(meets)
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

    /// The rows from a sample on, as many as make a batch.
    fn rows_from(&self, k: usize) -> Vec<Row> {
        (k..self.len).step_by(ROW).take(ROWS).map(|from| Row { from, index: 0 }).collect()
    }

    /// The streams of all samples, in two parts.
    pub(super) fn streams(&self) -> [&[u32; SIZE]; 2] {
        self.streams.each_ref()
    }

    /// Of the samples from `k` on, 1 for those that meet a pane and 0 for others.
    #[inline(always)]
    pub(super) fn meets<R: Real>(&self, k: usize, pane: u32) -> R::Word {
        let met = R::same(R::Word::load(&self.pane[k..]), R::Word::splat(pane));
        R::select_word(met, R::Word::splat(1), R::Word::splat(0))
    }

    /// Adds to the value of a sample, RGB, and to its rays.
    pub(super) fn add(&mut self, k: usize, value: [f64; 3], rays: u32) {
        for c in 0..3 {
            self.value[c][k] += value[c];
        }
        self.rays[k] += rays;
    }

    /// Multiplies the value of a sample, RGB.
    pub(super) fn colour(&mut self, k: usize, by: [f64; 3]) {
        for c in 0..3 {
            self.value[c][k] *= by[c];
        }
    }

    /// Directions of the samples from `k` on, in the frame of the eye, and 1/t to the surfaces along them.
    #[inline(always)]
    pub(super) fn direction<R: Real>(&self, k: usize) -> (Vector<R>, R) {
        let [x, y, z] = self.toward.each_ref();
        (Vector::new(R::load(&x[k..]), R::load(&y[k..]), R::load(&z[k..])), R::load(&self.per_t[k..]))
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
        let mut numbers = Numbers::new(1);
        for k in (0..chunk.len).step_by(R::LANES) {
            if self.spread && k % BATCH == 0 {
                self.samples.fill(chunk.streams(), &chunk.rows_from(k), &mut numbers);
            }
            let [dx, dy] =
                if self.spread { numbers.from(k % BATCH).xi::<R>(0).uv() } else { [R::splat(0.5), R::splat(0.5)] };
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
        let len = chunk.len;
        chunk.pane[len..len.next_multiple_of(ROW)].fill(NOTHING);
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
