//! Receivers that lie on a light, where what comes from it jumps.

use std::ops::ControlFlow;

use glam::DVec3;
use twoforms_geometry::blocking;
use twoforms_geometry::frame::Frame;
use twoforms_geometry::view::{Prospect, Standing};

use crate::world::{World, cube};

/// A receiver on a light that does not simply look out of a side that emits.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "it lies on the light \"{light}\", where what arrives from it jumps: move it by more than {reach:.1e} m, or turn it to \
     look out along {normal}"
)]
pub struct OnLight {
    /// Which target.
    pub target: u32,
    /// The light's name.
    pub light: String,
    /// How far from its plane a point still lies in it, in metres.
    pub reach: f64,
    /// The light's unit normal there: a receiver that faces along it gets nothing from the light.
    pub normal: DVec3,
}

/// What is known of a receiver that may lie on a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Coordinates: where they lie in a surface's plane, nothing says on which side of it.
    Given,
    /// A point of a surface that was seen, its normal on the side from which it was.
    Seen,
}

/// Tells which receivers lie on a light.
pub struct OnLights<'w> {
    world: &'w World,
    /// As far as a point may lie from a triangle's plane and be held by it, whichever the triangle.
    reach: f64,
}

impl<'w> OnLights<'w> {
    /// The lights of a world.
    pub fn new(world: &'w World) -> Self {
        let corners = world.geometry.mesh().bounds().unwrap_or_default();
        let magnitude = corners.0.abs().max(corners.1.abs()).max_element();
        Self { world, reach: blocking::TOLERANCE * f64::from(magnitude) }
    }

    /// Refuses a receiver on a light that what comes from it has no limit for: one above whose horizon some of that light
    /// rises; or one that lies on its dark side and might as well lie just before the other, unless it was seen there.
    ///
    /// # Errors
    /// [`OnLight`].
    pub fn check(&self, frame: &Frame, origin: Origin) -> Result<(), OnLight> {
        let geometry = &self.world.geometry;
        let reach = self.reach.max(blocking::TOLERANCE * frame.x().abs().max_element());
        let mut found = None;
        geometry.within(&cube(frame.x(), reach), |index| {
            found = geometry.target_of(index).filter(|&target| self.is_on(frame, target, origin));
            if found.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        found.map_or(Ok(()), |target| Err(self.on_light(frame, target)))
    }

    fn is_on(&self, frame: &Frame, target: u32, origin: Origin) -> bool {
        match Prospect::new(&self.world.geometry, frame, target).standing {
            Standing::On => true,
            Standing::OnBack => origin == Origin::Given,
            Standing::Dark | Standing::Lit => false,
        }
    }

    fn on_light(&self, frame: &Frame, target: u32) -> OnLight {
        let World { geometry, scene, .. } = self.world;
        let triangle = geometry.mesh().triangle(geometry.targets()[target as usize].first());
        OnLight {
            target,
            light: scene.target_light(target).name.clone(),
            reach: blocking::reach(&triangle, frame.x()),
            normal: triangle.cross().normalize(),
        }
    }
}
