//! A number with its colour and the error it may have.

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
