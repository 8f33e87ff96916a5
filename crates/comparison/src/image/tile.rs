//! Tiles: the squares in which an image is painted, each with its rows of the image.

use super::{Crop, Pixel};

/// Pixels along the side of a tile. Tiles lie at multiples of it, whatever part of the image is rendered.
pub(super) const SIDE: u32 = 16;

/// A square of pixels, and where those that are wanted go.
pub(super) struct Tile<'i> {
    pub(super) square: Crop,
    /// For each row the part of the image.
    rows: Vec<&'i mut [Pixel]>,
}

impl Tile<'_> {
    /// Sets the wanted pixels, row by row.
    pub(super) fn fill(&mut self, mut pixels: &[Pixel]) {
        for row in &mut self.rows {
            let (here, rest) = pixels.split_at(row.len());
            row.copy_from_slice(here);
            pixels = rest;
        }
    }
}

/// The tiles of an image of these pixels, row by row.
pub(super) fn tiles(crop: Crop, image: &mut [Pixel]) -> Vec<Tile<'_>> {
    let mut rows = image.chunks_mut(crop.width().max(1) as usize);
    let mut tiles = Vec::new();
    for y0 in corners(crop.y0, crop.y1) {
        let square = |x0: u32| Crop { x0, x1: x0 + SIDE, y0, y1: y0 + SIDE };
        let mut band: Vec<Tile> =
            corners(crop.x0, crop.x1).map(|x0| Tile { square: square(x0), rows: Vec::new() }).collect();
        let height = (y0 + SIDE).min(crop.y1) - y0.max(crop.y0);
        for mut row in rows.by_ref().take(height as usize) {
            for tile in &mut band {
                let here = row.split_off_mut(..tile.square.within(crop).width() as usize);
                tile.rows.extend(here);
            }
        }
        tiles.extend(band);
    }
    tiles
}

/// The multiples of a tile's side at which the tiles over these pixels start.
fn corners(from: u32, to: u32) -> impl Iterator<Item = u32> {
    (from / SIDE..to.div_ceil(SIDE)).map(|k| k * SIDE)
}

#[cfg(test)]
mod tests {
    use super::tiles;
    use crate::image::{Crop, Pixel};

    #[test]
    fn tiles_hold_every_pixel_of_a_crop_once_and_in_place() {
        let crop = Crop { x0: 5, x1: 50, y0: 30, y1: 67 };
        let number = |[x, y]: [u32; 2]| Pixel { rays: u64::from(1000 * y + x), ..Pixel::default() };
        let expected: Vec<Pixel> = crop.pixels().map(number).collect();
        let mut image = vec![Pixel::default(); expected.len()];
        for mut tile in tiles(crop, &mut image) {
            let pixels: Vec<Pixel> = tile.square.within(crop).pixels().map(number).collect();
            tile.fill(&pixels);
        }
        assert_eq!(image, expected);
    }
}
