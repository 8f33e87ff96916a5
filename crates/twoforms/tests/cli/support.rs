//! Runs the program, and keeps what it said.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::{env, fs};

use serde_json::Value;

/// What a run came to.
pub struct Run {
    /// Exit code; none for a run that was killed.
    pub code: Option<i32>,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

/// The program, with backtraces asked for so that a panic shows, and nothing to read.
pub fn program() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_twoforms"));
    command.env("RUST_BACKTRACE", "1").stdin(Stdio::null());
    command
}

/// Runs the program with these words.
pub fn run<W: AsRef<OsStr>>(words: impl IntoIterator<Item = W>) -> Run {
    finished(program().args(words).output().expect("the program starts"))
}

/// Runs the program with words that blanks separate; a scene of the repository is written `@name`.
pub fn twoforms(line: &str) -> Run {
    run(line.split_whitespace().map(|word| word.strip_prefix('@').map_or_else(|| word.into(), scene)))
}

/// What a finished run said.
pub fn finished(output: Output) -> Run {
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    Run { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
}

impl Run {
    /// Standard output of a run that succeeded and had nothing to say on standard error.
    pub fn printed(self) -> String {
        assert_eq!((self.code, self.err.as_str()), (Some(0), ""), "{}", self.out);
        self.out
    }

    /// The document that a run printed.
    pub fn json(self) -> Value {
        serde_json::from_str(&self.printed()).expect("one JSON document, whole and alone")
    }

    /// Checks that the run failed with one line on standard error that says all of `says`, and printed nothing.
    pub fn fails(self, says: &[&str]) {
        let Self { code, out, err } = self;
        assert_eq!((code, out.as_str()), (Some(1), ""), "{err}");
        assert!(err.starts_with("twoforms: ") && err.lines().count() == 1, "{err}");
        has_all(&err, says);
    }

    /// Checks that the run was refused for its words, with a message that says all of `says`, and printed nothing.
    pub fn misused(self, says: &[&str]) {
        let Self { code, out, err } = self;
        assert_eq!((code, out.as_str()), (Some(2), ""), "{err}");
        assert!(err.starts_with("error: ") && !err.contains("panicked"), "{err}");
        has_all(&err, says);
    }
}

/// Checks that `text` holds all of `parts`.
pub fn has_all(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part:?} is not in {text:?}");
    }
}

/// The path of a scene of the repository.
pub fn scene(name: &str) -> String {
    format!("{}/../../scenes/{name}.gltf", env!("CARGO_MANIFEST_DIR"))
}

/// An empty folder for one test.
pub fn folder(test: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli").join(test);
    if path.exists() {
        fs::remove_dir_all(&path).expect("an old folder goes");
    }
    fs::create_dir_all(&path).expect("a new folder");
    path
}

/// The names in a folder, in order.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Writes `text` to a file in `folder`, and gives its path.
pub fn written(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, text).expect("a file");
    path.display().to_string()
}

/// The empty Cornell box, changed by `change`, in `folder`.
pub fn changed_box(folder: &Path, name: &str, change: impl Fn(&mut Value)) -> String {
    let text = fs::read_to_string(scene("cornell-box-empty")).expect("a scene");
    let mut gltf: Value = serde_json::from_str(&text).expect("JSON");
    change(&mut gltf);
    written(folder, name, &gltf.to_string())
}

/// Takes the camera out of a scene.
pub fn without_camera(gltf: &mut Value) {
    for node in gltf["nodes"].as_array_mut().expect("nodes") {
        node.as_object_mut().expect("a node").remove("camera");
    }
}

/// Takes the receivers out of a scene.
pub fn without_receivers(gltf: &mut Value) {
    for node in gltf["nodes"].as_array_mut().expect("nodes") {
        node.as_object_mut().expect("a node").remove("extras");
    }
}
