//! Writes the project's glTF scenes: `cargo run -p twoforms-tests --bin write-scenes [FOLDER]`.
//! Without a folder, the `scenes/` of the repository.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use twoforms_tests::scenes::{self, Scene};

fn main() -> ExitCode {
    let default = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let folder = std::env::args_os().nth(1).map_or_else(default, PathBuf::from);
    let mut report = String::new();
    for scene in scenes::all() {
        let path = folder.join(scene.file_name());
        if let Err(error) = std::fs::write(&path, scene.to_gltf()) {
            let path = path.display();
            eprintln!("cannot write {path}: {error}; name a folder that can be written to");
            return ExitCode::FAILURE;
        }
        report += &describe(&scene);
    }
    let printed = std::io::stdout().write_all(report.as_bytes());
    ExitCode::from(u8::from(printed.is_err()))
}

/// A line for the scene and one for each receiver.
fn describe(scene: &Scene) -> String {
    let mut lines = vec![format!("{}: {} triangles", scene.file_name(), scene.triangle_count())];
    let answers = scene.answers();
    lines.extend(answers.map(|(x, answer)| format!("  {:20} E = {:?}", x.name, answer.irradiance)));
    lines.join("\n") + "\n"
}
