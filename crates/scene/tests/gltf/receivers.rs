//! Receivers and cameras.

use crate::support::File;
use glam::DVec3;
use serde_json::{Value, json};
use twoforms_scene::Receiver;

fn only(node: Value) -> Receiver {
    let mut file = File::new();
    file.node(node);
    let mut receivers = file.scene().receivers;
    assert_eq!(receivers.len(), 1);
    receivers.remove(0)
}

fn refusal(extras: &Value) -> String {
    let mut file = File::new();
    file.node(json!({"name": "receiver-1", "extras": extras}));
    file.refusal()
}

#[test]
fn nodes_are_receivers_by_extras_or_by_name() {
    let mut file = File::new();
    for (name, extras) in [
        ("receiver", json!(null)),
        ("receivers of light", json!("any")),
        ("Receiver", json!({})),
        ("floor", json!({"receiver": true})),
        ("wall", json!({"receiver": false, "irradiance": "not looked at"})),
    ] {
        file.node(json!({"name": name, "extras": extras}));
    }
    let scene = file.scene();
    let names: Vec<_> = scene.receivers.iter().map(|receiver| receiver.name.as_str()).collect();
    assert_eq!(names, ["receiver", "receivers of light", "floor"]);
}

#[test]
fn a_receiver_that_is_named_like_a_light_is_no_lost_light() {
    let mut file = File::new();
    file.node(json!({"name": "below-the-lamp", "extras": {"receiver": true}}));
    let scene = file.scene();
    assert_eq!((scene.lost_lights, scene.receivers.len()), (Vec::<String>::new(), 1));
}

#[test]
fn position_is_the_origin_in_binary64_and_normal_the_y_axis_by_the_inverse_transpose() {
    let receiver = only(json!({"name": "receiver", "translation": [0.1, 0.2, 0.3]}));
    assert_eq!((receiver.position, receiver.normal), (DVec3::new(0.1, 0.2, 0.3), DVec3::Y));
    assert_eq!(receiver.known, None);
    let tilted = only(json!({"name": "receiver", "matrix": [1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}));
    assert_eq!(tilted.normal, DVec3::Y, "the plane of x and z is carried to itself");
    let slanted = only(json!({"name": "receiver", "matrix": [1, -1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}));
    assert_eq!(slanted.normal, DVec3::new(1.0, 1.0, 0.0).normalize());
    let mirrored = only(json!({"name": "receiver", "scale": [-1, 3, 1]}));
    assert_eq!(mirrored.normal, DVec3::Y);
    let below = only(json!({"name": "receiver", "scale": [1, -3, 1]}));
    assert_eq!(below.normal, -DVec3::Y);
}

#[test]
fn known_answers_are_read_to_the_last_bit() {
    let receiver = only(json!({"name": "x", "extras": {"receiver": true, "irradiance": [0.1, 3, 1e-300],
        "variance": {"area/uniform": [0.1 + 0.2, 0, 2]}, "derivation": "E = π L"}}));
    let known = receiver.known.expect("it is given");
    assert_eq!(known.irradiance, [0.1, 3.0, 1e-300]);
    assert_eq!(known.variance["area/uniform"], [0.1 + 0.2, 0.0, 2.0]);
    assert_eq!((known.variance.len(), known.derivation.as_str()), (1, "E = π L"));
}

#[test]
fn malformed_extras_are_refused_with_the_name_of_the_node() {
    for (extras, fault) in [
        (json!({"receiver": "yes"}), "neither true nor false"),
        (json!({"irradiance": [1, 2]}), r#""irradiance" that is not three numbers"#),
        (json!({"irradiance": [1, 2, "3"]}), r#""irradiance" that is not three numbers"#),
        (json!({"irradiance": [1, 2, -3]}), r#""irradiance" that is not three numbers"#),
        (json!({"irradiance": 1}), r#""irradiance" that is not three numbers"#),
        (json!({"variance": {"area/uniform": [1, 2, 3]}}), r#""variance" but no "irradiance""#),
        (json!({"irradiance": [1, 2, 3], "variance": [1]}), r#""variance" that does not give"#),
        (json!({"irradiance": [1, 2, 3], "variance": {"area/uniform": 1}}), r#""variance" that does not give"#),
        (json!({"irradiance": [1, 2, 3], "derivation": 7}), r#""derivation" that is no text"#),
    ] {
        let message = refusal(&extras);
        let expected = format!("test.gltf: node \"receiver-1\" has extras that have a {fault}");
        assert!(message.starts_with(&expected) || message.contains(fault), "{extras}: {message}");
        assert!(message.contains("receiver-1"), "{message}");
    }
}

#[test]
fn a_receiver_needs_a_normal_and_its_own_name() {
    let mut file = File::new();
    file.node(json!({"name": "receiver", "scale": [0, 1, 1]}));
    assert!(file.refusal().contains(r#"receiver "receiver" has a transform that leaves it no normal"#));
    file.json["nodes"][0]["scale"] = json!([1, 0, 1]);
    file.node(json!({"name": "receiver"}));
    let scene = file.scene();
    assert_eq!(scene.receivers[0].normal, DVec3::Y);
    assert_eq!(scene.warnings, [r#"several receivers have one name: "receiver""#]);
}

#[test]
fn cameras_look_along_minus_z_with_orthonormal_axes() {
    let mut file = File::new();
    file.push(
        "cameras",
        json!({"type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 1.5, "znear": 0.1}}),
    );
    file.push("cameras", json!({"type": "perspective", "name": "eye", "perspective": {"yfov": 0.5, "znear": 0.1}}));
    file.push(
        "cameras",
        json!({"type": "orthographic",
        "orthographic": {"xmag": 1, "ymag": 1, "zfar": 1, "znear": 0}}),
    );
    let half = std::f64::consts::FRAC_1_SQRT_2;
    file.node(json!({"name": "left", "camera": 0, "translation": [0.1, 2, 3], "rotation": [0, half, 0, half]}));
    file.node(json!({"camera": 1, "matrix": [2, 0, 0, 0, 0.5, 3, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1]}));
    file.node(json!({"name": "flat", "camera": 2}));
    let scene = file.scene();
    let [left, eye] = &scene.cameras[..] else { panic!("{:?}", scene.cameras) };
    assert_eq!((left.name.as_str(), left.position), ("left", DVec3::new(0.1, 2.0, 3.0)));
    assert_eq!([left.right, left.up, left.forward], [-DVec3::Z, DVec3::Y, -DVec3::X]);
    assert_eq!((left.yfov, left.aspect), (0.5, Some(1.5)));
    assert_eq!((eye.name.as_str(), eye.aspect), ("eye", None));
    assert_eq!(eye.forward, -DVec3::Z);
    let (right, up) = (eye.right, eye.up);
    assert!([right.length(), up.length()].iter().all(|length| (length - 1.0).abs() < 1e-15));
    assert_eq!(right.dot(up), 0.0);
    assert_eq!(scene.warnings, [r#"an orthographic camera is skipped: "flat""#]);
}

#[test]
fn cameras_that_see_nothing_are_refused() {
    let refusal = |perspective: Value, node: Value| {
        let mut file = File::new();
        file.push("cameras", json!({"type": "perspective", "perspective": perspective}));
        let mut node = node;
        node["camera"] = json!(0);
        file.node(node);
        file.refusal()
    };
    let node = json!({"name": "cam"});
    assert!(refusal(json!({"yfov": 3.2, "znear": 1}), node.clone()).contains(r#"camera "cam" has a yfov outside"#));
    assert!(refusal(json!({"yfov": 0, "znear": 1}), node.clone()).contains("has a yfov outside"));
    assert!(refusal(json!({"yfov": 1, "znear": 1, "aspectRatio": 0}), node).contains("has an aspectRatio"));
    let flat = json!({"name": "cam", "scale": [1, 1, 0]});
    assert!(refusal(json!({"yfov": 1, "znear": 1}), flat).contains("has a transform that flattens"));
}
