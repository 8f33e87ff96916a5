//! Places: where the light is measured.

use glam::DVec3;
use twoforms_estimator::lights::Lights;
use twoforms_estimator::query::Query;
use twoforms_geometry::frame::Frame;
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
    /// ∫ L_e f_r cosθ dω + emission, for a Lambertian surface.
    Radiance {
        /// ρ, RGB.
        albedo: [f32; 3],
        /// L_e toward the eye, RGB, from the surface itself.
        emission: [f32; 3],
    },
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

    /// f_r, RGB: what scales the light that arrives.
    pub(crate) fn f_r(&self) -> [f64; 3] {
        match self.quantity {
            Quantity::Irradiance => [1.0; 3],
            Quantity::Radiance { albedo, .. } => albedo.map(|rho| f64::from(rho) * std::f64::consts::FRAC_1_PI),
        }
    }

    /// L_e toward the eye from the surface itself, RGB.
    pub(crate) fn emission(&self) -> [f64; 3] {
        match self.quantity {
            Quantity::Irradiance => [0.0; 3],
            Quantity::Radiance { emission, .. } => emission.map(f64::from),
        }
    }

    /// What estimators are asked.
    pub(crate) fn query<'l>(&self, lights: &'l Lights) -> Query<'l> {
        match self.quantity {
            Quantity::Irradiance => Query::irradiance(lights),
            Quantity::Radiance { albedo, .. } => Query::radiance(lights, albedo),
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
