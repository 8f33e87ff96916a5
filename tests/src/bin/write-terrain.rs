//! Writes a scene of about N triangles, hills under a light: `cargo run --release -p twoforms-tests --bin write-terrain
//! N FILE.glb`.

use std::process::ExitCode;

use twoforms_tests::terrain::Terrain;

const USAGE: &str = "usage: write-terrain N FILE.glb, with N the number of triangles, 2 to 30000000";
/// More are more than a scene may have.
const MOST: u32 = 30_000_000;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let count = |text: &str| text.parse().ok().filter(|n| (2..=MOST).contains(n));
    let (triangles, path) = match &arguments[..] {
        [triangles, path] => (count(triangles), path),
        _ => (None, &String::new()),
    };
    let Some(triangles) = triangles else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    let terrain = Terrain::of(triangles);
    if let Err(error) = std::fs::write(path, terrain.to_glb()) {
        eprintln!("cannot write {path}: {error}; name a file that can be written to");
        return ExitCode::FAILURE;
    }
    println!("{path}: {} triangles", terrain.triangle_count());
    ExitCode::SUCCESS
}
