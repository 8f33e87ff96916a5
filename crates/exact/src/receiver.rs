//! From a scene to what one of its receivers meets.

use twoforms_estimator::lights::Lights;
use twoforms_geometry::frame::Frame;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::view::Prospect;

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
    sight(lights, f_r, 1.0, |target| Prospect::new(geometry, frame, target))
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
    sight(lights, f_r, motion.growth(), |target| motion.prospect(geometry, frame, target))
}

/// The sight of all targets, each as `prospect` gives it, with areas grown by a factor.
fn sight(lights: &Lights, f_r: [f64; 3], growth: f64, prospect: impl Fn(u32) -> Prospect) -> Result<Sight, Error> {
    let facing = (0..lights.targets() as u32).filter_map(|target| {
        let Prospect { corners, lit, blockers } = prospect(target);
        let radiance = lights.radiance(target);
        let index = target as usize;
        lit.then(|| Facing {
            target,
            light: lights.light_of_target()[index] as u32,
            corners,
            faces: true,
            area: lights.areas()[index] * growth,
            radiance: std::array::from_fn(|c| f64::from(radiance[c]) * f_r[c]),
            blockers,
        })
    });
    Sight::new(&facing.collect::<Vec<_>>(), &all(lights, growth))
}

/// What selections need of every light.
fn all(lights: &Lights, growth: f64) -> Vec<Light> {
    let of_each = lights.light_areas().iter().zip(lights.powers());
    of_each.map(|(&area, &power)| Light { area: area * growth, power: power * growth }).collect()
}
