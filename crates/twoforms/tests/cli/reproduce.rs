//! `reproduce`, and experiments in files: by name, from a file, with fields set from outside.

use std::fs;

use crate::support::{folder, has_all, names, scene, twoforms, written};

const DIE: &str = "title = \"a die\"\n[[experiment]]\nvalues = [1, 2, 3, 4, 5, 6]\nreplicates = 20000\n\
                   [[experiment.row]]\nquantity = \"mean\"\npublished = \"3.5\"\n";

#[test]
fn without_a_name_all_are_listed() {
    has_all(&twoforms("reproduce").printed(), &["lecture", "nori", "square-crossings", "twoforms reproduce NAME"]);
}

#[test]
fn a_document_holds_what_the_contract_names() {
    let json = twoforms("reproduce nori --quick --quiet --format json").json();
    assert_eq!(json["schema"], "twoforms.reproduce/1");
    let nori = &json["reproductions"][0];
    assert_eq!(nori["name"], "nori");
    assert!(nori["source"].as_str().is_some_and(|source| source.contains("test-direct.xml")));
    let row = &nori["rows"][0];
    assert_eq!((row["published"].as_f64(), row["verdict"].as_str()), (Some(0.089_839_4), Some("agrees")));
    let [low, high] = [0, 1].map(|end| row["interval"][end].as_f64().expect("an end"));
    assert!(row["exact"].as_f64().is_some_and(|exact| low < exact && exact < high), "{row}");
    for key in ["quantity", "measured", "note"] {
        assert!(row.get(key).is_some(), "{key} is missing: {row}");
    }
}

#[test]
fn a_user_s_file_runs_with_fields_set_and_is_written_beside_the_results() {
    let folder = folder("reproduce");
    let path = written(&folder, "die.toml", DIE);
    let out = folder.join("results");
    let said = twoforms(&format!("reproduce {path} --quiet -D seed=7 -D replicates=40000 --out {}", out.display()));
    has_all(&said.printed(), &["die: a die", "seed 7", "mean", "agrees"]);
    assert_eq!(names(&out), ["die.toml", "reproduce.csv", "reproduce.json"]);
    let resolved = fs::read_to_string(out.join("die.toml")).expect("a file");
    has_all(&resolved, &["seed = 7", "replicates = 40000"]);
    let again = twoforms(&format!("reproduce {} --quiet", out.join("die.toml").display())).printed();
    has_all(&again, &["seed 7", "agrees"]);
}

#[test]
fn a_result_that_differs_is_an_exit_code_of_three_where_it_is_checked() {
    let path = written(&folder("differs"), "die.toml", &DIE.replace("3.5", "3.9"));
    let run = twoforms(&format!("reproduce {path} --quiet --check"));
    assert_eq!(run.code, Some(3), "{}", run.err);
    has_all(&run.out, &["differs"]);
    assert_eq!(twoforms(&format!("reproduce {path} --quiet")).code, Some(0));
}

#[test]
fn what_is_wrong_with_a_file_is_told_with_its_line_and_nothing_is_written() {
    let folder = folder("wrong");
    let out = folder.join("results");
    for (name, text, says) in [
        (
            "key",
            DIE.replace("replicates", "replicats"),
            ":4:1: unknown key \"replicats\"; did you mean \"replicates\"?",
        ),
        ("type", DIE.replace("20000", "\"many\""), ":4:14: invalid type: string \"many\""),
        ("range", DIE.replace("20000", "1"), ":4:14: replicates are 2 to"),
        ("word", DIE.replace("mean", "meen"), ":6:12: unknown word \"meen\"; did you mean \"mean\"?"),
        ("number", DIE.replace("\"3.5\"", "\"three\""), ":7:13: \"three\" is not a number"),
        ("subject", DIE.replace("values = [1, 2, 3, 4, 5, 6]\n", ""), ":2:1: an experiment has one subject"),
        (
            "scene",
            DIE.replace("values = [1, 2, 3, 4, 5, 6]", "scene = \"cornel-box.gltf\""),
            "did you mean \"cornell-box.gltf\"?",
        ),
        (
            "formula",
            DIE.replace("values = [1, 2, 3, 4, 5, 6]", "integrand = \"5*z\""),
            ":3:13: \"z\" is neither an axis nor",
        ),
    ] {
        let path = written(&folder, &format!("{name}.toml"), &text);
        twoforms(&format!("reproduce {path} --quiet --out {}", out.display())).fails(&[says]);
        assert!(!out.join("reproduce.json").exists() && !out.join(format!("{name}.toml")).exists(), "{name}");
    }
    twoforms("reproduce lectur").fails(&["there is no reproduction \"lectur\"", "did you mean \"lecture\"?"]);
    twoforms("reproduce missing.toml").fails(&["missing.toml cannot be read"]);
}

#[test]
fn compare_runs_an_experiment_in_a_file() {
    let folder = folder("experiment");
    fs::copy(scene("square-light"), folder.join("square-light.gltf")).expect("a copy");
    let text = "seed = 5\n[[experiment]]\nscene = \"square-light.gltf\"\nreceivers = [\"near\"]\n\
                strategies = [\"area/uniform\"]\nsamples = [4, 16]\nreplicates = 50\n";
    let path = written(&folder, "mine.toml", text);
    let json = twoforms(&format!("compare {path} --format json")).json();
    assert_eq!(json["provenance"]["seed"], "5");
    let rows = json["receivers"][0]["rows"].as_array().expect("rows");
    assert_eq!(rows.iter().map(|row| row["samples"].as_u64()).collect::<Vec<_>>(), [Some(4), Some(16)]);
    let out = folder.join("results");
    let set = format!("compare {path} -D samples=[8] -D replicates=60 --format json --out {}", out.display());
    let json = twoforms(&set).json();
    let row = &json["receivers"][0]["rows"][0];
    assert_eq!((row["samples"].as_u64(), row["replicates"].as_u64()), (Some(8), Some(60)));
    assert_eq!(names(&out), ["compare.csv", "compare.json", "experiment.toml"]);
    twoforms(&format!("compare {path} --samples 8")).fails(&["says its samples", "-D samples="]);
    twoforms("compare @square-light -D samples=8").fails(&["sets a field of an experiment's file"]);
    let wrong = written(&folder, "wrong.toml", &text.replace("area/uniform", "area/unform"));
    twoforms(&format!("compare {wrong}")).fails(&["wrong.toml:5:15", "area/uniform"]);
}
