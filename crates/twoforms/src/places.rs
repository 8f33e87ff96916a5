//! From the command line's receivers to places in the scene.

use anyhow::{Context, Result, anyhow, bail};
use glam::DVec3;
use twoforms_comparison::on_light::{OnLight, OnLights, Origin};
use twoforms_comparison::place::{Place, Quantity};
use twoforms_comparison::viewpoint;
use twoforms_comparison::world::{Seen, World};
use twoforms_estimator::nearest::nearest;
use twoforms_scene::Camera;

use crate::args::{At, CameraArgs, ImageSize, Pair, PlacesArgs, QuantityArg, ReceiverArgs, RunArgs};
use crate::{points, run};

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

/// The places that the command line asks for, never none.
pub fn places(world: &World, places: &PlacesArgs, run: &RunArgs, stay: Stay) -> Result<Vec<Place>> {
    let PlacesArgs { receivers: args, camera, quantity } = places;
    let note = |line: &str| run::note(run, line);
    let lights = (stay == Stay::Put).then(|| OnLights::new(world));
    let finder = Finder { world, lights, args, camera, quantity: *quantity, note: &note };
    if camera.camera.is_some() {
        self::camera(world, camera)?; // a name that no camera has is told even where nothing looks through it
    }
    let mut places = finder.points()?;
    places.extend(finder.named()?);
    places.extend(finder.pixels()?);
    if let Some(grid) = args.grid {
        places.extend(finder.grid(grid)?);
    }
    if places.is_empty() {
        places = finder.defaults()?;
    }
    Ok(places)
}

/// The camera that the command line asks for: `--view`, `--camera`, else the scene's first.
pub fn camera(world: &World, args: &CameraArgs) -> Result<Camera> {
    if let Some([ex, ey, ez, tx, ty, tz, fov]) = args.view {
        let (eye, target) = (DVec3::new(ex, ey, ez), DVec3::new(tx, ty, tz));
        return viewpoint::look_at("view", eye, target, fov.to_radians())
            .context("--view has no direction: bring its two points nearer to the origin");
    }
    let cameras = &world.scene.cameras;
    match args.camera.as_deref() {
        Some("auto") => viewpoint::auto(world.geometry.mesh()).context("the scene has no triangle to look at"),
        Some(name) => {
            let by_number = name.parse::<usize>().ok().and_then(|index| cameras.get(index));
            let camera = cameras.iter().find(|camera| camera.name == name).or(by_number);
            let names: Vec<&str> = cameras.iter().map(|camera| camera.name.as_str()).collect();
            camera.cloned().ok_or_else(|| no_such("camera", name, &names, CAMERAS))
        }
        None => cameras.first().cloned().with_context(|| format!("the scene has no camera: pass {CAMERAS}")),
    }
}

/// What to pass where a camera is missing.
const CAMERAS: &str = "--camera auto, or --view EX,EY,EZ,TX,TY,TZ,FOV";

struct Finder<'a> {
    world: &'a World,
    /// To refuse what lies on a light.
    lights: Option<OnLights<'a>>,
    args: &'a ReceiverArgs,
    camera: &'a CameraArgs,
    quantity: QuantityArg,
    note: &'a dyn Fn(&str),
}

impl Finder<'_> {
    fn points(&self) -> Result<Vec<Place>> {
        let mut points = Vec::new();
        for at in &self.args.at {
            match at {
                At::Point(position, normal) => points.push((*position, *normal)),
                At::File(path) => points.extend(points::read(path)?),
            }
        }
        points.into_iter().map(|(position, normal)| self.point(position, normal)).collect()
    }

    fn point(&self, position: DVec3, normal: DVec3) -> Result<Place> {
        let [x, y, z] = position.to_array();
        let name = format!("point {},{},{}", short(x), short(y), short(z));
        let quantity = self.quantity_at(position, normal, &name)?;
        self.off_lights(Place { name, position, normal, quantity, known: None }, Origin::Given)
    }

    fn check(&self, place: &Place, origin: Origin) -> Result<(), OnLight> {
        self.lights.as_ref().map_or(Ok(()), |lights| lights.check(&place.frame(), origin))
    }

    /// The place, unless it lies on a light.
    fn off_lights(&self, place: Place, origin: Origin) -> Result<Place> {
        self.check(&place, origin)
            .with_context(|| format!("the receiver \"{}\" has no answer", place.name))
            .map(|()| place)
    }

    fn named(&self) -> Result<Vec<Place>> {
        let receivers = &self.world.scene.receivers;
        let mut named = Vec::new();
        for name in &self.args.receiver {
            let found = receivers.iter().filter(|receiver| &receiver.name == name);
            let before = named.len();
            named.extend(found.map(Place::of_receiver));
            if named.len() == before {
                let names: Vec<&str> = receivers.iter().map(|receiver| receiver.name.as_str()).collect();
                return Err(no_such("receiver", name, &names, "--at X,Y,Z,NX,NY,NZ"));
            }
        }
        self.with_quantity(named)
    }

    fn with_quantity(&self, named: Vec<Place>) -> Result<Vec<Place>> {
        let with_quantity = |mut place: Place| {
            place.quantity = self.quantity_at(place.position, place.normal, &place.name)?;
            self.off_lights(place, Origin::Given)
        };
        named.into_iter().map(with_quantity).collect()
    }

    fn pixels(&self) -> Result<Vec<Place>> {
        if self.args.pixel.is_empty() {
            return Ok(Vec::new());
        }
        let camera = camera(self.world, self.camera)?;
        let [width, height] = self.camera.size(camera.aspect);
        let seen = self.args.pixel.iter().map(|Pair([x, y])| {
            if *x >= width || *y >= height {
                bail!("pixel {x},{y} lies outside the image of {width} × {height} pixels: see --width and --height");
            }
            let place = self.seen(&camera, [f64::from(*x) + 0.5, f64::from(*y) + 0.5], [width, height]);
            let place = place.with_context(|| {
                format!("pixel {x},{y} sees nothing of the scene: choose another, or another --camera or --view")
            })?;
            self.off_lights(place, Origin::Seen)
        });
        seen.collect()
    }

    fn grid(&self, Pair([columns, rows]): Pair) -> Result<Vec<Place>> {
        let camera = camera(self.world, self.camera)?;
        let size @ [width, height] = self.camera.size(camera.aspect);
        let centre = |k: u32, count: u32, pixels: u32| (f64::from(k) + 0.5) / f64::from(count) * f64::from(pixels);
        let cells = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
        let seen = |(i, j)| self.seen(&camera, [centre(i, columns, width), centre(j, rows, height)], size);
        let places: Vec<Place> = cells.filter_map(seen).collect();
        let all = columns as usize * rows as usize;
        let missed = all - places.len();
        if places.is_empty() {
            bail!("camera \"{}\" sees nothing of the scene: choose another with --camera or --view", camera.name);
        }
        if missed > 0 {
            (self.note)(&format!("note: {missed} of {all} grid points see nothing and are left out"));
        }
        let (found, mut places) = (places.len(), places);
        places.retain(|place| self.check(place, Origin::Seen).is_ok());
        match found - places.len() {
            0 => {}
            _ if places.is_empty() => bail!("all grid points lie on the edges of lights: choose another --grid"),
            on => (self.note)(&format!("note: {on} of {all} grid points lie on the edge of a light and are left out")),
        }
        Ok(places)
    }

    fn defaults(&self) -> Result<Vec<Place>> {
        let receivers = &self.world.scene.receivers;
        if !receivers.is_empty() {
            return self.with_quantity(receivers.iter().map(Place::of_receiver).collect());
        }
        if self.world.scene.cameras.is_empty() && self.camera.camera.is_none() && self.camera.view.is_none() {
            bail!(
                "the scene has neither receivers nor a camera to find some through: pass --at X,Y,Z,NX,NY,NZ, or {CAMERAS}"
            );
        }
        self.grid(Pair([DEFAULT_GRID; 2]))
    }

    /// What the camera sees at a point of the image, in pixels.
    fn seen(&self, camera: &Camera, at: [f64; 2], size: ImageSize) -> Option<Place> {
        let seen = self.world.see(&viewpoint::ray(camera, at, size))?;
        let name = format!("pixel {},{}", at[0].floor(), at[1].floor());
        let quantity = match self.quantity {
            QuantityArg::Irradiance => Quantity::Irradiance,
            QuantityArg::Radiance => self.radiance(&seen),
        };
        Some(Place { name, position: seen.position, normal: seen.normal, quantity, known: None })
    }

    fn quantity_at(&self, position: DVec3, normal: DVec3, name: &str) -> Result<Quantity> {
        if self.quantity == QuantityArg::Irradiance {
            return Ok(Quantity::Irradiance);
        }
        match (self.world.surface_at(position, normal), self.args.albedo) {
            (Some(seen), _) => Ok(self.radiance(&seen)),
            (None, Some(albedo)) => Ok(Quantity::Radiance { albedo: albedo.0, emission: [0.0; 3] }),
            (None, None) => bail!("no surface lies under the receiver \"{name}\", so its radiance needs --albedo"),
        }
    }

    fn radiance(&self, seen: &Seen) -> Quantity {
        let albedo = self.world.albedo(seen);
        Quantity::Radiance { albedo, emission: self.world.emission(seen) }
    }
}

/// A coordinate as one would type it.
fn short(coordinate: f64) -> String {
    let text = format!("{coordinate:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

/// Nothing has this name: the nearest that there is, or else what to pass.
fn no_such(what: &str, name: &str, names: &[&str], otherwise: &str) -> anyhow::Error {
    match nearest(name, names) {
        Some(nearest) => {
            let all = names.join(", ");
            anyhow!("the scene has no {what} \"{name}\"; did you mean \"{nearest}\"? (all: {all})")
        }
        None => anyhow!("the scene has no {what} \"{name}\", nor any other: pass {otherwise}"),
    }
}
