//! Linear RGB.

use std::ops::{Add, Mul};

use twoforms_geometry::real::Real;

/// Linear RGB (Rec. 709 primaries) per sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rgb<R>(pub [R; 3]);

impl<R: Real> Rgb<R> {
    /// The same colour for every sample.
    #[inline(always)]
    pub fn splat(rgb: [f32; 3]) -> Self {
        let [r, g, b] = rgb;
        Self([R::splat(r), R::splat(g), R::splat(b)])
    }

    /// Luminance.
    #[inline(always)]
    pub fn luminance(self) -> R {
        let Self([r, g, b]) = self;
        let weight = |k: usize| R::splat(LUMINANCE[k] as f32);
        r * weight(0) + g * weight(1) + b * weight(2)
    }

    /// The colour where the mask holds, else black.
    #[inline(always)]
    pub fn or_black(self, mask: R::Mask) -> Self {
        let (Self([r, g, b]), black) = (self, R::zero());
        Self([R::select(mask, r, black), R::select(mask, g, black), R::select(mask, b, black)])
    }
}

impl<R: Real> Add for Rgb<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, Self([r, g, b]): Self) -> Self {
        Self([self.0[0] + r, self.0[1] + g, self.0[2] + b])
    }
}

impl<R: Real> Mul<R> for Rgb<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, scale: R) -> Self {
        let Self([r, g, b]) = self;
        Self([r * scale, g * scale, b * scale])
    }
}

impl<R: Real> Mul for Rgb<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, Self([r, g, b]): Self) -> Self {
        Self([self.0[0] * r, self.0[1] * g, self.0[2] * b])
    }
}

/// Luminance of linear RGB: 0.2126 R + 0.7152 G + 0.0722 B (Rec. 709).
pub const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// The luminance of a colour.
#[inline(always)]
pub fn luminance(rgb: [f64; 3]) -> f64 {
    rgb[0] * LUMINANCE[0] + rgb[1] * LUMINANCE[1] + rgb[2] * LUMINANCE[2]
}
