//! From a scene to what one of its receivers meets.

use twoforms_estimator::lights::Lights;
use twoforms_geometry::frame::Frame;
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::view::Prospect;

use crate::error::Error;
use crate::facing::{Facing, Light};
use crate::sight::Sight;

/// What the receiver at the origin of `frame` sees of the lights. `f_r` (RGB) scales what arrives: 1 for irradiance, ρ/π for
/// the radiance that a Lambertian surface reflects.
///
/// # Errors
/// Where there is no exact answer; see [`Error`].
pub fn look(geometry: &Geometry, lights: &Lights, frame: &Frame, f_r: [f64; 3]) -> Result<Sight, Error> {
    let facing = (0..geometry.targets().len() as u32).filter_map(|target| {
        let Prospect { corners, lit, blockers } = Prospect::new(geometry, frame, target);
        let radiance = lights.radiance(target);
        let index = target as usize;
        lit.then(|| Facing {
            target,
            light: lights.light_of_target()[index] as u32,
            corners,
            faces: true,
            area: lights.areas()[index],
            radiance: std::array::from_fn(|c| f64::from(radiance[c]) * f_r[c]),
            blockers,
        })
    });
    Sight::new(&facing.collect::<Vec<_>>(), &all(lights))
}

/// What selections need of every light.
fn all(lights: &Lights) -> Vec<Light> {
    lights.light_areas().iter().zip(lights.powers()).map(|(&area, &power)| Light { area, power }).collect()
}
