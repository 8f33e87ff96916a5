//! `exact --sweep` on a unit square of radiance 1: the heights at which two strategies are equally good.
//!
//! The expected numbers were computed with 34 digits from the edge sums of the square alone, without this program.

use std::path::PathBuf;
use std::process::{Command, Output};
use std::{env, fs};

use serde_json::{Value, json};

/// The square −½ <= x, z <= ½ at y = 0, emitting down, in a file of its own; `name` keeps tests apart.
fn square(name: &str) -> String {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("sweep");
    fs::create_dir_all(&folder).expect("a folder");
    let corners: [[f32; 3]; 4] = [[-0.5, 0.0, -0.5], [0.5, 0.0, -0.5], [0.5, 0.0, 0.5], [-0.5, 0.0, 0.5]];
    let mut bytes: Vec<u8> = corners.iter().flatten().flat_map(|c| c.to_le_bytes()).collect();
    bytes.extend([0_u16, 1, 2, 0, 2, 3].iter().flat_map(|index| index.to_le_bytes()));
    fs::write(folder.join(format!("{name}.bin")), &bytes).expect("a file");
    let gltf = json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "square", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"emissiveFactor": [1.0, 1.0, 1.0], "pbrMetallicRoughness": {"metallicFactor": 0}}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-0.5, 0, -0.5], "max": [0.5, 0, 0.5]},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 12}
        ],
        "buffers": [{"uri": format!("{name}.bin"), "byteLength": bytes.len()}]
    });
    let path = folder.join(format!("{name}.gltf"));
    fs::write(&path, gltf.to_string()).expect("a file");
    path.display().to_string()
}

fn exact(scene: &str, line: &str) -> Output {
    let words = line.split_whitespace();
    Command::new(env!("CARGO_BIN_EXE_twoforms"))
        .args(["exact", scene])
        .args(words)
        .output()
        .expect("the program starts")
}

fn printed(scene: &str, line: &str) -> String {
    let output = exact(scene, line);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), said.as_ref()), (Some(0), ""), "{line}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn receiver(scene: &str, line: &str) -> Value {
    let document: Value = serde_json::from_str(&printed(scene, &format!("{line} --format json"))).expect("JSON");
    document["receivers"][0].clone()
}

/// The three basic strategies, in the order of [`Roots`].
const BASIC: &str = "--strategies area/uniform,hemisphere/cosine,hemisphere/uniform";

/// The heights at which area/uniform and hemisphere/cosine are equal, area/uniform and hemisphere/uniform, and the two
/// hemisphere ones.
type Roots<'a> = [&'a [f64]; 3];

/// Checks that the crossings are these to `digits` significant digits, and no others.
fn crosses(receiver: &Value, expected: Roots, digits: i32) {
    let pairs = [
        ["area/uniform", "hemisphere/cosine"],
        ["area/uniform", "hemisphere/uniform"],
        ["hemisphere/cosine", "hemisphere/uniform"],
    ];
    let crossings = receiver["sweep"]["crossings"].as_array().expect("crossings");
    for (pair, expected) in pairs.iter().zip(expected) {
        let of_pair = crossings.iter().filter(|crossing| crossing["strategies"] == json!(pair));
        let mut found: Vec<f64> = of_pair.map(|crossing| crossing["at"].as_f64().expect("a number")).collect();
        found.sort_by(f64::total_cmp);
        assert_eq!(found.len(), expected.len(), "{pair:?}: {found:?}");
        for (found, expected) in found.iter().zip(expected) {
            let unit = 10_f64.powf(expected.log10().floor() + 1.0 - f64::from(digits));
            assert!((found - expected).abs() <= 0.5 * unit, "{pair:?}: {found} is not {expected}");
        }
    }
    assert_eq!(crossings.len(), expected.iter().map(|roots| roots.len()).sum::<usize>(), "{crossings:?}");
    for crossing in crossings {
        let bound = crossing["error_bound"].as_f64().expect("a number");
        assert!((0.0..1e-9).contains(&bound), "{crossing}");
    }
}

/// Offsets along x of a receiver that looks up, and the heights of the square above it, all in units of its side.
const HEIGHTS: [(f64, Roots); 9] = [
    (0.0, [&[0.390_387_878_4], &[0.296_531_457_6], &[]]),
    (0.25, [&[0.399_078_809_1], &[0.303_072_843_5], &[]]),
    (0.5, [&[0.364_628_463_5], &[0.290_616_870_7], &[]]),
    (0.6, [&[0.045_286_024_9, 0.285_888_731_3], &[0.017_713_918_9, 0.234_684_533_2], &[0.131_538_258_1]]),
    (0.75, [&[], &[], &[0.265_261_026_1]]),
    (1.0, [&[], &[], &[0.445_092_493_1]]),
    (2.0, [&[], &[], &[1.082_085_339_3]]),
    // below a corner, and as far out again
    (-0.5, [&[0.340_687_564_0], &[0.284_282_611_5], &[]]),
    (-1.0, [&[], &[], &[0.693_276_101_3]]),
];

/// A negative offset in [`HEIGHTS`] stands for that along both axes.
fn place(offset: f64) -> [f64; 2] {
    if offset < 0.0 { [-offset, -offset] } else { [offset, 0.0] }
}

#[test]
fn a_square_moved_up_crosses_where_it_must() {
    let scene = square("light");
    for (offset, expected) in HEIGHTS {
        let [x, z] = place(offset);
        let line = format!("--at {x},0,{z},0,1,0 --sweep light.y=0.01:10:log:37 {BASIC}");
        crosses(&receiver(&scene, &line), expected, 9);
    }
}

#[test]
fn a_receiver_moved_down_crosses_where_it_must() {
    let scene = square("receiver");
    for (offset, expected) in HEIGHTS {
        let [x, z] = place(offset);
        let line = format!("--at {x},0,{z},0,1,0 --sweep receiver.y=-10:-0.01:2000 {BASIC}");
        let negative = receiver(&scene, &line)["sweep"]["crossings"].clone();
        let mut turned = json!({"sweep": {"crossings": negative}});
        for crossing in turned["sweep"]["crossings"].as_array_mut().expect("crossings") {
            crossing["at"] = json!(-crossing["at"].as_f64().expect("a number"));
        }
        crosses(&turned, expected, 9);
    }
}

/// Turned over, the receiver meets the same square along its own normal: at 1 − h, at the height h.
#[test]
fn a_receiver_moved_along_its_normal_crosses_where_it_must() {
    let line = format!("--at 0.6,-1,0,0,1,0 --sweep receiver.normal=0.5:0.99:50 {BASIC}");
    let expected: Roots = [
        &[1.0 - 0.285_888_731_3, 1.0 - 0.045_286_024_9],
        &[1.0 - 0.234_684_533_2, 1.0 - 0.017_713_918_9],
        &[1.0 - 0.131_538_258_1],
    ];
    crosses(&receiver(&square("normal"), &line), expected, 9);
}

/// Two crossings of one pair between the same two steps show as a dip.
#[test]
fn few_steps_find_both_crossings() {
    let line = format!("--at 0.6,0,0,0,1,0 --sweep light.y=0.01:10:log:5 {BASIC}");
    let (_, expected) = HEIGHTS[3];
    crosses(&receiver(&square("few"), &line), expected, 9);
}

/// Below the receiver the square gives nothing; the crossings lie between its plane and the first step above it.
#[test]
fn crossings_just_beyond_the_edge_of_the_light_are_found() {
    let line = format!("--at 0,0,0,0,1,0 --sweep light.y=-1:1:5 {BASIC}");
    crosses(&receiver(&square("edge"), &line), HEIGHTS[0].1, 9);
}

/// Only the ratio of side and height counts; from the height 1 the scale is side over height.
#[test]
fn a_growing_square_crosses_where_it_must() {
    let line = format!("--at 0,-1,0,0,1,0 --sweep light.scale=0.1:100:log:37 {BASIC}");
    crosses(&receiver(&square("scale"), &line), [&[1.0 / 0.390_387_878_4], &[1.0 / 0.296_531_457_6], &[]], 9);
}

/// What the lights' own motion gives is what a receiver sees that moves against it: nothing else is in the scene.
#[test]
fn moving_the_light_is_moving_the_receiver_the_other_way() {
    let scene = square("relative");
    let all = "area/uniform,area/uniform@power,area/solid-angle,area/projected-solid-angle,mis/balance,mis/optimal";
    for (axis, from, to) in [("x", -0.3, 2.0), ("y", 0.2, 1.2), ("z", -1.0, 0.4)] {
        let line = |what: &str, from: f64, to: f64| {
            format!("--at 0.125,-0.25,0.5,0.3,1,-0.2 --sweep {what}.{axis}={from}:{to}:6 --strategies {all}")
        };
        let light = receiver(&scene, &line("light", from, to));
        let moved = receiver(&scene, &line("receiver", -from, -to));
        let steps = light["sweep"]["steps"].as_array().expect("steps").iter();
        for (one, other) in steps.zip(moved["sweep"]["steps"].as_array().expect("steps")) {
            close(&one["irradiance"]["luminance"], &other["irradiance"]["luminance"]);
            for name in all.split(',') {
                let variance = |step: &Value| step["strategies"][name]["variance_of_one"]["luminance"].clone();
                close(&variance(one), &variance(other));
            }
        }
    }
}

fn close(one: &Value, other: &Value) {
    let (one, other) = (one.as_f64().expect("a number"), other.as_f64().expect("a number"));
    assert!((one - other).abs() <= 1e-12 * one.abs().max(1e-3), "{one} and {other}");
}

#[test]
fn the_document_has_a_sweep_for_each_receiver() {
    let receiver = receiver(&square("fields"), "--at 0,-1,0,0,1,0 --sweep light.scale=0.5:2:log:3");
    let sweep = &receiver["sweep"];
    assert_eq!([&sweep["parameter"], &sweep["scale"]], ["light.scale", "log"]);
    assert_eq!([&sweep["from"], &sweep["to"]], [0.5, 2.0]);
    let steps = sweep["steps"].as_array().expect("steps");
    assert_eq!(steps.len(), 3);
    let names = [
        "area/uniform",
        "hemisphere/cosine",
        "hemisphere/uniform",
        "area/solid-angle",
        "area/projected-solid-angle",
        "mis/balance",
    ];
    for step in steps {
        let strategies = step["strategies"].as_object().expect("strategies");
        assert_eq!(strategies.keys().collect::<Vec<_>>(), names);
        assert!(strategies.values().all(|v| v["variance_of_one"]["error_bound"].is_f64()), "{step}");
    }
    // At scale 1 the light is where the scene has it.
    assert_eq!([&steps[0]["at"], &steps[2]["at"]], [0.5, 2.0]);
    close(&steps[1]["irradiance"]["luminance"], &receiver["irradiance"]["luminance"]);
}

#[test]
fn the_csv_has_a_line_per_step_and_a_column_for_the_parameter() {
    let csv = printed(&square("csv"), &format!("--at 0,-1,0,0,1,0 --sweep light.y=0:1:3 {BASIC} --format csv"));
    let lines: Vec<Vec<&str>> = csv.lines().map(|line| line.rsplit(',').collect()).collect();
    assert_eq!((lines.len(), lines[0][0]), (1 + 3 * 3, "light.y"));
    let at: Vec<&str> = lines[1..].iter().map(|cells| cells[0]).collect();
    assert_eq!(at, ["0.0", "0.0", "0.0", "0.5", "0.5", "0.5", "1.0", "1.0", "1.0"]);
}

#[test]
fn the_table_shows_steps_and_crossings() {
    let scene = square("table");
    let table = printed(&scene, "--at 0,0,0,0,1,0 --sweep light.y=0.1:1:log:5");
    let widest = table.lines().map(|line| line.chars().count()).max();
    assert!(widest.is_some_and(|width| width <= 120), "{table}");
    for says in ["light.y from 0.1 to 1 in 5 steps of equal ratio", "mis/", "0.3903878784", "closer together"] {
        assert!(table.contains(says), "{says} is not in\n{table}");
    }
    let many = "area/uniform,area/uniform@power,area/uniform@uniform,hemisphere/cosine,hemisphere/uniform,\
                hemisphere/toward-lights,mixture/0.1,mixture/0.2,mixture/0.3";
    let crossings = printed(&scene, &format!("--at 0,0,0,0,1,0 --sweep light.y=0.1:1:log:5 --strategies {many}"));
    assert!(crossings.contains("9 strategies are too many columns"), "{crossings}");
    // Four of these are one density: none of them crosses another.
    for names in ["area/uniform = area/uniform@power", "area/uniform = hemisphere/toward-lights"] {
        assert!(!crossings.contains(names), "{crossings}");
    }
}

#[test]
fn what_is_no_sweep_is_misuse() {
    for (sweep, says) in [
        ("receiver.w=0:1:5", "did you mean \"receiver."),
        ("lihgt.scale=1:2:5", "did you mean \"light.scale\"?"),
        ("light.y=0:inf:5", "not finite"),
        ("light.y=0:1:log:5", "above zero"),
        ("light.scale=0:1:5", "above zero"),
        ("light.y=0:1:1", "2 to 100000 steps"),
        ("light.y", "the form is PARAM=FROM:TO[:log]:STEPS"),
    ] {
        let refused = exact("missing.gltf", &format!("--sweep {sweep}"));
        let said = String::from_utf8_lossy(&refused.stderr);
        assert_eq!(refused.status.code(), Some(2), "{said}");
        assert!(said.starts_with("error: ") && said.contains(says), "{said}");
    }
}
