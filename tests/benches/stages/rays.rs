//! y = vp(x, Ψ) and V(x, y) by rays: of a camera, of a cosine hemisphere around what it sees, and from there to the light.

use std::hint::black_box;

use criterion::{Criterion, Throughput};
use glam::DVec3;
use twoforms_comparison::viewpoint;
use twoforms_comparison::world::{Seen, World};
use twoforms_geometry::geometry::Geometry;
use twoforms_geometry::ray::Ray;
use twoforms_tests::terrain::Terrain;
use twoforms_tests::worlds;

use crate::clock::CpuTime;
use crate::{SCENE, loading};

/// A hundred thousand triangles.
pub const TERRAIN: Terrain = Terrain::of_cells(224);

/// Rays through one tile of the image.
const TILE_RAYS: u32 = 64;

/// Every kind of ray, in a room and over hills.
pub fn benches(criterion: &mut Criterion<CpuTime>) {
    of_world(criterion, SCENE, &worlds::stage(SCENE).world);
    of_world(criterion, "terrain", &loading::terrain(TERRAIN));
}

fn of_world(criterion: &mut Criterion<CpuTime>, name: &str, world: &World) {
    let geometry = &world.geometry;
    let camera = camera(world);
    let seen: Vec<Seen> = camera.iter().filter_map(|ray| world.see(ray)).collect();
    let around: Vec<Ray> =
        seen.iter().zip(0..).map(|(seen, k)| Ray::new(seen.position, cosine(seen.normal, k))).collect();
    let light = geometry.targets()[0].centroid(geometry.mesh());
    let shadow: Vec<Ray> = seen.iter().map(|seen| Ray::new(seen.position, light - seen.position)).collect();
    let mut group = criterion.benchmark_group(format!("rays/{name}"));
    let mut bench = |kind: &str, rays: &[Ray], trace: &dyn Fn(&Geometry, &[Ray]) -> usize| {
        group.throughput(Throughput::Elements(rays.len() as u64));
        group.bench_function(kind, |bencher| bencher.iter(|| trace(geometry, black_box(rays))));
    };
    bench("vp, camera", &camera, &|geometry, rays| rays.iter().filter(|ray| geometry.vp(ray).is_some()).count());
    bench("vp, camera, together", &camera, &together);
    bench("vp, cosine", &around, &|geometry, rays| rays.iter().filter(|ray| geometry.vp(ray).is_some()).count());
    bench("blocked, cosine", &around, &|geometry, rays| {
        rays.iter().filter(|ray| geometry.blocked(ray, f64::INFINITY)).count()
    });
    bench("V, to the light", &shadow, &|geometry, rays| {
        rays.iter().filter(|ray| geometry.visible(ray, 1.0, 0)).count()
    });
    group.finish();
}

/// A tile of rays at a time, as an image takes them.
fn together(geometry: &Geometry, rays: &[Ray]) -> usize {
    let mut hits = [None; TILE_RAYS as usize];
    let mut met = 0;
    for rays in rays.chunks(hits.len()) {
        geometry.vp_of(rays, &mut hits[..rays.len()]);
        met += hits[..rays.len()].iter().flatten().count();
    }
    met
}

/// The rays of the scene's camera through tiles of 8 × 8 pixels, which are spread over an image of 512 × 512.
fn camera(world: &World) -> Vec<Ray> {
    let camera = &world.scene.cameras[0];
    let through = |k: u32| {
        let (tile, inside) = (k / TILE_RAYS, k % TILE_RAYS);
        let [x, y] = [tile % 8 * 64 + inside % 8, tile / 8 * 64 + inside / 8];
        viewpoint::ray(camera, [f64::from(x) + 0.5, f64::from(y) + 0.5], [512; 2])
    };
    (0..64 * TILE_RAYS).map(through).collect()
}

/// The k-th of many directions about a normal, their density cosθ/π: the normal plus a point of the unit sphere, the
/// points spread along a spiral that turns by the golden angle.
fn cosine(normal: DVec3, k: u32) -> DVec3 {
    let height = 1.0 - 2.0 * ((f64::from(k) + 0.5) * 0.754_877_666).fract();
    let (sin, cos) = (f64::from(k) * 2.399_963_23).sin_cos();
    let ring = (1.0 - height * height).sqrt();
    (normal + DVec3::new(ring * cos, height, ring * sin)).normalize()
}
