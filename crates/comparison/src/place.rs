//! Places: where the light is measured.

use glam::DVec3;
use twoforms_estimator::glossy::{Glossy, MetallicRoughness};
use twoforms_estimator::lights::Lights;
use twoforms_estimator::query::Query;
use twoforms_exact::{Error, Sight};
use twoforms_geometry::frame::Frame;
use twoforms_geometry::vector::round;
use twoforms_scene::{KnownAnswer, Receiver};

/// A receiver x: where it is, which way it faces, and what is asked there.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Its name.
    pub name: String,
    /// World position in metres.
    pub position: DVec3,
    /// World unit normal.
    pub normal: DVec3,
    /// What is asked.
    pub quantity: Quantity,
    /// The answer that the scene carries, for irradiance.
    pub known: Option<KnownAnswer>,
}

/// What is asked of the light at x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quantity {
    /// ∫ L_e cosθ dω: f_r = 1.
    Irradiance,
    /// ∫ L_e f_r cosθ dω + emission.
    Radiance {
        /// f_r.
        surface: Reflection,
        /// L_e toward the eye, RGB, from the surface itself.
        emission: [f32; 3],
    },
}

/// How a surface reflects toward the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reflection {
    /// Alike in all directions: ρ, RGB. f_r = ρ/π.
    Lambertian([f32; 3]),
    /// With a highlight, wherever the eye is.
    Glossy {
        /// What it is made of.
        surface: MetallicRoughness,
        /// The eye's world position in metres.
        eye: DVec3,
    },
}

impl Reflection {
    /// What estimators are asked at a point of the surface, given by its frame.
    pub(crate) fn query<'l>(&self, lights: &'l Lights, frame: &Frame) -> Query<'l> {
        match self {
            Self::Lambertian(albedo) => Query::radiance(lights, *albedo),
            Self::Glossy { surface, eye } => Query::glossy_radiance(lights, glossy(*surface, *eye, frame)),
        }
    }
}

fn glossy(surface: MetallicRoughness, eye: DVec3, frame: &Frame) -> Glossy {
    Glossy::new(surface, round(frame.localize(eye)))
}

impl Place {
    /// A scene's receiver, asked for irradiance.
    pub fn of_receiver(receiver: &Receiver) -> Self {
        Self {
            name: receiver.name.clone(),
            position: receiver.position,
            normal: receiver.normal,
            quantity: Quantity::Irradiance,
            known: receiver.known.clone(),
        }
    }

    /// f_r, RGB, where it is the same for all directions; 1 where irradiance is asked. `None` at a highlight.
    pub fn f_r(&self) -> Option<[f64; 3]> {
        match self.quantity {
            Quantity::Irradiance => Some([1.0; 3]),
            Quantity::Radiance { surface: Reflection::Lambertian(albedo), .. } => {
                Some(albedo.map(|rho| f64::from(rho) * std::f64::consts::FRAC_1_PI))
            }
            Quantity::Radiance { surface: Reflection::Glossy { .. }, .. } => None,
        }
    }

    /// What scales the light that arrives: f_r, or 1 at a highlight, which is in [`Place::reflected`].
    pub(crate) fn scale(&self) -> [f64; 3] {
        self.f_r().unwrap_or([1.0; 3])
    }

    /// What a sight from `frame` comes to by a surface with a highlight, if that is what lies there.
    ///
    /// # Errors
    /// Where there is no exact answer.
    pub(crate) fn reflected(&self, frame: &Frame, sight: Sight) -> Result<Sight, Error> {
        match self.quantity {
            Quantity::Radiance { surface: Reflection::Glossy { surface, eye }, .. } => {
                sight.reflected(&glossy(surface, eye, frame))
            }
            Quantity::Irradiance | Quantity::Radiance { .. } => Ok(sight),
        }
    }

    /// Whether a surface with a highlight lies there.
    pub(crate) fn is_glossy(&self) -> bool {
        matches!(self.quantity, Quantity::Radiance { surface: Reflection::Glossy { .. }, .. })
    }

    /// L_e toward the eye from the surface itself, RGB.
    pub fn emission(&self) -> [f64; 3] {
        match self.quantity {
            Quantity::Irradiance => [0.0; 3],
            Quantity::Radiance { emission, .. } => emission.map(f64::from),
        }
    }

    /// What estimators are asked.
    pub(crate) fn query<'l>(&self, lights: &'l Lights) -> Query<'l> {
        match self.quantity {
            Quantity::Irradiance => Query::irradiance(lights),
            Quantity::Radiance { surface, .. } => surface.query(lights, &self.frame()),
        }
    }

    /// The frame of x.
    pub fn frame(&self) -> Frame {
        Frame::new(self.position, self.normal)
    }

    /// The bits of position and normal: what random numbers are keyed by.
    pub fn bits(&self) -> impl Iterator<Item = u64> + use<> {
        let coordinates = [self.position.to_array(), self.normal.to_array()];
        coordinates.into_iter().flatten().map(|c| (c + 0.0).to_bits())
    }
}
