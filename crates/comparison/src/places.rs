//! From what is asked to places in the scene.

use glam::DVec3;
use twoforms_estimator::glossy::MetallicRoughness;
use twoforms_estimator::nearest::nearest;
use twoforms_scene::Camera;

use crate::on_light::{OnLight, OnLights, Origin};
use crate::place::{Place, Quantity, Reflection};
use crate::request::{Asked, CameraChoice, Grid, Request};
use crate::viewpoint;
use crate::world::{Seen, World};

/// Why a place that is asked for is none.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct NoPlace {
    /// What of the request is to blame.
    pub about: About,
    /// What is wrong with it, and what to do.
    pub message: String,
}

/// A part of a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum About {
    /// A receiver by numbers, which of them from 0.
    Point(usize),
    /// A receiver by name.
    Receivers,
    /// A pixel.
    Pixels,
    /// The grid.
    Grid,
    /// The camera.
    Camera,
    /// What is asked.
    Asked,
    /// That there is no place at all.
    Nothing,
}

impl About {
    fn none(self, message: impl Into<String>) -> NoPlace {
        NoPlace { about: self, message: message.into() }
    }
}

type Result<T> = std::result::Result<T, NoPlace>;

/// Cells on a side of the grid that is taken where a scene has no receivers of its own.
const DEFAULT_GRID: u32 = 8;

/// Whether places are where the light is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stay {
    /// They are: those on a light are refused, or left out of a grid.
    Put,
    /// A sweep begins there and moves them or the lights.
    Moving,
}

/// The places that a request asks for, never none; `note` is told what is left out.
///
/// # Errors
/// [`NoPlace`].
pub fn places(world: &World, request: &Request, stay: Stay, note: &dyn Fn(&str)) -> Result<Vec<Place>> {
    let lights = (stay == Stay::Put).then(|| OnLights::new(world));
    let finder = Finder { world, lights, request, note };
    if request.camera.camera.is_some() {
        camera(world, &request.camera)?; // a name that no camera has is told even where nothing looks through it
    }
    let mut places = finder.points()?;
    places.extend(finder.named()?);
    places.extend(finder.pixels()?);
    if let Some(grid) = request.grid {
        places.extend(finder.grid(grid)?);
    }
    if places.is_empty() {
        places = finder.defaults()?;
    }
    Ok(places)
}

/// The camera of a choice: its view, its name, else the scene's first.
///
/// # Errors
/// [`NoPlace`] where there is none.
pub fn camera(world: &World, choice: &CameraChoice) -> Result<Camera> {
    let none = |message: &str| About::Camera.none(message);
    if let Some(view) = choice.view {
        return viewpoint::look_at("view", view.eye, view.target, view.field_of_view)
            .ok_or_else(|| none("--view has no direction: bring its two points nearer to the origin"));
    }
    let cameras = &world.scene.cameras;
    match choice.camera.as_deref() {
        Some("auto") => {
            viewpoint::auto(world.geometry.mesh()).ok_or_else(|| none("the scene has no triangle to look at"))
        }
        Some(name) => {
            let by_number = name.parse::<usize>().ok().and_then(|index| cameras.get(index));
            let camera = cameras.iter().find(|camera| camera.name == name).or(by_number);
            let names: Vec<&str> = cameras.iter().map(|camera| camera.name.as_str()).collect();
            camera.cloned().ok_or_else(|| About::Camera.none(no_such("camera", name, &names, CAMERAS)))
        }
        None => cameras.first().cloned().ok_or_else(|| none(&format!("the scene has no camera: pass {CAMERAS}"))),
    }
}

/// What to pass where a camera is missing.
const CAMERAS: &str = "--camera auto, or --view EX,EY,EZ,TX,TY,TZ,FOV";

struct Finder<'a> {
    world: &'a World,
    /// To refuse what lies on a light.
    lights: Option<OnLights<'a>>,
    request: &'a Request,
    note: &'a dyn Fn(&str),
}

impl Finder<'_> {
    fn points(&self) -> Result<Vec<Place>> {
        let points = self.request.points.iter().enumerate();
        points.map(|(k, &(position, normal))| self.point(k, position, normal)).collect()
    }

    fn point(&self, k: usize, position: DVec3, normal: DVec3) -> Result<Place> {
        let [x, y, z] = position.to_array();
        let name = format!("point {},{},{}", short(x), short(y), short(z));
        let quantity = self.quantity_at(position, normal, &name)?;
        let place = Place { name, position, normal, quantity, known: None };
        self.off_lights(place, Origin::Given, About::Point(k))
    }

    fn check(&self, place: &Place, origin: Origin) -> std::result::Result<(), OnLight> {
        self.lights.as_ref().map_or(Ok(()), |lights| lights.check(&place.frame(), origin))
    }

    /// The place, unless it lies on a light.
    fn off_lights(&self, place: Place, origin: Origin, about: About) -> Result<Place> {
        match self.check(&place, origin) {
            Ok(()) => Ok(place),
            Err(on) => Err(about.none(format!("the receiver \"{}\" has no answer: {on}", place.name))),
        }
    }

    fn named(&self) -> Result<Vec<Place>> {
        let receivers = &self.world.scene.receivers;
        let mut named = Vec::new();
        for name in &self.request.receivers {
            let found = receivers.iter().filter(|receiver| &receiver.name == name);
            let before = named.len();
            named.extend(found.map(Place::of_receiver));
            if named.len() == before {
                let names: Vec<&str> = receivers.iter().map(|receiver| receiver.name.as_str()).collect();
                let message = no_such("receiver", name, &names, "--at X,Y,Z,NX,NY,NZ");
                return Err(About::Receivers.none(message));
            }
        }
        self.with_quantity(named)
    }

    fn with_quantity(&self, named: Vec<Place>) -> Result<Vec<Place>> {
        let with_quantity = |mut place: Place| {
            place.quantity = self.quantity_at(place.position, place.normal, &place.name)?;
            self.off_lights(place, Origin::Given, About::Receivers)
        };
        named.into_iter().map(with_quantity).collect()
    }

    fn pixels(&self) -> Result<Vec<Place>> {
        if self.request.pixels.is_empty() {
            return Ok(Vec::new());
        }
        let camera = camera(self.world, &self.request.camera)?;
        let size @ [width, height] = self.request.camera.size(camera.aspect);
        let none = |message: String| About::Pixels.none(message);
        let seen = self.request.pixels.iter().map(|&[x, y]| {
            if x >= width || y >= height {
                let message = "lies outside the image of";
                return Err(none(format!(
                    "pixel {x},{y} {message} {width} × {height} pixels: see --width and --height"
                )));
            }
            let place = self.seen(&camera, [f64::from(x) + 0.5, f64::from(y) + 0.5], size).ok_or_else(|| {
                none(format!("pixel {x},{y} sees nothing of the scene: choose another, or another --camera or --view"))
            })?;
            self.off_lights(place, Origin::Seen, About::Pixels)
        });
        seen.collect()
    }

    fn grid(&self, Grid([columns, rows]): Grid) -> Result<Vec<Place>> {
        let camera = camera(self.world, &self.request.camera)?;
        let size @ [width, height] = self.request.camera.size(camera.aspect);
        let centre = |k: u32, count: u32, pixels: u32| (f64::from(k) + 0.5) / f64::from(count) * f64::from(pixels);
        let cells = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
        let seen = |(i, j)| self.seen(&camera, [centre(i, columns, width), centre(j, rows, height)], size);
        let mut places: Vec<Place> = cells.filter_map(seen).collect();
        let all = columns as usize * rows as usize;
        let (found, missed) = (places.len(), all - places.len());
        if found == 0 {
            let sees =
                format!("camera \"{}\" sees nothing of the scene: choose another with --camera or --view", camera.name);
            return Err(About::Camera.none(sees));
        }
        if missed > 0 {
            (self.note)(&format!("note: {missed} of {all} grid points see nothing and are left out"));
        }
        places.retain(|place| self.check(place, Origin::Seen).is_ok());
        match found - places.len() {
            0 => {}
            _ if places.is_empty() => {
                return Err(About::Grid.none("all grid points lie on the edges of lights: choose another --grid"));
            }
            on => (self.note)(&format!("note: {on} of {all} grid points lie on the edge of a light and are left out")),
        }
        Ok(places)
    }

    fn defaults(&self) -> Result<Vec<Place>> {
        let receivers = &self.world.scene.receivers;
        if !receivers.is_empty() {
            return self.with_quantity(receivers.iter().map(Place::of_receiver).collect());
        }
        let CameraChoice { camera, view, .. } = &self.request.camera;
        if self.world.scene.cameras.is_empty() && camera.is_none() && view.is_none() {
            let neither = "the scene has neither receivers nor a camera to find some through";
            return Err(About::Nothing.none(format!("{neither}: pass --at X,Y,Z,NX,NY,NZ, or {CAMERAS}")));
        }
        self.grid(Grid([DEFAULT_GRID; 2]))
    }

    /// What the camera sees at a point of the image, in pixels.
    fn seen(&self, camera: &Camera, at: [f64; 2], size: [u32; 2]) -> Option<Place> {
        let seen = self.world.see(&viewpoint::ray(camera, at, size))?;
        let name = format!("pixel {},{}", at[0].floor(), at[1].floor());
        let quantity = match self.request.asked {
            Asked::Irradiance => Quantity::Irradiance,
            Asked::Radiance => self.radiance(&seen, self.highlight(&seen), camera.position),
        };
        Some(Place { name, position: seen.position, normal: seen.normal, quantity, known: None })
    }

    fn quantity_at(&self, position: DVec3, normal: DVec3, name: &str) -> Result<Quantity> {
        if self.request.asked == Asked::Irradiance {
            return Ok(Quantity::Irradiance);
        }
        match (self.world.surface_at(position, normal), self.request.albedo) {
            (Some(seen), _) => match self.highlight(&seen) {
                None => Ok(self.radiance(&seen, None, DVec3::ZERO)),
                highlight => Ok(self.radiance(&seen, highlight, self.eye(&seen, name)?)),
            },
            (None, Some(albedo)) => {
                Ok(Quantity::Radiance { surface: Reflection::Lambertian(albedo.0), emission: [0.0; 3] })
            }
            (None, None) => {
                let message = format!("no surface lies under the receiver \"{name}\", so its radiance needs --albedo");
                Err(About::Asked.none(message))
            }
        }
    }

    /// The highlight of a surface, unless all are left out.
    fn highlight(&self, seen: &Seen) -> Option<MetallicRoughness> {
        self.world.highlight(seen).filter(|_| !self.request.lambert)
    }

    fn radiance(&self, seen: &Seen, highlight: Option<MetallicRoughness>, eye: DVec3) -> Quantity {
        let lambertian = || Reflection::Lambertian(self.world.appearance(seen).albedo());
        let surface = highlight.map_or_else(lambertian, |surface| Reflection::Glossy { surface, eye });
        Quantity::Radiance { surface, emission: self.world.emission(seen) }
    }

    /// Where the camera is that a receiver's radiance goes to.
    fn eye(&self, seen: &Seen, name: &str) -> Result<DVec3> {
        let camera = camera(self.world, &self.request.camera).map_err(|NoPlace { message, .. }| {
            About::Camera.none(format!("the receiver \"{name}\" lies on a surface with a highlight, whose radiance depends on where it is seen from (or pass --lambert to leave highlights out): {message}"))
        })?;
        if (camera.position - seen.position).dot(seen.normal) > 0.0 {
            return Ok(camera.position);
        }
        Err(About::Camera.none(format!(
            "camera \"{}\" is behind the surface at the receiver \"{name}\", where no radiance of it arrives: pass \
             {CAMERAS} on its side, turn its normal, or pass --lambert",
            camera.name
        )))
    }
}

/// A coordinate as one would type it.
fn short(coordinate: f64) -> String {
    let text = format!("{coordinate:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

/// Nothing has this name: the nearest that there is, or else what to pass.
fn no_such(what: &str, name: &str, names: &[&str], otherwise: &str) -> String {
    match nearest(name, names) {
        Some(nearest) => {
            let all = names.join(", ");
            format!("the scene has no {what} \"{name}\"; did you mean \"{nearest}\"? (all: {all})")
        }
        None => format!("the scene has no {what} \"{name}\", nor any other: pass {otherwise}"),
    }
}
