//! Traces rays of a file through a mesh of another and prints how fast, as one line of JSON.
//!
//! ```text
//! trace_rays MESH RAYS --mode closest|any [--packet] [--threads N] [--repeat K]
//! ```
//!
//! MESH: u32 vertices, u32 triangles, f32 xyz of each vertex, three u32 of each triangle. RAYS: eight f32 a ray, `ox oy oz
//! tmin dx dy dz tmax`, distances in units of the direction's length. All little endian. `sum_t` is the sum of the
//! distances of the closest hits. `--packet` hands the tracer many rays at a time, which serves closest hits alone. Times
//! are those of tracing alone, over all `--repeat` runs.

use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use cpu_time::ProcessTime;
use glam::{DVec3, Vec3};
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::mesh::Mesh;
use twoforms_geometry::ray::{Hit, Ray};

const USAGE: &str = "usage: trace_rays MESH RAYS --mode closest|any [--packet] [--threads N] [--repeat K]";
/// Rays that a thread takes at a time.
const CHUNK: usize = 4096;
/// Rays that are traced together with `--packet`, which is for closest hits alone.
const TOGETHER: usize = 64;

fn main() -> ExitCode {
    match Task::from_arguments(std::env::args().skip(1)).and_then(|task| run(&task)) {
        Ok(line) => {
            println!("{line}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("trace_rays: {message}");
            ExitCode::FAILURE
        }
    }
}

/// What the command line asks for.
struct Task {
    mesh: String,
    rays: String,
    any: bool,
    packet: bool,
    threads: usize,
    repeat: usize,
}

impl Task {
    fn from_arguments(mut arguments: impl Iterator<Item = String>) -> Result<Self, String> {
        let (mut files, mut mode, mut packet, mut threads, mut repeat) = (Vec::new(), None, false, 1, 1);
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("{argument} needs a value; {USAGE}"));
            match argument.as_str() {
                "--mode" => mode = Some(value()?),
                "--threads" => threads = count(&value()?, "--threads")?,
                "--repeat" => repeat = count(&value()?, "--repeat")?,
                "--packet" => packet = true,
                other if other.starts_with("--") => return Err(format!("there is no option {other}; {USAGE}")),
                _ => files.push(argument),
            }
        }
        let any = match mode.as_deref() {
            Some("any") => true,
            Some("closest") => false,
            _ => return Err(format!("--mode is closest or any; {USAGE}")),
        };
        let [mesh, rays] = <[String; 2]>::try_from(files).map_err(|_| format!("two files are needed; {USAGE}"))?;
        Ok(Self { mesh, rays, any, packet, threads, repeat })
    }
}

fn count(text: &str, option: &str) -> Result<usize, String> {
    text.parse().ok().filter(|&n| n > 0).ok_or(format!("{option} is a whole number from 1 on, not {text}"))
}

/// A ray of the file: where it begins to count, and where it ends.
struct Beam {
    ray: Ray,
    start: f64,
    end: f64,
}

/// What was met.
#[derive(Clone, Copy, Default)]
struct Met {
    hits: usize,
    sum_t: f64,
}

fn run(task: &Task) -> Result<String, String> {
    let mesh = read_mesh(&task.mesh)?;
    let rays = read_rays(&task.rays)?;
    let before = ProcessTime::now();
    let geometry = Geometry::new(mesh, Vec::new());
    let build = before.elapsed().as_secs_f64();
    let (cpu, wall) = (ProcessTime::now(), Instant::now());
    let mut met = Met::default();
    for _ in 0..task.repeat {
        met = trace(task, &geometry, &rays);
    }
    let (cpu, wall) = (cpu.elapsed().as_secs_f64(), wall.elapsed().as_secs_f64());
    let rate = (rays.len() * task.repeat) as f64 / cpu / 1e6;
    Ok(format!(
        "{{\"rays\":{},\"hits\":{},\"sum_t\":{},\"cpu_seconds\":{cpu},\"wall_seconds\":{wall},\
         \"mrays_per_cpu_second\":{rate},\"build_cpu_seconds\":{build}}}",
        rays.len(),
        met.hits,
        met.sum_t
    ))
}

/// Traces all rays once; the sums are the same on any number of threads.
fn trace(task: &Task, geometry: &Geometry, rays: &[[f32; 8]]) -> Met {
    let chunks: Vec<&[[f32; 8]]> = rays.chunks(CHUNK).collect();
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        while let Some(chunk) = chunks.get(next.fetch_add(1, Ordering::Relaxed)) {
            let number = (chunk.as_ptr() as usize - rays.as_ptr() as usize) / size_of::<[f32; 8]>();
            done.push((number, trace_chunk(task, geometry, chunk)));
        }
        done
    };
    let mut parts: Vec<(usize, Met)> = std::thread::scope(|scope| {
        let others: Vec<_> = (1..task.threads).map(|_| scope.spawn(work)).collect();
        let mut parts = work();
        parts.extend(others.into_iter().flat_map(|thread| thread.join().expect("no thread panics")));
        parts
    });
    parts.sort_by_key(|&(number, _)| number);
    parts.iter().fold(Met::default(), |sum, (_, met)| Met { hits: sum.hits + met.hits, sum_t: sum.sum_t + met.sum_t })
}

fn trace_chunk(task: &Task, geometry: &Geometry, rays: &[[f32; 8]]) -> Met {
    match (task.any, task.packet) {
        (true, _) => {
            Met { hits: rays.iter().map(beam).filter(|b| geometry.blocked(&b.ray, b.end)).count(), sum_t: 0.0 }
        }
        (false, true) => rays.chunks(TOGETHER).fold(Met::default(), |met, rays| met.and_together(geometry, rays)),
        (false, false) => rays
            .iter()
            .map(beam)
            .fold(Met::default(), |met, beam| met.and(geometry.vp(&beam.ray), beam.start, beam.end)),
    }
}

impl Met {
    /// With one more hit, if there is any before the ray's end.
    fn and(self, hit: Option<Hit>, start: f64, end: f64) -> Self {
        match hit.filter(|hit| hit.t < end) {
            Some(hit) => Self { hits: self.hits + 1, sum_t: self.sum_t + start + hit.t },
            None => self,
        }
    }

    /// With the hits of rays that are traced together.
    fn and_together(self, geometry: &Geometry, rays: &[[f32; 8]]) -> Self {
        let mut together = [Ray::new(DVec3::ZERO, DVec3::X); TOGETHER];
        let mut hits = [None; TOGETHER];
        for (place, ray) in together.iter_mut().zip(rays) {
            *place = beam(ray).ray;
        }
        geometry.vp_of(&together[..rays.len()], &mut hits[..rays.len()]);
        rays.iter().map(beam).zip(hits).fold(self, |met, (beam, hit)| met.and(hit, beam.start, beam.end))
    }
}

/// The ray from the point at `tmin`, where that is not 0.
#[inline]
fn beam(&[ox, oy, oz, start, dx, dy, dz, end]: &[f32; 8]) -> Beam {
    let (origin, direction) = (Vec3::new(ox, oy, oz).as_dvec3(), Vec3::new(dx, dy, dz).as_dvec3());
    let (start, end) = (f64::from(start), f64::from(end));
    let origin = if start == 0.0 { origin } else { origin + direction * start };
    Beam { ray: Ray::new(origin, direction), start, end: end - start }
}

fn read_mesh(path: &str) -> Result<Mesh, String> {
    let bytes = read(path)?;
    let words: Vec<[u8; 4]> = bytes.as_chunks().0.to_vec();
    let wrong = |what: &str| Err(format!("{path}: {what}"));
    let [vertices, triangles, rest @ ..] = &words[..] else {
        return wrong("too short for a mesh, which begins with two counts");
    };
    let [vertices, triangles] = [*vertices, *triangles].map(|count| u32::from_le_bytes(count) as usize);
    if bytes.len() % 4 != 0 || rest.len() != 3 * (vertices + triangles) {
        return wrong(&format!("{} bytes do not hold {vertices} vertices and {triangles} triangles", bytes.len()));
    }
    let (positions, indices) = rest.split_at(3 * vertices);
    let positions: Vec<Vec3> =
        positions.as_chunks().0.iter().map(|p: &[_; 3]| p.map(f32::from_le_bytes).into()).collect();
    let indices: Vec<[u32; 3]> = indices.as_chunks().0.iter().map(|t: &[_; 3]| t.map(u32::from_le_bytes)).collect();
    if let Some(k) = positions.iter().position(|p| !p.is_finite()) {
        return wrong(&format!("vertex {k} is not finite"));
    }
    if let Some(k) = indices.iter().position(|t| t.iter().any(|&i| i as usize >= vertices)) {
        return wrong(&format!("triangle {k} names a vertex beyond the {vertices} there are"));
    }
    Ok(Mesh { vertices: positions, triangles: indices })
}

fn read_rays(path: &str) -> Result<Vec<[f32; 8]>, String> {
    let bytes = read(path)?;
    let (rays, rest) = bytes.as_chunks::<32>();
    if !rest.is_empty() {
        return Err(format!("{path}: {} bytes are no whole number of rays of 32 bytes each", bytes.len()));
    }
    let rays: Vec<[f32; 8]> = rays
        .iter()
        .map(|ray| std::array::from_fn(|k| f32::from_le_bytes([0, 1, 2, 3].map(|byte| ray[4 * k + byte]))))
        .collect();
    match rays.iter().position(|ray| !is_ray(ray)) {
        Some(k) => Err(format!(
            "{path}: ray {k} is {:?}: origin, tmin and direction must be finite, the direction not 0",
            rays[k]
        )),
        None => Ok(rays),
    }
}

fn is_ray(&[ox, oy, oz, start, dx, dy, dz, end]: &[f32; 8]) -> bool {
    [ox, oy, oz, start, dx, dy, dz].iter().all(|n| n.is_finite()) && [dx, dy, dz] != [0.0; 3] && !end.is_nan()
}

fn read(path: &str) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|error| format!("{path} cannot be read: {error}"))
}
