//! Input that cannot be used: exit code 1 and one line that says what, where, and what to do.

use std::fs;

use serde_json::{Value, json};

use crate::support::{Run, changed_box, folder, run, scene, twoforms, without_camera, without_receivers, written};

/// The commands that take a scene.
const COMMANDS: [&str; 4] = ["compare", "exact", "render", "inspect"];

#[test]
fn files_that_are_no_scene_are_refused_by_every_command() {
    let folder = folder("no-scene");
    let text = |name, text| written(&folder, name, text);
    let cases = [
        (folder.join("missing.gltf").display().to_string(), "cannot read the file"),
        (folder.display().to_string(), "it is a folder"),
        (text("empty.gltf", ""), "the file is empty"),
        (text("empty.glb", ""), "the file is empty"),
        (text("words.gltf", "hello"), "not glTF 2.0"),
        (text("braces.gltf", "{}"), "not glTF 2.0"),
        (text("old.gltf", r#"{"asset":{"version":"1.0"}}"#), "version is \"1.0\""),
        (text("picture.glb", "\u{89}PNG\r\n\u{1a}\n"), "not glTF 2.0"),
        (text("header.glb", "glTF"), "its header is cut short"),
        (text("cut.gltf", &fs::read_to_string(scene("cornell-box")).expect("a scene")[..300]), "not glTF 2.0"),
    ];
    for (path, says) in &cases {
        for command in COMMANDS {
            run([command, path]).fails(&[path, says]);
        }
    }
}

#[test]
fn a_scene_without_light_can_be_inspected_and_no_more() {
    let folder = folder("no-light");
    let path = changed_box(&folder, "dark.gltf", |gltf| {
        for material in gltf["materials"].as_array_mut().expect("materials") {
            material["emissiveFactor"] = json!([0, 0, 0]);
        }
    });
    let says = ["dark.gltf", "no triangle emits light", "emissiveFactor above zero"];
    run(["compare", &path]).fails(&says);
    run(["exact", &path]).fails(&says);
    run(["render", &path, "-o", &folder.join("dark.exr").display().to_string()]).fails(&says);
    assert!(run(["inspect", &path]).printed().contains("0 lights"));
}

#[test]
fn a_camera_must_be_there_where_one_is_needed() {
    let folder = folder("no-camera");
    let path = changed_box(&folder, "blind.gltf", without_camera);
    let says = ["no camera", "--camera auto", "--view EX,EY,EZ,TX,TY,TZ,FOV"];
    let exr = folder.join("blind.exr").display().to_string();
    run(["render", &path, "-o", &exr]).fails(&says);
    run(["compare", &path, "--grid", "2,2"]).fails(&says);
    run(["exact", &path, "--pixel", "2,2"]).fails(&says);
}

#[test]
fn a_camera_that_is_named_must_exist_and_see_something() {
    let says = ["no camera \"camra\"", "did you mean \"camera\""];
    twoforms("compare @cornell-box --camera camra").fails(&says);
    twoforms("compare @cornell-box --camera camra --grid 2,2").fails(&says);
    twoforms("render @cornell-box --camera camra").fails(&says);
    twoforms("compare @cornell-box --camera 7").fails(&["no camera \"7\""]);
    twoforms("compare @cornell-box --view 9,9,9,10,10,10,40 --grid 2,2").fails(&["sees nothing", "--camera"]);
    twoforms("compare @cornell-box --pixel 0,0").fails(&["pixel 0,0 sees nothing", "--camera"]);
    twoforms("compare @cornell-box --pixel 512,0").fails(&["512 × 512", "--width"]);
}

#[test]
fn a_receiver_must_exist() {
    twoforms("compare @cornell-box --receiver flor-lit").fails(&["\"flor-lit\"", "did you mean \"floor-lit\""]);
    let path = changed_box(&folder("no-receiver"), "none.gltf", without_receivers);
    run(["compare", &path, "--receiver", "a"]).fails(&["no receiver \"a\", nor any other", "--at X,Y,Z,NX,NY,NZ"]);
}

#[test]
fn files_of_points_are_refused_with_the_line() {
    let folder = folder("points");
    for (name, text, says) in [
        ("short.csv", "0.2,0,0.1,0,1,0\n1,2,3\n", "line 2: has 3 numbers where 6 are needed"),
        ("flat.csv", "0.2,0,0.1,0,0,0\n", "line 1: the normal has no direction"),
        ("nan.csv", "nan,0,0,0,1,0\n", "line 1: \"nan\" is not a finite number"),
        ("semicolons.csv", "0;0;0;0;1;0\n", "line 1: \"0;0;0;0;1;0\" is not a finite number"),
        ("none.csv", "x,y,z,nx,ny,nz\n# none\n", "holds no receiver"),
    ] {
        let path = written(&folder, name, text);
        run(["compare", &scene("cornell-box"), "--at", &format!("@{path}")]).fails(&[name, says]);
    }
    let missing = format!("@{}", folder.join("missing.csv").display());
    run(["compare", &scene("cornell-box"), "--at", &missing]).fails(&["missing.csv", "cannot read"]);
}

#[test]
fn radiance_off_any_surface_needs_an_albedo() {
    let line = "compare @cornell-box --quantity radiance --at 0.2,0.1,0.1,0,1,0 --samples 1 --replicates 2";
    twoforms(line).fails(&["no surface", "--albedo"]);
    assert_eq!(twoforms(&format!("{line} --albedo 0.5,0.4,0.3")).code, Some(0));
}

/// A surface with a highlight sends its radiance somewhere: that needs a camera, on its side.
#[test]
fn radiance_of_a_highlight_needs_a_camera_that_sees_it() {
    let folder = folder("highlights");
    let polished = |gltf: &mut Value| {
        for material in gltf["materials"].as_array_mut().expect("materials") {
            material["pbrMetallicRoughness"]["roughnessFactor"] = json!(0.5);
        }
    };
    let box_with = |name: &str, change: &dyn Fn(&mut Value)| {
        changed_box(&folder, name, |gltf| {
            polished(gltf);
            change(gltf);
        })
    };
    let blind = box_with("blind.gltf", &without_camera);
    let ask = |path: &str, more: &[&str]| {
        let words = [
            "exact",
            path,
            "--quantity",
            "radiance",
            "--receiver",
            "floor-corner",
            "--strategies",
            "area/uniform,hemisphere/brdf,mis/balance",
        ];
        run(words.iter().chain(more).copied())
    };
    ask(&blind, &[]).fails(&["floor-corner", "highlight", "--camera auto", "--view", "--lambert"]);
    let seeing = box_with("seeing.gltf", &|_| ());
    ask(&seeing, &["--view", "0.3,-5,0.2,0.3,0,0.2,40"]).fails(&["behind the surface", "floor-corner", "--lambert"]);
    let luminance = |run: Run| {
        let document = run.json();
        let receiver = &document["receivers"][0];
        for variance in receiver["strategies"].as_object().expect("strategies").values() {
            assert!(variance["variance_of_one"]["luminance"].as_f64().is_some_and(|v| v > 0.0), "{variance}");
        }
        receiver["irradiance"]["luminance"].as_f64().expect("a number")
    };
    let json = ["--format", "json"];
    let diffuse = luminance(ask(&blind, &["--lambert", "--format", "json"]));
    assert!((diffuse - luminance(ask(&scene("cornell-box-empty"), &json))).abs() < 1e-12);
    assert!(luminance(ask(&seeing, &json)) != diffuse);
    let exr = folder.join("ratio.exr").display().to_string();
    run(["render", &seeing, "--strategy", "ratio", "--spp", "1", "-o", &exr]).fails(&["ratio", "--lambert"]);
}

#[test]
fn what_memory_would_not_hold_is_not_begun() {
    let count = "4294967295";
    twoforms(&format!("compare @cornell-box --samples {count} --replicates {count}")).fails(&["at most", "replicates"]);
    let exr = folder("too-large").join("huge.exr");
    twoforms(&format!("render @cornell-box --width 65536 --height 65536 -o {}", exr.display())).fails(&["--crop"]);
    twoforms(&format!("render @cornell-box --width 2 --crop 0,0.1,0,0.1 -o {}", exr.display()))
        .fails(&["--crop leaves no pixel"]);
}

#[test]
fn a_name_in_a_scene_cannot_break_the_line_or_command_the_terminal() {
    let path = changed_box(&folder("escapes"), "names.gltf", |gltf| {
        let node = gltf["nodes"].as_array_mut().expect("nodes").iter_mut().find(|node| node.get("camera").is_some());
        node.expect("a camera")["name"] = json!("\u{1b}[31mred\nline");
    });
    run(["compare", &path, "--camera", "rod"]).fails(&["\\u{1b}[31mred\\nline"]);
    let said = run(["inspect", &path]).printed();
    assert!(said.contains("\\u{1b}[31mred\\nline") && !said.contains('\u{1b}'), "{said}");
}
