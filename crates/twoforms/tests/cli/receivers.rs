//! Which places are measured.

use serde_json::{Value, json};

use crate::support::{changed_box, folder, has_all, run, scene, twoforms, without_camera, without_receivers, written};

const SMALL: [&str; 7] = ["--samples", "1", "--replicates", "2", "--quiet", "--format", "json"];

/// The names of the receivers in a comparison of the scene at `path`.
fn measured(path: &str, words: &[&str]) -> Vec<String> {
    let document = run(["compare", path].iter().chain(words).chain(&SMALL)).json();
    let receivers = document["receivers"].as_array().expect("receivers").iter();
    receivers.map(|receiver| receiver["name"].as_str().expect("a name").to_owned()).collect()
}

#[test]
fn without_any_the_scenes_own_then_a_grid_through_its_camera_then_an_error() {
    let folder = folder("default-receivers");
    assert_eq!(measured(&scene("square-light"), &[]).len(), 9);

    let unnamed = changed_box(&folder, "unnamed.gltf", without_receivers);
    let grid = measured(&unnamed, &[]);
    assert_eq!((grid.len(), grid[0].as_str()), (64, "pixel 32,32"));

    let neither = changed_box(&folder, "neither.gltf", |gltf| {
        without_receivers(gltf);
        without_camera(gltf);
    });
    run(["compare", &neither]).fails(&[
        "neither receivers nor a camera",
        "--at X,Y,Z,NX,NY,NZ",
        "--camera auto",
        "--view",
    ]);
    assert!(!measured(&neither, &["--camera", "auto"]).is_empty());
}

#[test]
fn all_ways_to_name_a_place_can_be_mixed() {
    let points = "\u{feff}# mine\nx,y,z,nx,ny,nz\r\n0.1,0,0.2,0,1,0\r\n\n-0.1,0,.3,0,-2,0\n";
    let points = format!("@{}", written(&folder("mixed-receivers"), "points.csv", points));
    let words = [
        "--at=-0.2,0,0.1,0,-1e-3,0",
        "--at",
        &points,
        "--receiver",
        "floor-lit",
        "--pixel",
        "256,256",
        "--grid",
        "2,2",
        "--height",
        "512",
    ];
    let names = measured(&scene("cornell-box"), &words);
    assert_eq!(names[..5], ["point -0.2,0,0.1", "point 0.1,0,0.2", "point -0.1,0,0.3", "floor-lit", "pixel 256,256"]);
    assert_eq!(names[5..], ["pixel 128,128", "pixel 384,128", "pixel 128,384", "pixel 384,384"]);
}

#[test]
fn a_normal_of_any_length_and_place_of_any_sign_will_do() {
    let line = "compare @cornell-box --at -0.25,0,-3e-1,0,-7,0 --samples 1 --replicates 2 --format json";
    let document = twoforms(line).json();
    assert_eq!(document["receivers"][0]["position"], json!([-0.25, 0.0, -0.3]));
    assert_eq!(document["receivers"][0]["normal"], json!([0.0, -1.0, 0.0]));
}

/// A mirrored node keeps its place and its +Y; one that is stretched turns its normal by the inverse transpose.
#[test]
fn the_normal_of_a_receiver_is_carried_by_the_inverse_transpose() {
    let path = changed_box(&folder("mirrored"), "mirrored.gltf", |gltf| {
        let half = 0.5_f64.sqrt();
        for node in [
            json!({"name": "receiver x", "scale": [-1, 1, 1]}),
            json!({"name": "receiver y", "scale": [1, -1, 1]}),
            json!({"name": "receiver turned", "rotation": [half, 0, 0, half], "scale": [3, 5, 7]}),
        ] {
            let nodes = gltf["nodes"].as_array_mut().expect("nodes");
            nodes.push(node);
            let index = nodes.len() - 1;
            gltf["scenes"][0]["nodes"].as_array_mut().expect("roots").push(json!(index));
        }
    });
    let words = ["--receiver", "receiver x", "--receiver", "receiver y", "--receiver", "receiver turned"];
    let document = run(["compare", &path].iter().chain(&words).chain(&SMALL)).json();
    let normals: Vec<[f64; 3]> = document["receivers"].as_array().expect("receivers").iter().map(normal).collect();
    let close = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-7);
    let wanted = [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]];
    assert!(normals.iter().zip(wanted).all(|(n, wanted)| close(*n, wanted)), "{normals:?}");
}

fn normal(receiver: &Value) -> [f64; 3] {
    let component = |c: usize| receiver["normal"][c].as_f64().expect("a number");
    [component(0), component(1), component(2)]
}

/// Radiance at a Lambertian surface of albedo ρ is ρ/π of the irradiance, sample by sample; the floor's albedo is 0.73.
#[test]
fn radiance_is_irradiance_times_albedo_over_pi() {
    let line = "compare @cornell-box --receiver floor-lit --strategy area/uniform --samples 64 --replicates 10 \
                --format json --quantity";
    let mean = |quantity: &str| {
        let document = twoforms(&format!("{line} {quantity}")).json();
        assert_eq!(document["provenance"]["quantity"], quantity);
        document["receivers"][0]["rows"][0]["mean"]["luminance"].as_f64().expect("a number")
    };
    let ratio = mean("radiance") / mean("irradiance");
    assert!((ratio * std::f64::consts::PI - 0.73).abs() < 1e-6, "{ratio}");
}

#[test]
fn grid_points_that_see_nothing_are_counted() {
    let run = twoforms("compare @cornell-box --camera auto --grid 3,3 --samples 1 --replicates 2");
    has_all(&run.out, &["3 receivers"]);
    assert_eq!(run.err, "note: 6 of 9 grid points see nothing and are left out\n");
}

/// What takes receivers, quickly.
const ASKING: [&str; 2] = ["exact", "compare --samples 1 --replicates 2 --strategies area/uniform,hemisphere/cosine"];

#[test]
fn a_receiver_on_a_light_is_refused_unless_it_looks_out() {
    for command in ASKING {
        for normal in ["0,1,0", "0.1,-1,0", "0.1,1,0", "1,0,0"] {
            let says = ["point 0.1,2,0", "lies on the light \"light\"", "more than 4.8e-7 m", "along [0, -1, 0]"];
            twoforms(&format!("{command} @square-light --at 0.1,2,0,{normal}")).fails(&says);
        }
        twoforms(&format!("{command} @square-light --at 0.5,2,0.1,-1,0,0")).fails(&["lies on the light"]);
    }
}

/// Looking out from a light that shines downward; in its plane but beside it; and next to it, facing it.
#[test]
fn what_a_light_gives_in_its_own_plane() {
    let number = |value: &Value| value.as_f64().expect("a number");
    for (at, expected) in
        [("0.1,2,0,0,-1,0", 0.0), ("0.7,2,0,-1,0,0", 0.0), ("0.1,1.999999,0,0,1,0", std::f64::consts::PI)]
    {
        let exact = twoforms(&format!("exact @square-light --at {at} --format json")).json();
        let exact = number(&exact["receivers"][0]["irradiance"]["luminance"]);
        assert!((exact - expected).abs() < 1e-9, "{at}: {exact}");
        let line = "--samples 1 --replicates 2 --strategies hemisphere/cosine --format json";
        let compared = twoforms(&format!("compare @square-light --at {at} {line}")).json();
        let compared = &compared["receivers"][0];
        assert_eq!(number(&compared["exact"]["irradiance"]["luminance"]), exact);
        assert!((number(&compared["rows"][0]["mean"]["luminance"]) - expected).abs() < 1e-5, "{at}");
    }
}

/// The back of a lamp is dark, and a pixel lies on the side from which it is seen.
#[test]
fn pixels_on_the_back_of_a_light_are_no_receivers_on_it() {
    for command in ASKING {
        let line = format!("{command} @square-light --view 0.1,3,0.1,0,2,0,40 --pixel 32,32 --width 64 --height 64");
        let document = twoforms(&format!("{line} --format json")).json();
        let receiver = &document["receivers"][0];
        assert!((receiver["position"][1].as_f64().expect("a height") - 2.0).abs() < 1e-6, "the pixel sees the light");
        assert!(receiver["why"].is_null(), "{receiver}");
    }
}

#[test]
fn a_sweep_has_no_value_where_it_meets_a_light() {
    for sweep in ["receiver.y=0:1:3", "light.y=0:-1:3"] {
        let line = "exact @square-light --at 0.1,1.5,0,0,1,0 --strategies area/uniform --format json";
        let document = twoforms(&format!("{line} --sweep {sweep}")).json();
        let steps = &document["receivers"][0]["sweep"]["steps"];
        assert!(steps[0]["irradiance"]["luminance"].as_f64().is_some_and(|e| e > 1.0), "{sweep}");
        assert!(steps[1]["irradiance"].is_null(), "{sweep}");
        assert!(steps[1]["why"]["irradiance"].as_str().is_some_and(|why| why.contains("lies on target 0")), "{sweep}");
        assert_eq!(steps[2]["irradiance"]["luminance"], 0.0, "{sweep}");
    }
}
