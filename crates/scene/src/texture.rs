//! Textures: images as functions of texture coordinates.

use std::sync::Arc;

use glam::DVec2;

use crate::image::{Encoding, Image};
use crate::sampler::{Filter, Sampler};

/// An image with its sampler: linear red, green, blue and alpha as a function of (u, v). (0, 0) is the corner of the
/// image's first texel, (1, 1) the opposite corner; v runs down.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The image. Counted, since several textures may show it.
    pub image: Arc<Image>,
    /// How it is looked up.
    pub sampler: Sampler,
    /// What its integers mean.
    pub encoding: Encoding,
}

/// The texture over one square between four points of its grid: c₀₀(1−x)(1−y) + c₁₀x(1−y) + c₀₁(1−x)y + c₁₁xy with x
/// and y in [0, 1].
#[derive(Clone, Copy)]
pub(crate) struct Cell([[f32; 4]; 4]);

impl Texture {
    /// Linear red, green, blue and alpha at (u, v), each in [0, 1]; decoded before it is filtered.
    pub fn at(&self, uv: DVec2) -> [f32; 4] {
        let place = self.grid(uv);
        let corner = place.floor();
        self.cell(corner).at(place - corner)
    }

    /// (u, v) in units of texels, such that the texture is one bilinear map between whole numbers.
    pub(crate) fn grid(&self, uv: DVec2) -> DVec2 {
        let place = uv * DVec2::new(f64::from(self.image.width), f64::from(self.image.height));
        match self.sampler.filter {
            Filter::Linear => place - 0.5,
            Filter::Nearest => place,
        }
    }

    /// The square of the grid whose first corner is at whole numbers.
    pub(crate) fn cell(&self, corner: DVec2) -> Cell {
        let x = |i| self.sampler.wrap[0].index(i, self.image.width);
        let y = |j| self.sampler.wrap[1].index(j, self.image.height);
        let texel = |column, row| self.image.texel(column, row, self.encoding);
        let (left, top) = (x(corner.x), y(corner.y));
        match self.sampler.filter {
            Filter::Nearest => Cell([texel(left, top); 4]),
            Filter::Linear => {
                let (right, bottom) = (x(corner.x + 1.0), y(corner.y + 1.0));
                Cell([texel(left, top), texel(right, top), texel(left, bottom), texel(right, bottom)])
            }
        }
    }
}

impl Cell {
    /// The value at (x, y) in the unit square.
    pub fn at(&self, DVec2 { x, y }: DVec2) -> [f32; 4] {
        self.exactly(DVec2 { x, y }).map(|channel| channel as f32)
    }

    /// The same in binary64.
    pub fn exactly(&self, DVec2 { x, y }: DVec2) -> [f64; 4] {
        let weights = [(1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y];
        let channel = |c: usize| self.0.iter().zip(weights).map(|(corner, w)| f64::from(corner[c]) * w).sum();
        std::array::from_fn(channel)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DVec2;

    use super::Texture;
    use crate::image::{Encoding, Image, Texels};
    use crate::sampler::{Filter, Sampler, Wrap};

    /// Two texels beside each other, 0 and 1, of one row.
    fn step(wrap: Wrap, filter: Filter) -> impl Fn(f64) -> f32 {
        let texels = Texels::Eight(vec![0, 0, 0, 255, 255, 255, 255, 255]);
        let image = Arc::new(Image { name: "step".into(), width: 2, height: 1, texels });
        let texture = Texture { image, sampler: Sampler { wrap: [wrap; 2], filter }, encoding: Encoding::Linear };
        move |u| texture.at(DVec2::new(u, 0.3))[0]
    }

    #[test]
    fn linear_interpolates_between_centres() {
        let row = |wrap| [-0.25, 0.0, 0.25, 0.5, 0.625, 0.75, 1.0, 1.25].map(step(wrap, Filter::Linear));
        assert_eq!(row(Wrap::Repeat), [1.0, 0.5, 0.0, 0.5, 0.75, 1.0, 0.5, 0.0]);
        assert_eq!(row(Wrap::Mirrored), [0.0, 0.0, 0.0, 0.5, 0.75, 1.0, 1.0, 1.0]);
        assert_eq!(row(Wrap::Clamp), [0.0, 0.0, 0.0, 0.5, 0.75, 1.0, 1.0, 1.0]);
    }

    #[test]
    fn nearest_takes_the_texel() {
        let row = |wrap| [-0.6, -0.1, 0.1, 0.49, 0.51, 0.99, 1.1, 1.6].map(step(wrap, Filter::Nearest));
        assert_eq!(row(Wrap::Repeat), [0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0]);
        assert_eq!(row(Wrap::Mirrored), [1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0]);
        assert_eq!(row(Wrap::Clamp), [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
    }

    #[test]
    fn what_is_constant_stays_so_to_the_last_bit() {
        let image = Arc::new(Image { name: "grey".into(), width: 2, height: 2, texels: Texels::Eight(vec![77; 16]) });
        let texture = Texture { image, sampler: Sampler::default(), encoding: Encoding::Srgb };
        let expected = texture.image.texel(0, 0, Encoding::Srgb);
        for i in 0..1000 {
            let uv = DVec2::new(f64::from(i) * 0.317, f64::from(i) * -0.011);
            assert_eq!(texture.at(uv), expected);
        }
    }
}
