//! A scene whose receivers or lights one parameter moves.

use std::ops::Range;

use glam::DVec3;
use twoforms_exact::moved::{Body, Motion};
use twoforms_exact::{Error, Sight, receiver};
use twoforms_geometry::frame::Frame;
use twoforms_geometry::mesh::Mesh;

use crate::on_light::{OnLights, Origin};
use crate::place::Place;
use crate::sweep::Parameter;
use crate::world::World;

/// A world and what moves in it.
pub(crate) struct Stage<'w> {
    world: &'w World,
    parameter: Parameter,
    lamps: Vec<Lamp>,
    on_lights: OnLights<'w>,
}

/// A surface that emits.
struct Lamp {
    triangles: Range<u32>,
    centroid: DVec3,
}

impl<'w> Stage<'w> {
    /// The world with its emitting surfaces found.
    pub(crate) fn new(world: &'w World, parameter: Parameter) -> Self {
        let (scene, mesh) = (&world.scene, world.geometry.mesh());
        let emitting = scene.surfaces.iter().filter(|surface| scene.materials[surface.material].emits());
        let lamp = |triangles: &Range<u32>| Lamp { triangles: triangles.clone(), centroid: centroid(mesh, triangles) };
        let lamps = emitting.map(|surface| lamp(&surface.triangles)).collect();
        Self { world, parameter, lamps, on_lights: OnLights::new(world) }
    }

    /// What a receiver sees with nothing moved.
    ///
    /// # Errors
    /// Where there is no exact answer.
    pub(crate) fn at_rest(&self, place: &Place) -> Result<Sight, Error> {
        self.from(place, DVec3::ZERO)
    }

    /// What a receiver sees with the parameter at `at`. What moves moves in binary64, unrounded.
    ///
    /// # Errors
    /// Where there is no exact answer.
    pub(crate) fn look(&self, place: &Place, at: f64) -> Result<Sight, Error> {
        match self.parameter {
            Parameter::ReceiverX => self.from(place, DVec3::X * at),
            Parameter::ReceiverY => self.from(place, DVec3::Y * at),
            Parameter::ReceiverZ => self.from(place, DVec3::Z * at),
            Parameter::ReceiverNormal => self.from(place, place.normal * at),
            Parameter::LightX => self.lit(place, 1.0, |_| DVec3::X * at),
            Parameter::LightY => self.lit(place, 1.0, |_| DVec3::Y * at),
            Parameter::LightZ => self.lit(place, 1.0, |_| DVec3::Z * at),
            // y ↦ c + k (y − c) = k y + (1 − k) c
            Parameter::LightScale => self.lit(place, at, |lamp| (1.0 - at) * lamp.centroid),
        }
    }

    /// With the receiver moved.
    fn from(&self, place: &Place, offset: DVec3) -> Result<Sight, Error> {
        let frame = Frame::new(place.position + offset, place.normal);
        let checked = self.on_lights.check(&frame, Origin::Given);
        checked.map_err(|on_light| Error::OnLight { target: on_light.target })?;
        let sight = receiver::look(&self.world.geometry, &self.world.lights, &frame, place.scale())?;
        place.reflected(&frame, sight)
    }

    /// With the lights moved.
    fn lit(&self, place: &Place, scale: f64, offset: impl Fn(&Lamp) -> DVec3) -> Result<Sight, Error> {
        let body = |lamp: &Lamp| Body { triangles: lamp.triangles.clone(), offset: offset(lamp) };
        let motion = Motion::new(scale, self.lamps.iter().map(body).collect());
        let World { geometry, lights, .. } = self.world;
        let sight = receiver::look_moved(geometry, lights, &place.frame(), place.scale(), &motion)?;
        place.reflected(&place.frame(), sight)
    }
}

/// The centroid of the triangles' area; of their vertices where they have none.
fn centroid(mesh: &Mesh, triangles: &Range<u32>) -> DVec3 {
    let mean = |weight: &dyn Fn(u32) -> f64| {
        let weighted = |t: u32| weight(t) * mesh.triangle(t).vertices().into_iter().sum::<DVec3>() / 3.0;
        let total: f64 = triangles.clone().map(weight).sum();
        (total > 0.0).then(|| triangles.clone().map(weighted).sum::<DVec3>() / total)
    };
    mean(&|t| mesh.triangle(t).area()).or_else(|| mean(&|_| 1.0)).unwrap_or_default()
}
