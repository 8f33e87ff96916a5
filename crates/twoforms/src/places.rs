//! From the command line's receivers to places in the scene.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, anyhow, bail};
use glam::DVec3;
use twoforms_comparison::place::{Place, Quantity};
use twoforms_comparison::viewpoint;
use twoforms_comparison::world::{Seen, World};
use twoforms_scene::Camera;

use crate::args::{At, CameraArgs, ImageSize, Pair, QuantityArg, ReceiverArgs};

/// Cells on a side of the grid that is taken where a scene has no receivers of its own.
const DEFAULT_GRID: u32 = 8;

/// The places that the command line asks for, never none.
pub fn places(world: &World, args: &ReceiverArgs, camera: &CameraArgs, quantity: QuantityArg) -> Result<Vec<Place>> {
    let finder = Finder { world, args, camera, quantity };
    let mut places = finder.points()?;
    places.extend(finder.named()?);
    places.extend(finder.pixels()?);
    if let Some(Pair([columns, rows])) = args.grid {
        places.extend(finder.grid(columns, rows)?);
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
        return viewpoint::look_at("view", eye, target, fov.to_radians()).context("the view has no direction");
    }
    let cameras = &world.scene.cameras;
    match args.camera.as_deref() {
        Some("auto") => viewpoint::auto(world.geometry.mesh()).context("the scene has no triangle to look at"),
        Some(name) => {
            let by_number = name.parse::<usize>().ok().and_then(|index| cameras.get(index));
            let camera = cameras.iter().find(|camera| camera.name == name).or(by_number);
            camera.cloned().ok_or_else(|| no_such("camera", name, cameras.iter().map(|c| c.name.as_str())))
        }
        None => cameras
            .first()
            .cloned()
            .context("the scene has no camera: pass --camera auto, or --view EX,EY,EZ,TX,TY,TZ,FOV"),
    }
}

struct Finder<'a> {
    world: &'a World,
    args: &'a ReceiverArgs,
    camera: &'a CameraArgs,
    quantity: QuantityArg,
}

impl Finder<'_> {
    fn points(&self) -> Result<Vec<Place>> {
        let mut points = Vec::new();
        for at in &self.args.at {
            match at {
                At::Point(position, normal) => points.push((*position, *normal)),
                At::File(path) => points.extend(read_points(path)?),
            }
        }
        points.into_iter().map(|(position, normal)| self.point(position, normal)).collect()
    }

    fn point(&self, position: DVec3, normal: DVec3) -> Result<Place> {
        let [x, y, z] = position.to_array();
        let name = format!("at {x},{y},{z}");
        let quantity = self.quantity_at(position, normal, &name)?;
        Ok(Place { name, position, normal, quantity, known: None })
    }

    fn named(&self) -> Result<Vec<Place>> {
        let receivers = &self.world.scene.receivers;
        let mut named = Vec::new();
        for name in &self.args.receiver {
            let found = receivers.iter().filter(|receiver| &receiver.name == name);
            let before = named.len();
            named.extend(found.map(Place::of_receiver));
            if named.len() == before {
                return Err(no_such("receiver", name, receivers.iter().map(|r| r.name.as_str())));
            }
        }
        self.with_quantity(named)
    }

    fn with_quantity(&self, mut places: Vec<Place>) -> Result<Vec<Place>> {
        for place in &mut places {
            place.quantity = self.quantity_at(place.position, place.normal, &place.name)?;
        }
        Ok(places)
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
            place.with_context(|| format!("pixel {x},{y} sees nothing of the scene"))
        });
        seen.collect()
    }

    fn grid(&self, columns: u32, rows: u32) -> Result<Vec<Place>> {
        if columns == 0 || rows == 0 {
            bail!("a grid of {columns} × {rows} has no cell: pass --grid W,H with both above zero");
        }
        let camera = camera(self.world, self.camera)?;
        let size @ [width, height] = self.camera.size(camera.aspect);
        let centre = |k: u32, count: u32, pixels: u32| (f64::from(k) + 0.5) / f64::from(count) * f64::from(pixels);
        let cells = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
        let seen = |(i, j)| self.seen(&camera, [centre(i, columns, width), centre(j, rows, height)], size);
        let places: Vec<Place> = cells.filter_map(seen).collect();
        let missed = u64::from(columns) * u64::from(rows) - places.len() as u64;
        if places.is_empty() {
            bail!("camera \"{}\" sees nothing of the scene: choose another with --camera or --view", camera.name);
        }
        if missed > 0 {
            eprintln!(
                "note: {missed} of {} grid points see nothing and are left out",
                u64::from(columns) * u64::from(rows)
            );
        }
        Ok(places)
    }

    fn defaults(&self) -> Result<Vec<Place>> {
        let receivers = &self.world.scene.receivers;
        if !receivers.is_empty() {
            return self.with_quantity(receivers.iter().map(Place::of_receiver).collect());
        }
        self.grid(DEFAULT_GRID, DEFAULT_GRID).context(
            "there is nothing to measure at: the scene names no receivers; pass --at X,Y,Z,NX,NY,NZ, or a camera for a grid",
        )
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
        let albedo = self.world.scene.albedo(seen.triangle);
        Quantity::Radiance { albedo, emission: self.world.emission(seen) }
    }
}

fn read_points(path: &Path) -> Result<Vec<(DVec3, DVec3)>> {
    let text = fs::read_to_string(path).with_context(|| format!("{} can't be read", path.display()))?;
    let lines = (1..).zip(text.lines().map(str::trim)).filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let header = |(number, line): &(usize, &str)| *number == 1 && line.starts_with(|c: char| c.is_alphabetic());
    let point = |(number, line)| {
        crate::args::point(line).map_err(|fault| anyhow!("{}, line {number}: {fault}", path.display()))
    };
    let points = lines.filter(|line| !header(line)).map(point).collect::<Result<Vec<_>>>()?;
    if points.is_empty() {
        bail!("{} holds no receiver: write a line x,y,z,nx,ny,nz for each", path.display());
    }
    Ok(points)
}

/// Nothing has this name; the nearest that there is.
fn no_such<'a>(what: &str, name: &str, there_are: impl Iterator<Item = &'a str> + Clone) -> anyhow::Error {
    let likeness = |other: &&str| strsim::jaro_winkler(other, name);
    let nearest = there_are.clone().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    let all: Vec<&str> = there_are.collect();
    match nearest {
        Some(nearest) => {
            anyhow!("the scene has no {what} \"{name}\"; did you mean \"{nearest}\"? (all: {})", all.join(", "))
        }
        None => anyhow!("the scene has no {what} \"{name}\", nor any other"),
    }
}
