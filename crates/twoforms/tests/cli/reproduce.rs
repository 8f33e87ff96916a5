//! `reproduce`, and experiments in files: by name, from a file, with fields set from outside.

use std::fs;

use crate::support::{folder, has_all, names, run, scene, twoforms, written};

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
fn a_variance_that_its_bound_does_not_tell_from_zero_is_shown_as_zero() {
    let text = twoforms("reproduce furnace --quick --quiet").printed();
    let found: Vec<&str> =
        text.lines().filter(|l| l.contains("of hemisphere/cosine") && l.ends_with("exact")).collect();
    assert_eq!(found.len(), 4, "{text}");
    assert!(found.iter().all(|line| line.contains(" 0 ± ")), "{found:?}");
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
        ("range", DIE.replace("20000", "1"), ":4:14: needs a whole number from 2 to 100000000"),
        ("sign", DIE.replace("20000", "-5"), ":4:14: "),
        ("samples", DIE.replace("replicates = 20000", "samples = [4, 0]"), ":4:11: needs whole numbers from 1"),
        ("none", DIE.replace("replicates = 20000", "samples = []"), ":4:11: needs whole numbers from 1"),
        ("detects", format!("detects = 0\n{DIE}"), ":1:11: needs a number above 0"),
        ("share", format!("{DIE}delta = 1.5\n"), ":8:9: needs a number between 0 and 1"),
        ("interval", format!("{DIE}interval = [2, 1]\n"), ":8:12: needs [a', b'] with a' <= b'"),
        ("nodes", format!("{DIE}nodes = 0\n"), ":8:9: needs a whole number from 1"),
        ("nested", DIE.replace("replicates = 20000", "nested = [1, 1]"), ":4:10: needs [outer, inner]"),
        ("seed", format!("seed = {}\n{DIE}", u64::MAX), ":1:8: needs a whole number from 0 to 9223372036854775807"),
        ("domain", DIE.replace("replicates = 20000", "domain = [[0, 1, 2]]"), ":4:10: needs [a, b] along each axis"),
        ("idle", DIE.replace("replicates = 20000", "domain = [[0, 1]]"), ":4:1: \"domain\" is for an integrand"),
        ("of-scenes", DIE.replace("replicates = 20000", "grid = [2, 2]"), ":4:1: \"grid\" is for a scene, and"),
        ("of-a-row", format!("{DIE}strategy = \"area/uniform\"\n"), ":8:1: \"strategy\" is for a scene"),
        ("of-others", format!("{DIE}nodes = 4\n"), ":8:1: \"nodes\" means nothing to the quantity \"mean\""),
        ("no-number", format!("{DIE}derived-error = 0.1\n"), ":8:1: \"derived-error\" is of a derived number"),
        (
            "samplers",
            DIE.replace("replicates = 20000", "samplers = [\"sobol\", \"independent\"]"),
            ":4:22: an experiment without a scene has one sampler",
        ),
        ("derived", format!("{DIE}derived = \"7/\"\n"), ":8:11: \"7/\" is no formula"),
        ("pole", format!("{DIE}derived = \"1/0\"\n"), ":8:11: it has no finite value"),
        (
            "density",
            DIE.replace(
                "values = [1, 2, 3, 4, 5, 6]",
                "integrand = \"x\"\ndensity = [{ cdf = \"x\", invers = \"xi\" }]",
            ),
            ":4:25: unknown key \"invers\"; did you mean \"inverse\"?",
        ),
        ("missing", DIE.replace("quantity = \"mean\"", "note = \"?\""), "missing field `quantity`"),
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
    twoforms(&format!("compare {path} --samples 8")).fails(&["--samples belongs into", "mine.toml", "-D samples="]);
    twoforms(&format!("compare {path} --sampler sobol")).fails(&["--sampler belongs into", "its key samplers"]);
    twoforms("compare @square-light -D samples=8").fails(&["sets a field of an experiment's file"]);
    let wrong = written(&folder, "wrong.toml", &text.replace("area/uniform", "area/unform"));
    twoforms(&format!("compare {wrong}")).fails(&["wrong.toml:5:15", "area/uniform"]);
}

/// A key for every option: equal results, by their hash.
#[test]
fn a_file_says_what_options_say() {
    let folder = folder("keys");
    written(&folder, "points.csv", "0.1,0,0.2,0,1,0\n");
    let hash = |line: &str| run(line.split(' ')).json()["results_sha256"].as_str().expect("a hash").to_owned();
    let same = |name: &str, keys: &str, options: &str| {
        let path =
            written(&folder, &format!("{name}.toml"), &format!("[[experiment]]\nscene = \"cornell-box.gltf\"\n{keys}"));
        let [file, line] = [format!("compare {path}"), format!("compare {} {options}", scene("cornell-box"))];
        assert_eq!(
            hash(&format!("{file} --quiet --format json")),
            hash(&format!("{line} --quiet --format json")),
            "{name}"
        );
    };
    let few = "samples = [1, 4]\nreplicates = 20\nstrategies = [\"area/uniform\"]\n";
    let options = "--samples 1,4 --replicates 20 --strategies area/uniform";
    same("plain", few, options);
    same(
        "places",
        &format!(
            "{few}at = [[0.2, 0, 0.1, 0, 3, 0], \"@points.csv\"]\nreceivers = [\"floor-lit\"]\npixels = [[64, 64]]\n\
             grid = [2, 2]\nheight = 128\nwidth = 128\nview = [0, 0.3, 2, 0, 0.2, 0, 40]\n"
        ),
        &format!(
            "{options} --at 0.2,0,0.1,0,3,0 --at @{} --receiver floor-lit --pixel 64,64 --grid 2,2 --height 128 \
             --width 128 --view 0,0.3,2,0,0.2,0,40",
            folder.join("points.csv").display()
        ),
    );
    same(
        "radiance",
        &format!(
            "{few}quantity = \"radiance\"\nlambert = true\nalbedo = [0.2, 0.3, 0.4]\ncamera = 0\nat = [[0, 0.1, 0, 0, 1, 0]]\n"
        ),
        &format!("{options} --quantity radiance --lambert --albedo 0.2,0.3,0.4 --camera 0 --at 0,0.1,0,0,1,0"),
    );
    same(
        "verdicts",
        &format!("{few}samplers = [\"independent\", \"sobol\"]\nlevel = 0.2\nmargin = 0.5\n"),
        &format!("{options} --sampler independent,sobol --level 0.2 --margin 0.5"),
    );
    same("seed", &format!("{few}receivers = [\"floor-lit\"]\n"), &format!("{options} --receiver floor-lit --seed 0"));
}

/// At a level near one an interval has next to no width, so that any estimate lies outside: seed 0, 800 samples.
#[test]
fn a_file_may_ask_for_a_check_and_its_seed_may_be_set() {
    let text = "seed = 3\n[[experiment]]\nscene = \"cornell-box.gltf\"\nreceivers = [\"floor-lit\"]\n\
                strategies = [\"area/uniform\"]\nsamples = [4]\nreplicates = 200\nlevel = 0.9999999\nmargin = 1e-9\n\
                check = true\n";
    let folder = folder("check-key");
    let path = written(&folder, "check.toml", text);
    let run = twoforms(&format!("compare {path} --quiet"));
    assert_eq!(run.code, Some(3), "{}", run.err);
    let out = folder.join("results");
    let line = format!("compare {path} -D check=false --seed 0 --format json --out {}", out.display());
    assert_eq!(twoforms(&line).json()["provenance"]["seed"], "0");
    has_all(&fs::read_to_string(out.join("experiment.toml")).expect("a file"), &["seed = 0", "check = false"]);
}

#[test]
fn what_a_file_asks_of_a_scene_in_vain_is_told_with_its_line() {
    let folder = folder("in-vain");
    let text = |keys: &str| format!("[[experiment]]\nscene = \"cornell-box.gltf\"\nreplicates = 9\n{keys}\n");
    for (name, keys, says) in [
        (
            "receiver",
            "receivers = [\"floor-lit\", \"flor-lit\"]",
            ":4:27: the scene has no receiver \"flor-lit\"; did you mean",
        ),
        ("camera", "camera = \"mian\"", ":4:10: the scene has no camera \"mian\""),
        ("pixel", "pixels = [[9999, 1]]", ":4:10: pixel 9999,1 lies outside the image"),
        ("grid", "grid = [0, 3]", ":4:8: has 0 cells; a grid has 1 to"),
        ("view", "view = [0, 0, 0, 0, 0, 0, 40]", ":4:8: the eye and what it looks at are the same point"),
        ("width", "width = 0", ":4:9: needs a whole number from 1 to 65536"),
        ("albedo", "quantity = \"radiance\"\nalbedo = 1.5", ":5:10: an albedo lies between 0 and 1"),
        ("idle", "albedo = 0.5", ":4:10: an albedo is for radiance: add quantity = \"radiance\""),
        ("lambert", "lambert = true", ":4:11: lambert is for radiance: add quantity = \"radiance\""),
        (
            "size",
            "receivers = [\"floor-lit\"]\nheight = 64",
            ":5:10: width and height are of the image that pixels and",
        ),
        ("cameras", "view = [0, 0, 1, 0, 0, 0, 40]\ncamera = 0", ":4:8: a view is a camera by itself"),
        ("integral", "axes = [\"x\"]", ":4:1: \"axes\" is for an integrand, and the experiment has none"),
        ("on-a-light", "at = [[0, 0.1, 0, 0, 1, 0], [0.27, 0.548799991607666, 0.28, 1, -1, 0]]", ":4:29: the receiver"),
        ("quantity", "quantity = \"radience\"", ":4:12: unknown word \"radience\"; did you mean \"radiance\"?"),
        ("level", "level = 2", ":4:9: needs a number between 0 and 1"),
        ("normal", "at = [[0, 0, 0, 0, 0, 0]]", ":4:7: the normal has no direction"),
        ("finite", "at = [[nan, 0, 0, 0, 1, 0]]", ":4:7: \"NaN\" is not a finite number"),
        ("file", "at = [\"@none.csv\"]", ":4:7: cannot read"),
        ("sampler", "samplers = [\"sobel\"]", ":4:13: "),
        ("none", "strategies = []", ":4:14: needs at least one name"),
        ("nothing", "samplers = []", ":4:12: needs at least one name"),
        ("seven", "at = [[0, 0, 0, 0, 1, 0, 99]]", ":4:7: needs six numbers"),
        ("three", "grid = [2, 2, 9]", ":4:8: needs two numbers"),
        ("deep", "pixels = [[64, 64, 3]]", ":4:10: needs pixels as [x, y] each"),
        ("eight", "view = [0, 0, 0, 0, 0, 1, 40, 7]", ":4:8: needs seven numbers"),
        ("unknown", "sampler = \"sobol\"", ":4:1: unknown key \"sampler\"; did you mean \"samplers\"?"),
    ] {
        let (path, out) = (written(&folder, &format!("{name}.toml"), &text(keys)), folder.join(name));
        for command in ["compare", "reproduce"] {
            twoforms(&format!("{command} {path} --quiet --out {}", out.display())).fails(&[says]);
            assert!(!out.join("compare.json").exists() && !out.join("reproduce.json").exists(), "{name}");
        }
    }
    let set = written(&folder, "set.toml", &text(""));
    twoforms(&format!("compare {set} -D replicates=0")).fails(&["-D replicates=0: needs a whole number from 2"]);
    twoforms(&format!("compare {set} -D seed=9223372036854775808")).fails(&["seed=9223372036854775808: needs a whole"]);
    twoforms(&format!("compare {set} -D grid=[0,1]")).fails(&["-D grid=[0,1]: has 0 cells"]);
    let most = u64::MAX;
    twoforms(&format!("compare {set} --seed {most}"))
        .fails(&["18446744073709551615 is more than", "9223372036854775807"]);
}

#[test]
fn what_was_read_is_not_written_over() {
    let folder = folder("spare");
    let mine = written(&folder, "die.toml", DIE);
    let other = crate::support::folder("spare-other");
    let also = written(&other, "die.toml", DIE);
    twoforms(&format!("reproduce {mine} -D replicates=200 --out {}", folder.display()))
        .fails(&["write over", "die.toml"]);
    twoforms(&format!("reproduce {mine} {also} --out {}", folder.join("out").display())).fails(&["two of the files"]);
    let experiment = written(&folder, "experiment.toml", "[[experiment]]\nscene = \"cornell-box.gltf\"\n");
    twoforms(&format!("compare {experiment} --out {}", folder.display())).fails(&["write over", "experiment.toml"]);
    assert_eq!(fs::read_to_string(mine).expect("a file"), DIE);
}
