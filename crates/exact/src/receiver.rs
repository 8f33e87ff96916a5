//! From a scene to what one of its receivers meets.

use twoforms_estimator::lights::Lights;
use twoforms_geometry::frame::Frame;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::view::{Prospect, Standing, prospects};

use crate::error::Error;
use crate::facing::{Facing, Light};
use crate::moved::Motion;
use crate::sight::Sight;

/// What the receiver at the origin of `frame` sees of the lights. `f_r` (RGB) scales what arrives: 1 for irradiance, ρ/π for
/// the radiance that a Lambertian surface reflects.
///
/// # Errors
/// Where there is no exact answer; see [`Error`].
pub fn look(geometry: &Geometry, lights: &Lights, frame: &Frame, f_r: [f64; 3]) -> Result<Sight, Error> {
    let mut sight = Ok(Sight::dark(&all(lights, 1.0))?);
    prospects(geometry, frame, |prospect| add(&mut sight, prospect, lights, f_r, 1.0));
    sight
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
    let growth = motion.growth();
    let mut sight = Ok(Sight::dark(&all(lights, growth))?);
    for target in 0..lights.targets() as u32 {
        add(&mut sight, motion.prospect(geometry, frame, target), lights, f_r, growth);
    }
    sight
}

/// Adds a target to what is seen, its area grown by a factor; the first error stays.
fn add(sight: &mut Result<Sight, Error>, prospect: Prospect, lights: &Lights, f_r: [f64; 3], growth: f64) {
    let Ok(seen) = sight else { return };
    let Prospect { target, standing, corners, blockers } = prospect;
    let (index, radiance) = (target as usize, lights.radiance(target));
    let added = match standing {
        Standing::Dark | Standing::OnBack => Ok(()),
        Standing::On => Err(Error::OnLight { target }),
        Standing::Lit => seen.add(&Facing {
            target,
            light: lights.light_of_target()[index] as u32,
            corners,
            faces: true,
            area: lights.areas()[index] * growth,
            radiance: std::array::from_fn(|c| f64::from(radiance[c]) * f_r[c]),
            blockers,
        }),
    };
    if let Err(error) = added {
        *sight = Err(error);
    }
}

/// What selections need of every light.
fn all(lights: &Lights, growth: f64) -> Vec<Light> {
    let of_each = lights.light_areas().iter().zip(lights.powers());
    of_each.map(|(&area, &power)| Light { area: area * growth, power: power * growth }).collect()
}
