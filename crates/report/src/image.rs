//! Images as numbers: named channels of binary32 samples.

use crate::error::ReportError;
use crate::provenance::Provenance;

/// An image of linear RGB with further layers beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Channels in any order: `R`, `G` and `B` are required and finite; layers have dotted names, `area/uniform.Variance.R`.
    pub channels: Vec<Channel>,
    /// Samples per pixel.
    pub samples_per_pixel: u32,
    /// Seconds that the image took; left out of the file where there is none, so that equal images give equal files.
    pub render_seconds: Option<f64>,
    /// Where the image comes from.
    pub provenance: Provenance,
}

/// One number per pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Name in ASCII, its layer before the last dot: `R`, `Albedo.R`, `depth.Z`.
    pub name: String,
    /// `width` × `height` samples, row by row from the top left.
    pub samples: Vec<f32>,
}

impl Image {
    /// The samples of the channel `name`.
    pub fn channel(&self, name: &str) -> Option<&[f32]> {
        self.channels.iter().find(|channel| channel.name == name).map(|channel| channel.samples.as_slice())
    }

    /// The root channels `R`, `G` and `B`.
    ///
    /// # Errors
    /// [`ReportError::Image`] where one is missing.
    pub fn rgb(&self) -> Result<[&[f32]; 3], ReportError> {
        let root =
            |name| self.channel(name).ok_or_else(|| refused(format!("it has no channel {name}"), "add R, G and B"));
        Ok([root("R")?, root("G")?, root("B")?])
    }

    /// Checks that the parts fit together: a size, channels of that size with distinct ASCII names, finite R, G and B.
    ///
    /// # Errors
    /// [`ReportError::Image`], or [`ReportError::NotFinite`] with the pixel.
    pub fn check(&self) -> Result<(), ReportError> {
        if self.width == 0 || self.height == 0 {
            return Err(refused(format!("{} × {} pixels are no image", self.width, self.height), "give it a size"));
        }
        self.channels.iter().try_for_each(|channel| self.check_channel(channel))?;
        for (name, samples) in ["R", "G", "B"].into_iter().zip(self.rgb()?) {
            self.check_finite(name, samples)?;
        }
        Ok(())
    }

    fn check_channel(&self, Channel { name, samples }: &Channel) -> Result<(), ReportError> {
        if self.width.checked_mul(self.height) != Some(samples.len()) {
            let what =
                format!("channel {name} has {} samples for {} × {} pixels", samples.len(), self.width, self.height);
            return Err(refused(what, "give it one a pixel"));
        }
        if name.is_empty() || name.len() > 255 || !name.is_ascii() {
            return Err(refused(format!("the channel name '{name}' cannot be written"), "use 1 to 255 ASCII letters"));
        }
        if self.channels.iter().filter(|other| other.name == *name).count() > 1 {
            return Err(refused(format!("two channels are named {name}"), "name each differently"));
        }
        Ok(())
    }

    fn check_finite(&self, name: &str, samples: &[f32]) -> Result<(), ReportError> {
        match samples.iter().position(|sample| !sample.is_finite()) {
            Some(i) => {
                let place = format!("channel {name} at pixel {},{}", i % self.width, i / self.width);
                Err(ReportError::NotFinite { place, value: f64::from(samples[i]) })
            }
            None => Ok(()),
        }
    }
}

/// The error of an image that cannot be written.
pub(crate) fn refused(what: String, remedy: &'static str) -> ReportError {
    ReportError::Image { what, remedy }
}
