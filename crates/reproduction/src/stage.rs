//! Scenes of experiments: where they come from, and which receivers and strategies are asked about.

use std::ops::Range;
use std::path::PathBuf;

use toml::Spanned;
use twoforms_comparison::place::Place;
use twoforms_comparison::places::{About, Stay, places as find};
use twoforms_comparison::points;
use twoforms_comparison::request::{CameraChoice, Idle, Request, point};
use twoforms_comparison::world::World;
use twoforms_estimator::sampler::Sampler;
use twoforms_estimator::strategy::Strategy;
use twoforms_scene::Scene;

use crate::catalogue;
use crate::either::At;
use crate::reading::{Error, Text, hint};
use crate::schema::Experiment;

/// The scene of a name: a file beside the text, else one of the program's own. `note` is told what was read otherwise than the
/// file means it, and `detail` how much there is of it.
///
/// # Errors
/// Where there is none, or it cannot be read.
pub fn world(name: &Spanned<String>, text: &Text, note: &dyn Fn(&str), detail: &dyn Fn(&str)) -> Result<World, Error> {
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
    let world = World::new(scene).map_err(|error| wrong(error.to_string()))?;
    detail(&format!("{}: {}", name.get_ref(), world.summary()));
    Ok(world)
}

/// Where an experiment measures, and what it asks there.
///
/// # Errors
/// Where it says what cannot be, or its scene has no such place.
pub fn places(experiment: &Experiment, world: &World, text: &Text, note: &dyn Fn(&str)) -> Result<Vec<Place>, Error> {
    let (request, counts) = request(experiment, text)?;
    if let Some(idle) = request.idle() {
        let (at, message) = misuse(experiment, idle);
        return Err(text.error(at.unwrap_or_default(), message));
    }
    let stay = if experiment.sweep.is_some() { Stay::Moving } else { Stay::Put };
    let to_blame = |about| span(experiment, &counts, world, about).unwrap_or_default();
    find(world, &request, stay, note).map_err(|none| text.error(to_blame(none.about), &none.message))
}

/// Where light is measured and what is asked, in a file's keys; and how many points each item of `at` stands for.
fn request(experiment: &Experiment, text: &Text) -> Result<(Request, Vec<usize>), Error> {
    let mut points = Vec::new();
    let mut counts = Vec::new();
    for at in experiment.at.iter().flatten() {
        let wrong = |message: String| text.error(at.span(), &message);
        let before = points.len();
        match at.get_ref() {
            At::Point(numbers) => points.push(point(*numbers).map_err(wrong)?),
            At::File(path) => points.extend(points::read(&text.beside(path)).map_err(wrong)?),
        }
        counts.push(points.len() - before);
    }
    let camera = CameraChoice {
        camera: experiment.camera.as_ref().map(|camera| camera.get_ref().0.clone()),
        view: said(experiment.view.as_ref()),
        width: said(experiment.width.as_ref()),
        height: said(experiment.height.as_ref()),
    };
    let request = Request {
        asked: said(experiment.quantity.as_ref()).unwrap_or_default(),
        lambert: said(experiment.lambert.as_ref()).unwrap_or_default(),
        points,
        receivers: experiment.receivers.iter().flatten().map(|name| name.get_ref().clone()).collect(),
        pixels: experiment.pixels.as_ref().map(|pixels| pixels.get_ref().clone()).unwrap_or_default(),
        grid: said(experiment.grid.as_ref()),
        albedo: said(experiment.albedo.as_ref()),
        camera,
    };
    Ok((request, counts))
}

/// What a key says, if it is there.
fn said<T: Copy>(key: Option<&Spanned<T>>) -> Option<T> {
    key.map(|value| *value.get_ref())
}

/// Where a file says what means nothing beside the rest, and why it does not.
fn misuse(experiment: &Experiment, idle: Idle) -> (Option<Range<usize>>, &'static str) {
    let Experiment { albedo, lambert, width, height, view, .. } = experiment;
    match idle {
        Idle::Albedo => (albedo.as_ref().map(Spanned::span), "an albedo is for radiance: add quantity = \"radiance\""),
        Idle::Lambert => (lambert.as_ref().map(Spanned::span), "lambert is for radiance: add quantity = \"radiance\""),
        Idle::Size => (
            width.as_ref().or(height.as_ref()).map(Spanned::span),
            "width and height are of the image that pixels and grid look through: add one of these",
        ),
        Idle::Camera => (view.as_ref().map(Spanned::span), "a view is a camera by itself: leave out view or camera"),
    }
}

/// Where the file says what is to blame; `counts` are the points that each item of `at` stands for.
fn span(experiment: &Experiment, counts: &[usize], world: &World, about: About) -> Option<Range<usize>> {
    let unknown = |name: &&Spanned<String>| !world.scene.receivers.iter().any(|of| of.name == *name.get_ref());
    let named = || experiment.receivers.iter().flatten();
    let camera = || experiment.camera.as_ref().map(Spanned::span).or(experiment.view.as_ref().map(Spanned::span));
    let said = match about {
        About::Point(k) => {
            let ends = counts.iter().scan(0, |sum, count| {
                *sum += count;
                Some(*sum)
            });
            ends.zip(experiment.at.iter().flatten()).find(|(end, _)| k < *end).map(|(_, at)| at.span())
        }
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
