//! Result files: whole or not there, and a place that cannot be written is told before anything is computed.

use std::fs;

use serde_json::Value;

use crate::support::{folder, has_all, names, run, scene, twoforms, written};

const SMALL: &str = "--receiver floor-lit --samples 1,4 --replicates 20";

#[test]
fn a_folder_of_results_holds_both_files_and_nothing_half_written() {
    let folder = folder("out").join("deep/er");
    let said = twoforms(&format!("compare @cornell-box {SMALL} --out {}", folder.display())).printed();
    assert!(said.contains("of the others, ") && said.contains("the lowest measured"), "{said}");
    assert_eq!(names(&folder), ["compare.csv", "compare.json"]);
    let json: Value = serde_json::from_slice(&fs::read(folder.join("compare.json")).expect("a file")).expect("JSON");
    let csv = fs::read_to_string(folder.join("compare.csv")).expect("a file");
    assert_eq!(csv.lines().count() - 1, json["receivers"][0]["rows"].as_array().expect("rows").len());
}

#[test]
fn exact_light_goes_to_a_folder_too() {
    let folder = folder("exact-out").join("deep/er");
    let line = format!("exact @cornell-box --receiver floor-lit --strategies area/uniform --out {}", folder.display());
    assert!(twoforms(&line).printed().contains("area/uniform"));
    assert_eq!(names(&folder), ["exact.csv", "exact.json"]);
    let json: Value = serde_json::from_slice(&fs::read(folder.join("exact.json")).expect("a file")).expect("JSON");
    assert_eq!(json["schema"], "twoforms.exact/1");
    assert_eq!(fs::read_to_string(folder.join("exact.csv")).expect("a file").lines().count(), 2);
}

#[test]
fn an_output_file_takes_what_would_be_printed() {
    let folder = folder("output");
    let path = written(&folder, "result.json", "old");
    let run = twoforms(&format!("compare @cornell-box {SMALL} --format json -o {path}"));
    assert_eq!(run.printed(), "");
    let json: Value = serde_json::from_slice(&fs::read(&path).expect("a file")).expect("JSON");
    assert_eq!(json["schema"], "twoforms.compare/1");
    assert_eq!(names(&folder), ["result.json"]);
}

#[test]
fn a_place_that_cannot_be_written_is_told_and_nothing_is_left() {
    let folder = folder("unwritable");
    let file = written(&folder, "file", "kept");
    let (scene, path) = (scene("cornell-box"), |name: &str| folder.join(name).display().to_string());
    fs::create_dir(path("folder.exr")).expect("a folder");
    fs::create_dir_all(path("results/compare.csv")).expect("a folder");
    for (words, says) in [
        (["compare", "--out", &path("file")], "a file stands where a folder is needed"),
        (["compare", "--out", &path("file/below")], "a file stands where a folder is needed"),
        (["compare", "--out", &path("results")], "not of a folder"),
        (["compare", "-o", &path("file/below.json")], "a file stands where a folder is needed"),
        (["compare", "-o", &path("missing/x.json")], "make its folder first"),
        (["compare", "-o", &path("")], "not of a folder"),
        (["render", "-o", &path("missing/x.exr")], "make its folder first"),
        (["render", "-o", &path("folder.exr")], "not of a folder"),
        (["render", "-o", &path("file/x.exr")], "a file stands where a folder is needed"),
    ] {
        run(words.into_iter().chain([scene.as_str()])).fails(&["cannot write", says]);
    }
    assert_eq!(names(&folder), ["file", "folder.exr", "results"]);
    assert_eq!(fs::read_to_string(file).expect("a file"), "kept");
}

#[cfg(unix)]
#[test]
fn names_need_not_be_utf8() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let folder = folder("not-utf8");
    let odd = folder.join(OsStr::from_bytes(b"odd\xff.gltf"));
    if fs::copy(scene("cornell-box"), &odd).is_err() {
        return; // a file system that takes no such name
    }
    let words = SMALL.split(' ').map(OsStr::new).chain(["--format".as_ref(), "json".as_ref()]);
    let json = run([OsStr::new("compare"), odd.as_os_str()].into_iter().chain(words)).json();
    has_all(json["provenance"]["command"].as_str().expect("text"), &["odd\u{fffd}.gltf"]);
}
