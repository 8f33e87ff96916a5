//! The mean of a texture over a triangle.
//!
//! Between the points of its grid a texture is one bilinear map, so its integral is found square by square: the triangle
//! is cut to each, and a quadratic polynomial's mean over a triangle is that of its values in the middles of the sides.
//! That is exact but for rounding (some 10⁻¹² of the mean).
//!
//! Two kinds of footprints are measured at [`POINTS`] points instead, spread evenly by a Kronecker sequence, with an error
//! of about a thousandth of the texture's contrast: those of more than [`MOST`] squares, which show an image again and
//! again, and those that are as thin as a line. There, what no point meets does not count. A footprint that is a single
//! point is looked up.

use glam::DVec2;

use crate::texture::{Cell, Texture};

/// The most squares that are visited.
const MOST: f64 = 16_777_216.0;

/// How many points stand for a footprint that is not cut into squares.
const POINTS: u32 = 1 << 20;

/// The area of a footprint, over the square of its longest side, below which it is a line.
const LINE: f64 = 1e-9;

/// Mean red, green and blue of `texture` over the triangle with these texture coordinates.
pub(crate) fn mean(texture: &Texture, corners: [DVec2; 3]) -> [f64; 3] {
    let [a, b, c] = corners.map(|uv| texture.grid(uv));
    let longest = [b - a, c - b, a - c].map(DVec2::length).into_iter().fold(0.0, f64::max);
    let area = 0.5 * (b - a).perp_dot(c - a);
    if longest == 0.0 {
        let corner = a.floor();
        return colour(texture.cell(corner).exactly(a - corner));
    }
    if area.abs() <= LINE * longest * longest || area.abs() + 3.0 * longest > MOST {
        return at_points(texture, [a, b, c], POINTS);
    }
    let mut sum = Sum::default();
    let triangle = if area > 0.0 { [a, b, c] } else { [a, c, b] };
    add_rows(texture, &triangle, &mut sum);
    sum.colour.map(|channel| channel / sum.area)
}

/// An integral and the area that it is over, in squares of the grid.
#[derive(Default)]
struct Sum {
    colour: [f64; 3],
    area: f64,
}

impl Sum {
    fn add(&mut self, colour: [f64; 3], area: f64) {
        for (sum, channel) in self.colour.iter_mut().zip(colour) {
            *sum += channel * area;
        }
        self.area += area;
    }
}

fn add_rows(texture: &Texture, triangle: &[DVec2], sum: &mut Sum) {
    let (low, high) = extent(triangle, |p| p.y);
    for row in whole(low, high) {
        let strip = between(triangle, row, |p| p.y);
        let (left, right) = extent(&strip, |p| p.x);
        let full = across(triangle, row).zip(across(triangle, row + 1.0));
        let full = full.map(|((l0, r0), (l1, r1))| (l0.max(l1), r0.min(r1)));
        for column in whole(left, right) {
            let cell = texture.cell(DVec2::new(column, row));
            if full.is_some_and(|(left, right)| left <= column && column + 1.0 <= right) {
                sum.add(colour(cell.exactly(DVec2::splat(0.5))), 1.0);
            } else {
                add_piece(&cell, &between(&strip, column, |p| p.x), DVec2::new(column, row), sum);
            }
        }
    }
}

/// Adds the convex `piece` of the square at `corner`, triangle by triangle.
fn add_piece(cell: &Cell, piece: &[DVec2], corner: DVec2, sum: &mut Sum) {
    let Some((&hub, rim)) = piece.split_first() else { return };
    for side in rim.windows(2) {
        let [a, b, c] = [hub, side[0], side[1]].map(|point| point - corner);
        let area = 0.5 * (b - a).perp_dot(c - a);
        for middle in [a.midpoint(b), b.midpoint(c), c.midpoint(a)] {
            sum.add(colour(cell.exactly(middle)), area / 3.0);
        }
    }
}

/// The whole numbers whose unit intervals meet the interval.
fn whole(low: f64, high: f64) -> impl Iterator<Item = f64> {
    let first = low.floor();
    let count = if low <= high { (high - first).ceil().max(1.0) as usize } else { 0 };
    (0..count).map(move |i| first + i as f64)
}

fn extent(polygon: &[DVec2], axis: impl Fn(&DVec2) -> f64) -> (f64, f64) {
    let places = polygon.iter().map(axis);
    places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), place| (low.min(place), high.max(place)))
}

/// What the line at height y cuts out of a convex polygon, from left to right.
fn across(polygon: &[DVec2], y: f64) -> Option<(f64, f64)> {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let met = sides.filter(|(a, b)| (a.y <= y) != (b.y <= y));
    let (left, right) = extent(&met.map(|(a, b)| at(*a, *b, y, |p| p.y)).collect::<Vec<_>>(), |p| p.x);
    (left <= right).then_some((left, right))
}

/// The part of a convex polygon whose `axis` lies between `low` and the next whole number.
fn between(polygon: &[DVec2], low: f64, axis: impl Fn(&DVec2) -> f64 + Copy) -> Vec<DVec2> {
    let above = cut(polygon, low, axis, |place| place >= low);
    cut(&above, low + 1.0, axis, |place| place <= low + 1.0)
}

/// The part of a convex polygon that is kept on one side of a line.
fn cut(polygon: &[DVec2], line: f64, axis: impl Fn(&DVec2) -> f64 + Copy, kept: impl Fn(f64) -> bool) -> Vec<DVec2> {
    let mut part = Vec::with_capacity(polygon.len() + 1);
    for (a, b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let (first, second) = (kept(axis(a)), kept(axis(b)));
        if first {
            part.push(*a);
        }
        if first != second {
            part.push(at(*a, *b, line, axis));
        }
    }
    part
}

/// Where the side from a to b meets a line.
fn at(a: DVec2, b: DVec2, line: f64, axis: impl Fn(&DVec2) -> f64) -> DVec2 {
    a.lerp(b, (line - axis(&a)) / (axis(&b) - axis(&a)))
}

/// The mean at the points (1 − s) a + s ((1 − t) b + t c), s² and t by the steps 1/ρ and 1/ρ² with ρ³ = ρ + 1.
fn at_points(texture: &Texture, [a, b, c]: [DVec2; 3], count: u32) -> [f64; 3] {
    const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
    let mut sum = Sum::default();
    for i in 0..count {
        let [u, t] = STEPS.map(|step| (0.5 + f64::from(i) * step).fract());
        let place = a.lerp(b.lerp(c, t), u.sqrt());
        let corner = place.floor();
        sum.add(colour(texture.cell(corner).exactly(place - corner)), 1.0);
    }
    sum.colour.map(|channel| channel / sum.area)
}

fn colour([red, green, blue, _]: [f64; 4]) -> [f64; 3] {
    [red, green, blue]
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DVec2;

    use super::{at_points, mean};
    use crate::image::{Encoding, Image, Texels};
    use crate::sampler::{Filter, Sampler, Wrap};
    use crate::texture::Texture;

    /// A texture of a few texels that have nothing to do with each other.
    fn texture(width: u32, height: u32, sampler: Sampler) -> Texture {
        let texels = (0..4 * width * height).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
        let image = Arc::new(Image { name: "noise".into(), width, height, texels: Texels::Eight(texels) });
        Texture { image, sampler, encoding: Encoding::Srgb }
    }

    fn samplers() -> impl Iterator<Item = Sampler> {
        let wraps = [Wrap::Repeat, Wrap::Mirrored, Wrap::Clamp];
        let pairs = wraps.into_iter().flat_map(move |s| wraps.map(|t| [s, t]));
        pairs.flat_map(|wrap| [Filter::Linear, Filter::Nearest].map(|filter| Sampler { wrap, filter }))
    }

    fn corners(corners: [[f64; 2]; 3]) -> [DVec2; 3] {
        corners.map(DVec2::from)
    }

    #[test]
    fn two_halves_of_the_unit_square_have_the_mean_of_all_texels() {
        for (sampler, size) in samplers().flat_map(|sampler| [(1, 1), (3, 5), (8, 2)].map(|size| (sampler, size))) {
            let texture = texture(size.0, size.1, sampler);
            let halves = [[[0., 0.], [0., 1.], [1., 1.]], [[0., 0.], [1., 0.], [1., 1.]]];
            let [first, second] = halves.map(|half| mean(&texture, corners(half)));
            for channel in 0..3 {
                let texel = |x, y| f64::from(texture.image.texel(x, y, Encoding::Srgb)[channel]);
                let all = (0..size.1 as usize).flat_map(|y| (0..size.0 as usize).map(move |x| texel(x, y)));
                let expected = all.sum::<f64>() / f64::from(size.0 * size.1);
                let found = f64::midpoint(first[channel], second[channel]);
                assert!((found - expected).abs() < 1e-12, "{sampler:?} {size:?}: {found} for {expected}");
            }
        }
    }

    #[test]
    fn any_triangle_has_the_mean_of_many_points() {
        for sampler in samplers() {
            let texture = texture(7, 4, sampler);
            for triangle in [
                [[0.1, 0.2], [0.9, 0.25], [0.4, 0.8]],
                [[-2.3, 1.1], [3.0, 0.4], [0.2, -1.9]],
                [[0.31, 0.32], [0.312, 0.32], [0.31, 0.323]],
                [[0.0, 0.0], [2.0, 0.0], [2.0, 1e-3]],
            ] {
                let triangle = corners(triangle);
                let exact = mean(&texture, triangle);
                let measured = at_points(&texture, triangle.map(|uv| texture.grid(uv)), 1 << 16);
                for (exact, measured) in exact.into_iter().zip(measured) {
                    assert!((exact - measured).abs() < 2e-3, "{sampler:?} {triangle:?}: {exact} for {measured}");
                }
            }
        }
    }

    #[test]
    fn pieces_add_up_and_winding_does_not_count() {
        let texture = texture(5, 6, Sampler::default());
        let [a, b, c] = corners([[-0.4, 0.1], [1.7, 0.3], [0.2, 1.9]]);
        let m = b.lerp(c, 0.3);
        let [whole, turned] = [[a, b, c], [a, c, b]].map(|triangle| mean(&texture, triangle));
        let [near, far] = [[a, b, m], [a, m, c]].map(|triangle| mean(&texture, triangle));
        for channel in 0..3 {
            assert!((whole[channel] - turned[channel]).abs() < 1e-13);
            assert!((whole[channel] - 0.3 * near[channel] - 0.7 * far[channel]).abs() < 1e-13);
        }
    }

    #[test]
    fn points_and_lines_and_endless_repetition_have_means() {
        let texture = texture(4, 4, Sampler::default());
        let [u, v] = [0.6, 0.15];
        let expected = texture.at(DVec2::new(u, v));
        let point = mean(&texture, corners([[u, v]; 3]));
        assert!(point.iter().zip(expected).all(|(found, texel)| (found - f64::from(texel)).abs() < 1e-7));
        let all = [[[0., 0.], [0., 1.], [1., 1.]], [[0., 0.], [1., 0.], [1., 1.]]].map(|t| mean(&texture, corners(t)));
        let endless = mean(&texture, corners([[0., 0.], [9e3, 1.], [-7.0, 8e3]]));
        let line = mean(&texture, corners([[0., 0.125], [0.5, 0.125], [1.0, 0.125]]));
        let far = mean(&texture, corners([[0., 0.], [1e30, 0.], [0., 1e38]]));
        for channel in 0..3 {
            assert!((endless[channel] - f64::midpoint(all[0][channel], all[1][channel])).abs() < 1e-3);
            assert!((0.0..=1.0).contains(&line[channel]) && (0.0..=1.0).contains(&far[channel]));
        }
    }

    #[test]
    fn what_is_constant_and_what_is_black_stays_so() {
        for value in [0, 255] {
            let image = Image { name: String::new(), width: 9, height: 9, texels: Texels::Eight(vec![value; 324]) };
            let (sampler, encoding) = (Sampler::default(), Encoding::Srgb);
            let texture = Texture { image: Arc::new(image), sampler, encoding };
            let found = mean(&texture, corners([[0.123, 0.2], [0.77, 0.31], [0.4, 0.9]]));
            assert!(found.iter().all(|channel| (channel - f64::from(value) / 255.0).abs() < 1e-14), "{found:?}");
            assert!(value > 0 || found == [0.0; 3]);
        }
    }
}
