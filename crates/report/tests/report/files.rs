//! Files are whole or not there, and a refused one says why.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use crate::support::{document, folder, image, receivers};
use twoforms_report::exr::write_exr;
use twoforms_report::png::write_png;
use twoforms_report::{ReportError, csv, file, json};

#[test]
fn a_file_is_written_under_its_name_and_nothing_else_is_left() {
    let folder = folder("saved");
    let document = document(receivers());
    let path = folder.join("results.csv");
    for _ in 0..2 {
        file::save(&path, |out| csv::write(&document, out)).unwrap();
    }
    assert!(fs::read_to_string(&path).unwrap().starts_with("receiver,x,y,z,"));
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
}

#[test]
fn a_failure_keeps_the_old_file_and_leaves_no_part() {
    let folder = folder("failed");
    let path = folder.join("results.json");
    fs::write(&path, "old").unwrap();
    let failed = file::save(&path, |out| {
        out.write_all(b"half")?;
        Err(io::Error::from(io::ErrorKind::StorageFull).into())
    });
    let message = failed.unwrap_err().to_string();
    assert!(message.contains("results.json") && message.contains("free some space"), "{message}");
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
}

#[test]
fn a_place_that_cannot_be_written_is_named_with_a_remedy() {
    let folder = folder("unwritable");
    fs::write(folder.join("file"), "").unwrap();
    let cases = [
        ("missing/a", "make its folder first"),
        ("file/a", "a file stands where a folder is needed"),
        (".", "not of a folder"),
    ];
    for (name, remedy) in cases {
        let path = folder.join(name);
        let save = |path: &Path| file::save(path, |out| json::write(&document(receivers()), out));
        for error in [write_exr(&path, &image()), write_png(&path, &image()), save(&path)] {
            let error = error.unwrap_err();
            assert!(matches!(error, ReportError::File { .. }));
            let message = error.to_string();
            assert!(message.starts_with(&format!("cannot write {}: ", path.display())), "{message}");
            assert!(message.contains(remedy), "{message}");
        }
    }
    let message = file::make_folder(&folder.join("file/results")).unwrap_err().to_string();
    assert!(message.contains("a file stands where a folder is needed"), "{message}");
    file::make_folder(&folder.join("new/results")).unwrap();
    assert!(folder.join("new/results").is_dir());
}

#[cfg(unix)]
#[test]
fn a_link_and_a_device_stay_what_they_are() {
    let folder = folder("special");
    fs::write(folder.join("target"), "old").unwrap();
    std::os::unix::fs::symlink(folder.join("target"), folder.join("link")).unwrap();
    let save = |path: &Path| file::save(path, |out| Ok(out.write_all(b"new")?));
    save(&folder.join("link")).unwrap();
    assert!(folder.join("link").is_symlink());
    assert_eq!(fs::read_to_string(folder.join("target")).unwrap(), "new");
    save(Path::new("/dev/null")).unwrap();
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
}

#[test]
fn a_reader_that_goes_away_is_told_apart() {
    struct Closed;
    impl Write for Closed {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::BrokenPipe.into())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let document = document(receivers());
    for error in [json::write(&document, Closed), csv::write(&document, Closed)] {
        let Err(ReportError::Stream { cause }) = error else { panic!("not an error of the stream") };
        assert_eq!(cause.kind(), io::ErrorKind::BrokenPipe);
    }
}
