//! Scenes of experiments: where they come from, and which receivers and strategies are asked about.

use std::path::PathBuf;

use glam::DVec3;
use toml::Spanned;
use twoforms_comparison::place::{Place, Quantity, Reflection};
use twoforms_comparison::world::World;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_scene::Scene;

use crate::catalogue;
use crate::reading::{Error, Text, hint};
use crate::schema::Experiment;

/// The scene of a name: a file beside the text, else one of the program's own.
///
/// # Errors
/// Where there is none, or it cannot be read.
pub fn world(name: &Spanned<String>, text: &Text) -> Result<World, Error> {
    let wrong = |message: String| text.error(name.span(), &message);
    let beside = text.folder.as_ref().map(|folder| folder.join(name.get_ref())).filter(|path| path.exists());
    let scene = match (beside, catalogue::scene(name.get_ref())) {
        (Some(path), _) => Scene::load(&path),
        (None, Some(bytes)) => Scene::from_bytes(bytes, &PathBuf::from(name.get_ref())),
        (None, None) => {
            let known = catalogue::scenes().map(|(name, _)| name).collect::<Vec<_>>();
            let hint = hint(name.get_ref(), &known);
            return Err(wrong(format!("there is no scene \"{}\" beside the file{hint}", name.get_ref())));
        }
    };
    scene.and_then(World::new).map_err(|error| wrong(error.to_string()))
}

/// The receivers that an experiment names or places; all that the scene has where it does neither.
///
/// # Errors
/// Where a name is none of the scene's, or a normal has no length.
pub fn places(experiment: &Experiment, world: &World, text: &Text) -> Result<Vec<Place>, Error> {
    let quantity = experiment.albedo.map_or(Quantity::Irradiance, |rho| Quantity::Radiance {
        surface: Reflection::Lambertian([rho; 3]),
        emission: [0.0; 3],
    });
    let asked = |place: Place| Place { quantity, ..place };
    let all = &world.scene.receivers;
    let (names, at) = (experiment.receivers.as_deref(), experiment.at.as_deref());
    if names.is_none() && at.is_none() {
        return Ok(all.iter().map(Place::of_receiver).map(asked).collect());
    }
    let named = |name: &Spanned<String>| {
        let found = all.iter().find(|receiver| receiver.name == *name.get_ref());
        found.map(Place::of_receiver).ok_or_else(|| {
            let names: Vec<&str> = all.iter().map(|receiver| receiver.name.as_str()).collect();
            let hint = hint(name.get_ref(), &names);
            text.error(name.span(), &format!("the scene has no receiver \"{}\"{hint}", name.get_ref()))
        })
    };
    let placed = |(k, &[x, y, z, nx, ny, nz]): (usize, &[f64; 6])| {
        let normal = DVec3::new(nx, ny, nz).try_normalize();
        let message = format!("at {x}, {y}, {z}: the normal has no length");
        let normal = normal.ok_or_else(|| Error { place: text.name.clone(), message })?;
        let (name, position) = (format!("point {}", k + 1), DVec3::new(x, y, z));
        Ok(Place { name, position, normal, quantity: Quantity::Irradiance, known: None })
    };
    let named = names.unwrap_or_default().iter().map(named);
    let places = named.chain(at.unwrap_or_default().iter().enumerate().map(placed));
    places.map(|place| place.map(asked)).collect()
}

/// A strategy by name.
///
/// # Errors
/// Where it is none, with the reason.
pub fn strategy(name: &Spanned<String>, text: &Text) -> Result<Strategy, Error> {
    let parsed = name.get_ref().parse::<Strategy>();
    parsed.map_err(|error| text.error(name.span(), &error.to_string()))
}

/// A sampler by name.
///
/// # Errors
/// Where it is none, with the reason.
pub fn sampler(name: &Spanned<String>, text: &Text) -> Result<Sampler, Error> {
    name.get_ref().parse::<Sampler>().map_err(|error| text.error(name.span(), &error.to_string()))
}

/// The samplers that an experiment names; independent samples where it names none.
///
/// # Errors
/// Where a name is no sampler's.
pub fn samplers(experiment: &Experiment, text: &Text) -> Result<Vec<Sampler>, Error> {
    let Some(names) = &experiment.samplers else { return Ok(vec![Sampler::Independent]) };
    names.iter().map(|name| sampler(name, text)).collect()
}
