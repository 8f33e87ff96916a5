//! All that x sees of the lights, and its irradiance.

use std::sync::Arc;

use twoforms_estimator::tree::{Tree, Walk};
use twoforms_geometry::frame::Frame;

use crate::error::Error;
use crate::facing::{Facing, Light};
use crate::reflected::Reflected;
use crate::seen::Seen;
use crate::value::{EPSILON, Value};
use twoforms_estimator::rgb::luminance;

/// What one receiver sees of all lights.
#[derive(Clone, Debug)]
pub struct Sight {
    /// The facets that emit toward x, in the order in which they were added.
    pub seen: Vec<Seen>,
    /// All lights of the scene.
    pub lights: Vec<Light>,
    /// The tree over the targets, and where x stands before it; none where the lights were moved.
    pub tree: Option<(Arc<Tree>, Frame)>,
    /// What a surface with a highlight makes of it, where that is asked for.
    pub(crate) reflected: Option<Reflected>,
}

impl Sight {
    /// Computes the visible part and the moments of every target. Targets that do not face x need
    /// not be listed.
    ///
    /// # Errors
    /// Numbers that are not finite, a receiver on a light, or more pieces than can be computed; see
    /// [`Error`].
    pub fn new(facing: &[Facing], lights: &[Light]) -> Result<Self, Error> {
        let mut sight = Self::dark(lights)?;
        facing.iter().try_for_each(|target| sight.add(target))?;
        Ok(sight)
    }

    /// The sight of a receiver that sees nothing of the lights.
    ///
    /// # Errors
    /// [`Error::BadLight`].
    pub fn dark(lights: &[Light]) -> Result<Self, Error> {
        let sound = |value: f64| value.is_finite() && value >= 0.0;
        match lights.iter().position(|light| !sound(light.area) || !sound(light.power)) {
            Some(light) => Err(Error::BadLight { light }),
            None => Ok(Self { seen: Vec::new(), lights: lights.to_vec(), tree: None, reflected: None }),
        }
    }

    /// Adds the visible part and the moments of one more target.
    ///
    /// # Errors
    /// As [`Sight::new`].
    pub fn add(&mut self, target: &Facing) -> Result<(), Error> {
        target.check(self.lights.len())?;
        if target.faces {
            self.seen.append(&mut Seen::facets(target)?);
        }
        Ok(())
    }

    /// Adds a target if its blockers hide all of it, and says whether they do: then more of them would change nothing.
    ///
    /// # Errors
    /// As [`Sight::new`].
    pub fn add_hidden(&mut self, target: &Facing) -> Result<bool, Error> {
        target.check(self.lights.len())?;
        let mut seen = Seen::facets(target)?;
        let hidden = seen.iter().all(|seen| seen.pieces.is_empty());
        if hidden {
            self.seen.append(&mut seen);
        }
        Ok(hidden)
    }

    /// The probability of each target of the scene by the tree.
    ///
    /// # Errors
    /// [`Error::NoTree`].
    pub(crate) fn by_tree(&self) -> Result<Vec<f64>, Error> {
        let (tree, frame) = self.tree.as_ref().ok_or(Error::NoTree)?;
        Ok(Walk::new(tree, frame).probabilities())
    }

    /// Area of all lights in m², each triangle once.
    pub fn total_area(&self) -> f64 {
        self.lights.iter().map(|light| light.area).sum()
    }

    /// E = ∫ L_e cosθ_x V dω; of a reflected sight the radiance ∫ L_e f_r cosθ_x V dω.
    pub fn irradiance(&self) -> Value {
        self.reflected.as_ref().map_or_else(|| self.sum(0), |reflected| reflected.arriving)
    }

    /// The same with V = 1: what the lights would give if nothing stood before them.
    pub fn irradiance_unoccluded(&self) -> Value {
        self.reflected.as_ref().map_or_else(|| self.sum(1), |reflected| reflected.unoccluded)
    }

    /// Σ ∫ L_e cosθ_x dω, as x sees it or unhidden.
    fn sum(&self, unhidden: usize) -> Value {
        let mut rgb = [0.0; 3];
        let mut error_bound = 0.0;
        for seen in &self.seen {
            for (channel, received) in rgb.iter_mut().zip(seen.received[unhidden].rgb) {
                *channel += received;
            }
            error_bound += seen.received[unhidden].error;
        }
        let luminance = luminance(rgb);
        Value { rgb, luminance, error_bound: error_bound + EPSILON * (self.seen.len() + 4) as f64 * luminance }
    }
}
