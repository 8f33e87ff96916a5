//! Scenes of experiments: where they come from, and which receivers and strategies are asked about.

use std::ops::Range;
use std::path::PathBuf;

use toml::Spanned;
use twoforms_comparison::place::Place;
use twoforms_comparison::places::{About, Stay, places as find};
use twoforms_comparison::points;
use twoforms_comparison::request::{Asked, CameraChoice, Request, point};
use twoforms_comparison::world::World;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_scene::Scene;

use crate::catalogue;
use crate::either::At;
use crate::reading::{Error, Text, hint};
use crate::schema::Experiment;

/// The scene of a name: a file beside the text, else one of the program's own. `note` is told what was read otherwise than the
/// file means it.
///
/// # Errors
/// Where there is none, or it cannot be read.
pub fn world(name: &Spanned<String>, text: &Text, note: &dyn Fn(&str)) -> Result<World, Error> {
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
    let scene = scene.map_err(|error| wrong(error.to_string()))?;
    scene.warnings.iter().for_each(|warning| note(&format!("warning: {warning}")));
    World::new(scene).map_err(|error| wrong(error.to_string()))
}

/// Where an experiment measures, and what it asks there.
///
/// # Errors
/// Where it says what cannot be, or its scene has no such place.
pub fn places(experiment: &Experiment, world: &World, text: &Text, note: &dyn Fn(&str)) -> Result<Vec<Place>, Error> {
    let request = request(experiment, text)?;
    let stay = if experiment.sweep.is_some() { Stay::Moving } else { Stay::Put };
    let to_blame = |about| span(experiment, world, about).unwrap_or_default();
    find(world, &request, stay, note).map_err(|none| text.error(to_blame(none.about), &none.message))
}

/// Where light is measured and what is asked, in a file's keys.
fn request(experiment: &Experiment, text: &Text) -> Result<Request, Error> {
    let asked = experiment.quantity.as_ref().map_or(Asked::Irradiance, |asked| *asked.get_ref());
    if let Some(albedo) = experiment.albedo.as_ref().filter(|_| asked == Asked::Irradiance) {
        return Err(text.error(albedo.span(), "an albedo is for radiance: add quantity = \"radiance\""));
    }
    let mut points = Vec::new();
    for at in experiment.at.iter().flatten() {
        let wrong = |message: String| text.error(at.span(), &message);
        match at.get_ref() {
            At::Point(numbers) => points.push(point(*numbers).map_err(wrong)?),
            At::File(path) => points.extend(points::read(&text.beside(path)).map_err(wrong)?),
        }
    }
    let camera = CameraChoice {
        camera: experiment.camera.as_ref().map(|camera| camera.get_ref().0.clone()),
        view: experiment.view.as_ref().map(|view| *view.get_ref()),
        width: experiment.width,
        height: experiment.height,
    };
    Ok(Request {
        asked,
        lambert: experiment.lambert,
        points,
        receivers: experiment.receivers.iter().flatten().map(|name| name.get_ref().clone()).collect(),
        pixels: experiment.pixels.as_ref().map(|pixels| pixels.get_ref().clone()).unwrap_or_default(),
        grid: experiment.grid.as_ref().map(|grid| *grid.get_ref()),
        albedo: experiment.albedo.as_ref().map(|albedo| *albedo.get_ref()),
        camera,
    })
}

/// Where the file says what is to blame; of several points the first, the message names which.
fn span(experiment: &Experiment, world: &World, about: About) -> Option<Range<usize>> {
    let unknown = |name: &&Spanned<String>| !world.scene.receivers.iter().any(|of| of.name == *name.get_ref());
    let named = || experiment.receivers.iter().flatten();
    let camera = || experiment.camera.as_ref().map(Spanned::span).or(experiment.view.as_ref().map(Spanned::span));
    let said = match about {
        About::Points => experiment.at.as_ref().and_then(|at| at.first()).map(Spanned::span),
        About::Receivers => named().find(unknown).or(named().next()).map(Spanned::span),
        About::Pixels => experiment.pixels.as_ref().map(Spanned::span),
        About::Grid => experiment.grid.as_ref().map(Spanned::span),
        About::Camera => camera(),
        About::Asked => experiment.quantity.as_ref().map(Spanned::span),
        About::Nothing => None,
    };
    said.or_else(|| experiment.scene.as_ref().map(Spanned::span))
}

/// The strategies that an experiment lists, each once; `None` where it lists none.
///
/// # Errors
/// Where a name is no strategy's.
pub fn listed(experiment: &Experiment, text: &Text) -> Result<Option<Vec<Strategy>>, Error> {
    let Some(names) = &experiment.strategies else { return Ok(None) };
    names.iter().map(|name| strategy(name, text)).collect::<Result<Vec<_>, _>>().map(|all| Some(once(&all)))
}

/// Drops repetitions.
pub fn once<T: Copy + PartialEq>(items: &[T]) -> Vec<T> {
    items.iter().enumerate().filter(|(k, item)| !items[..*k].contains(item)).map(|(_, item)| *item).collect()
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
    names.iter().map(|name| sampler(name, text)).collect::<Result<Vec<_>, _>>().map(|all| once(&all))
}
