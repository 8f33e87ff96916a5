//! From a scene to what one of its receivers meets.

use glam::DVec3;
use twoforms_estimator::lights::Lights;
use twoforms_estimator::rgb::luminance;
use twoforms_geometry::frame::Frame;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::view::{Need, Prospect, Standing, prospects};

use crate::error::Error;
use crate::facing::{Facing, Light};
use crate::glow::Glow;
use crate::moved::Motion;
use crate::sight::Sight;

/// What the receiver at the origin of `frame` sees of the lights. One that lies on a light stands on the side that it faces: it
/// gets nothing from that light where it looks straight out of it, and has no answer where some of the light rises above its
/// horizon. `f_r` (RGB) scales what arrives: 1 for irradiance, ρ/π for
/// the radiance that a Lambertian surface reflects.
///
/// # Errors
/// Where there is no exact answer; see [`Error`].
pub fn look(geometry: &Geometry, lights: &Lights, frame: &Frame, f_r: [f64; 3]) -> Result<Sight, Error> {
    let sight = Sight { tree: Some((lights.tree().clone(), *frame)), ..Sight::dark(&all(lights, 1.0))? };
    let mut seen = Gathering { geometry, sight, error: None, lights, f_r, growth: 1.0 };
    prospects(geometry, frame, |prospect| seen.add(prospect));
    seen.finish()
}

/// The same with the lights where `motion` has them: radiances stay, areas and powers grow with the scale.
///
/// # Errors
/// Where there is no exact answer; see [`Error`].
pub fn look_moved(
    geometry: &Geometry,
    lights: &Lights,
    frame: &Frame,
    f_r: [f64; 3],
    motion: &Motion,
) -> Result<Sight, Error> {
    if geometry.is_veiled() {
        return Err(Error::Veiled { target: 0 });
    }
    let growth = motion.growth();
    let sight = Sight::dark(&all(lights, growth))?;
    let mut seen = Gathering { geometry, sight, error: None, lights, f_r, growth };
    for target in 0..lights.targets() as u32 {
        let mut prospect = motion.prospect(geometry, frame, target);
        if prospect.standing == Standing::OnBack {
            prospect.standing = Standing::On; // the light was moved there, and may come from either side
        }
        seen.add(prospect);
    }
    seen.finish()
}

/// A sight that targets are added to, and the first error.
struct Gathering<'a> {
    geometry: &'a Geometry,
    sight: Sight,
    error: Option<Error>,
    lights: &'a Lights,
    f_r: [f64; 3],
    /// By how much areas have grown.
    growth: f64,
}

impl Gathering<'_> {
    fn add(&mut self, prospect: Prospect) -> Need {
        let added = match prospect.standing {
            _ if self.error.is_some() => Ok(true),
            Standing::Dark | Standing::OnBack => Ok(true),
            Standing::On => Err(Error::OnLight { target: prospect.target }),
            Standing::Lit if prospect.complete => self.add_complete(prospect).map(|()| true),
            Standing::Lit => self.sight.add_hidden(&self.facing(prospect)),
        };
        match added {
            Ok(true) => Need::Nothing,
            Ok(false) => Need::Complete,
            Err(error) => {
                self.error = Some(error);
                Need::Nothing
            }
        }
    }

    fn add_complete(&mut self, prospect: Prospect) -> Result<(), Error> {
        let (target, veils) = (prospect.target, prospect.veils.clone());
        let facing = self.facing(prospect);
        let veiled = self.geometry.is_cut(target) || (!veils.is_empty() && facing.is_veiled(veils)?);
        if veiled && !Sight::dark(&self.sight.lights)?.add_hidden(&facing)? {
            return Err(Error::Veiled { target });
        }
        self.sight.add(&facing)
    }

    fn facing(&self, Prospect { target, corners, blockers, .. }: Prospect) -> Facing {
        let (index, radiance) = (target as usize, self.lights.radiance(target));
        Facing {
            target,
            light: self.lights.light_of_target()[index] as u32,
            glow: self.glow(target, &corners),
            corners,
            faces: true,
            area: self.lights.areas()[index] * self.growth,
            radiance: std::array::from_fn(|c| f64::from(radiance[c]) * self.f_r[c]),
            emitted: luminance(radiance.map(f64::from)),
            blockers,
        }
    }

    fn glow(&self, target: u32, corners: &[DVec3]) -> Option<Glow> {
        let (pattern, cells) = (self.lights.pattern(target)?, self.lights.cells(target)?);
        Some(Glow::new(pattern, cells, corners, self.f_r))
    }

    fn finish(self) -> Result<Sight, Error> {
        self.error.map_or(Ok(self.sight), Err)
    }
}

/// What selections need of every light.
fn all(lights: &Lights, growth: f64) -> Vec<Light> {
    let of_each = lights.light_areas().iter().zip(lights.powers());
    of_each.map(|(&area, &power)| Light { area: area * growth, power: power * growth }).collect()
}
