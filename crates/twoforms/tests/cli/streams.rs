//! Standard output and standard error.

use std::io::{BufRead, BufReader};
use std::process::Stdio;

use crate::support::{program, scene, twoforms};

#[test]
fn nothing_but_warnings_and_notes_stands_on_standard_error() {
    let line = "compare @cornell-box --camera auto --grid 3,3 --samples 1 --replicates 2";
    let noted = twoforms(line);
    assert_eq!(noted.code, Some(0));
    assert_eq!(noted.err, "note: 6 of 9 grid points see nothing and are left out\n");
    twoforms(&format!("{line} --quiet")).printed();
    let told = twoforms("compare @cornell-box --receiver floor-lit --samples 1 --replicates 2 --verbose");
    assert!(told.err.ends_with("38 triangles, 1 light, 1 target\n"), "{}", told.err);
}

/// A reader that leaves, as `head` does, is no failure: whatever the format, and whenever it leaves.
#[test]
fn a_reader_may_leave_early() {
    for format in ["table", "json", "csv"] {
        let mut child = program()
            .args(["compare", &scene("cornell-box"), "--samples", "1,4", "--replicates", "5", "--format", format])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let mut line = String::new();
        BufReader::with_capacity(1, child.stdout.take().expect("a pipe")).read_line(&mut line).expect("a line");
        let left = child.wait_with_output().expect("the program ends");
        assert_eq!((left.status.code(), String::from_utf8_lossy(&left.stderr).as_ref()), (Some(0), ""), "{format}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    use crate::support::finished;
    use std::fs::OpenOptions;

    let full = || OpenOptions::new().write(true).open("/dev/full").expect("/dev/full");
    for words in [["inspect", &scene("cornell-box")], ["completions", "bash"]] {
        let run = program().args(words).stdout(full()).output().expect("the program starts");
        finished(run).fails(&["cannot write the output", "No space left"]);
    }
    // With nobody to tell, the exit code still says it.
    let status = program().args(["inspect", "missing.gltf"]).stderr(full()).status().expect("the program starts");
    assert_eq!(status.code(), Some(1));
}
