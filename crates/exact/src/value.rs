//! A number with its colour and the error it may have.

/// Luminance of linear RGB: 0.2126 R + 0.7152 G + 0.0722 B (Rec. 709).
pub const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// The unit of all error bounds: 2⁻⁵², the spacing of binary64 at one.
pub(crate) const EPSILON: f64 = f64::EPSILON;

/// Irradiance, or the variance of one sample of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Value {
    /// Linear RGB; a variance is that of each channel.
    pub rgb: [f64; 3],
    /// Luminance; a variance is that of the samples' luminance, not the luminance of the channels'
    /// variances.
    pub luminance: f64,
    /// Absolute bound of the luminance's error.
    pub error_bound: f64,
}

/// 0.2126 R + 0.7152 G + 0.0722 B.
pub fn luminance(rgb: [f64; 3]) -> f64 {
    rgb.iter().zip(LUMINANCE).map(|(c, weight)| c * weight).sum()
}
