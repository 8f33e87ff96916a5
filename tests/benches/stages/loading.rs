//! From the bytes of a glTF file to a scene, and from a scene to a world with its hierarchy.

use std::path::Path;

use criterion::{BatchSize, Criterion, Throughput};
use twoforms_comparison::world::World;
use twoforms_scene::Scene;
use twoforms_tests::scenes;
use twoforms_tests::terrain::Terrain;

use crate::clock::CpuTime;
use crate::{SCENE, rays};

/// Reading text and binary; building, per triangle.
pub fn benches(criterion: &mut Criterion<CpuTime>) {
    let cornell = scenes::all().into_iter().find(|scene| scene.name == SCENE).expect("a scene of that name");
    let files = [
        (format!("{SCENE}.gltf"), cornell.to_gltf().into_bytes(), cornell.triangle_count() as u64),
        ("terrain.glb".to_owned(), rays::TERRAIN.to_glb(), rays::TERRAIN.triangle_count()),
    ];
    let mut group = criterion.benchmark_group("load");
    for (name, bytes, triangles) in &files {
        group.throughput(Throughput::Elements(*triangles));
        group.bench_function(name, |bencher| bencher.iter(|| read(bytes)));
    }
    group.finish();
    let mut group = criterion.benchmark_group("build");
    for (name, bytes, triangles) in &files {
        let scene = read(bytes);
        group.throughput(Throughput::Elements(*triangles));
        group.bench_function(name, |bencher| bencher.iter_batched(|| scene.clone(), World::new, BatchSize::LargeInput));
    }
    group.finish();
}

/// The ground's world.
pub fn terrain(terrain: Terrain) -> World {
    World::new(read(&terrain.to_glb())).expect("a scene with a light")
}

fn read(bytes: &[u8]) -> Scene {
    Scene::from_bytes(bytes, Path::new("memory")).expect("a scene that can be read")
}
