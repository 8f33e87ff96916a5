//! Writes a triangular light over a square that hides part of it, and 1024 points of the floor below, at which
//! `sample_points` measures: `cargo run --release -p twoforms-tests --bin write-points FOLDER` makes `points.gltf` and
//! `points.csv` there.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use glam::{DVec3, Vec3};
use twoforms_tests::scenes::{Answer, Camera, Material, Part, Scene};

fn main() -> ExitCode {
    let Some(folder) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("usage: write-points FOLDER");
        return ExitCode::from(2);
    };
    let files = [("points.gltf", scene().to_gltf()), ("points.csv", points())];
    match files.iter().try_for_each(|(name, text)| write(&folder.join(name), text)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    let path_shown = path.display();
    std::fs::write(path, text)
        .map_err(|error| format!("cannot write {path_shown}: {error}; name a folder that is there"))
}

/// The light faces down and is tilted; the square stands between it and the floor.
fn scene() -> Scene {
    let light = [[-0.4, 1.0, -0.3], [0.5, 1.1, -0.2], [0.1, 0.9, 0.5]];
    let square = [[-0.25, 0.45, -0.2], [0.2, 0.45, -0.2], [0.2, 0.45, 0.25], [-0.25, 0.45, 0.25]];
    Scene {
        name: "points".to_owned(),
        description: "A triangular light over a square that hides part of it.".to_owned(),
        parts: vec![
            Part::new("light", Material::emitting([1.0; 3]), vec![light.map(Vec3::from).to_vec()]),
            Part::new("square", Material::diffuse([0.5; 3]).double_sided(), vec![square.map(Vec3::from).to_vec()]),
        ],
        camera: Camera::look_at(DVec3::new(0.0, 1.0, 3.0), DVec3::ZERO, 0.8),
        receivers: Vec::new(),
        method: |_, _| Answer { irradiance: [0.0; 3], variance: Vec::new(), derivation: String::new() },
    }
}

/// The centres of 32 × 32 cells of the floor between −1 and 1, a line each: position and normal.
fn points() -> String {
    let centre = |k: u32| (f64::from(k) + 0.5) / 16.0 - 1.0;
    let line = |k: u32| format!("{},0,{},0,1,0\n", centre(k / 32), centre(k % 32));
    (0..1024).map(line).collect()
}
