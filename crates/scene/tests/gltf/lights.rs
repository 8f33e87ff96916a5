//! Lights: what emits, from which pieces and how much.

use std::f64::consts::PI;

use crate::support::{File, SQUARE};
use serde_json::{Value, json};
use twoforms_geometry::target::{Shape, Sides};
use twoforms_scene::Scene;

fn lit(positions: &[[f32; 3]], indices: &[u16]) -> Scene {
    let mut file = File::new();
    let material = file.emitter([1.0, 0.5, 0.25]);
    let mesh = file.triangles(positions, indices, Some(material));
    file.node(json!({"name": "lamp", "mesh": mesh}));
    file.scene()
}

fn shapes(scene: &Scene) -> Vec<Shape> {
    scene.targets.iter().map(|target| target.shape).collect()
}

#[test]
fn radiance_is_factor_times_strength_in_binary32() {
    let mut file = File::new();
    let material = file.emitter([0.1, 0.2, 0.0]);
    file.json["materials"][0]["extensions"] = json!({"KHR_materials_emissive_strength": {"emissiveStrength": 12.5}});
    let mesh = file.square(Some(material));
    file.node(json!({"name": "lamp", "mesh": mesh, "scale": [2, 1, 3]}));
    let scene = file.scene();
    let radiance = [0.1_f32 * 12.5, 0.2_f32 * 12.5, 0.0];
    assert_eq!((scene.lights[0].radiance, scene.target_radiance(0)), (radiance, radiance));
    assert_eq!((scene.lights[0].area, scene.lights[0].sides), (6.0, Sides::Front));
    assert_eq!(scene.lights[0].power(), radiance.map(|channel| PI * 6.0 * f64::from(channel)));
    file.json["materials"][0]["doubleSided"] = json!(true);
    let both = file.scene();
    assert_eq!(both.targets[0].sides, Sides::Both);
    assert_eq!(both.lights[0].power(), scene.lights[0].power().map(|power| 2.0 * power));
    assert_eq!(scene.surfaces[0].light, Some(0));
    assert!(scene.require_emitters().is_ok());
}

#[test]
fn every_instance_of_an_emitting_primitive_is_a_light() {
    let mut file = File::new();
    let (red, dark) = (file.emitter([1.0, 0.0, 0.0]), file.emitter([0.0, 0.0, 0.0]));
    let (red, dark) = (file.square(Some(red)), file.square(Some(dark)));
    file.node(json!({"name": "dark", "mesh": dark, "translation": [0, -1, 0]}));
    file.node(json!({"name": "one", "mesh": red}));
    file.node(json!({"name": "two", "mesh": red, "translation": [0, 1, 0]}));
    let scene = file.scene();
    assert_eq!(
        scene.lights.iter().map(|l| (l.name.as_str(), l.targets.clone())).collect::<Vec<_>>(),
        [("one", 0..1), ("two", 1..2)]
    );
    assert_eq!([0, 1].map(|target| scene.light_of(target)), [0, 1]);
    assert_eq!(scene.surfaces.iter().map(|s| s.light).collect::<Vec<_>>(), [None, Some(0), Some(1)]);
}

#[test]
fn a_square_is_one_target_wherever_its_diagonal_and_its_indices_begin() {
    for indices in [[0, 1, 2, 0, 2, 3], [1, 2, 0, 3, 0, 2], [1, 2, 3, 3, 0, 1], [2, 0, 1, 2, 3, 0]] {
        let scene = lit(&SQUARE, &indices);
        let [Shape::Parallelogram { triangles: [0, 1], corners }] = shapes(&scene)[..] else {
            panic!("{indices:?} gives {:?}", scene.targets);
        };
        let start = corners[0];
        assert_eq!(corners, [0, 1, 2, 3].map(|step| (start + step) % 4), "corners go around");
        let first = scene.mesh.triangles[0];
        assert!([corners[0], corners[1], corners[2]].iter().all(|corner| first.contains(corner)));
        assert!((scene.lights[0].area - 1.0).abs() < 1e-15);
    }
}

#[test]
fn triangles_pair_across_vertices_that_are_not_shared() {
    let [a, b, c, d] = SQUARE;
    let scene = lit(&[a, b, c, a, c, d], &[0, 1, 2, 3, 4, 5]);
    assert_eq!(shapes(&scene), [Shape::Parallelogram { triangles: [0, 1], corners: [0, 1, 2, 5] }]);
}

#[test]
fn only_parallelograms_pair() {
    let [a, b, c, d] = SQUARE;
    let single = [Shape::Triangle(0), Shape::Triangle(1)];
    let moved = |d: [f32; 3]| shapes(&lit(&[a, b, c, d], &[0, 1, 2, 0, 2, 3]));
    assert_eq!(moved([1.0, 0.0, -0.01]), single, "no parallelogram");
    assert_eq!(moved([1.0, 0.01, 0.0]), single, "not in a plane");
    assert_eq!(moved([1.0, 1e-7, 0.0]).len(), 1, "within the rounding of its vertices");
    assert_eq!(shapes(&lit(&[a, b, c, d], &[0, 1, 2, 0, 3, 2])), single, "fronts differ");
    let far = [a, b, c, d].map(|[x, y, z]| [x * 1e-3 + 1.0, y, z * 1e-3]);
    let bent = [far[0], far[1], far[2], [far[3][0] + 1e-6, 0.0, far[3][2]]];
    assert_eq!(shapes(&lit(&bent, &[0, 1, 2, 0, 2, 3])), single, "a small light is measured by its own size");
}

#[test]
fn a_triangle_joins_one_pair_in_scene_order() {
    let strip = [[0., 0., 0.], [0., 0., 1.], [1., 0., 0.], [1., 0., 1.], [2., 0., 0.]];
    let scene = lit(&strip, &[0, 1, 2, 2, 1, 3, 2, 3, 4]);
    let pairs: Vec<_> = scene.targets.iter().map(|target| target.triangles().collect::<Vec<_>>()).collect();
    assert_eq!(pairs, [vec![0, 1], vec![2]]);
    let apart = lit(&strip, &[2, 1, 3, 2, 3, 4, 0, 1, 2]);
    let pairs: Vec<_> = apart.targets.iter().map(|target| target.triangles().collect::<Vec<_>>()).collect();
    assert_eq!(pairs, [vec![0, 1], vec![2]]);
}

#[test]
fn triangles_of_two_lights_do_not_pair() {
    let mut file = File::new();
    let material = file.emitter([1.0; 3]);
    let meshes = [[0, 1, 2], [0, 2, 3]].map(|indices| file.triangles(&SQUARE, &indices, Some(material)));
    for mesh in meshes {
        file.node(json!({"mesh": mesh}));
    }
    assert_eq!(shapes(&file.scene()), [Shape::Triangle(0), Shape::Triangle(1)]);
}

#[test]
fn of_coincident_emitters_the_later_is_dropped() {
    let mut file = File::new();
    let (red, blue) = (file.emitter([1.0, 0.0, 0.0]), file.emitter([0.0, 0.0, 1.0]));
    let (red, blue) = (file.square(Some(red)), file.triangles(&SQUARE, &[2, 1, 0, 3, 1, 2], Some(blue)));
    file.node(json!({"name": "red", "mesh": red}));
    file.node(json!({"name": "blue", "mesh": blue}));
    let scene = file.scene();
    assert_eq!((scene.mesh.len(), scene.targets.len(), scene.lights.len()), (4, 2, 2));
    assert_eq!(scene.targets[1].shape, Shape::Triangle(3));
    assert_eq!(
        scene.warnings,
        [r#"emitting triangles that coincide with an earlier emitter are dropped as emitters: "blue""#]
    );
    file.json["nodes"][1]["mesh"] = json!(red);
    let twin = file.scene();
    assert_eq!((twin.lights.len(), twin.surfaces[1].light), (1, None));
    assert!(
        twin.warnings.iter().any(|line| line.contains(r#"dropped as emitters: 2 ("blue")"#)),
        "{:?}",
        twin.warnings
    );
}

#[test]
fn emitting_triangles_without_area_are_dropped_and_counted() {
    let scene = lit(&SQUARE, &[0, 1, 1, 0, 1, 2, 2, 2, 2]);
    assert_eq!(shapes(&scene), [Shape::Triangle(1)]);
    assert_eq!(scene.mesh.len(), 3);
    assert_eq!(scene.warnings, [r#"emitting triangles without area are dropped as emitters: 2 ("lamp")"#]);
}

#[test]
fn albedo_is_base_colour_without_the_metallic_share() {
    let mut file = File::new();
    let half = json!({"baseColorFactor": [0.5, 0.25, 1.0, 0.5], "metallicFactor": 0.5});
    let half = file.push("materials", json!({"name": "half", "pbrMetallicRoughness": half}));
    let unlit = json!({"name": "sky", "emissiveFactor": [1, 1, 1], "extensions": {"KHR_materials_unlit": {}}});
    let unlit = file.push("materials", unlit);
    let meshes = [Some(half), Some(unlit), None].map(|material| file.square(material));
    for mesh in meshes {
        file.node(json!({"mesh": mesh}));
    }
    let scene = file.scene();
    assert_eq!([0, 2, 4].map(|t| scene.albedo(t)), [[0.25, 0.125, 0.5], [0.0; 3], [0.0; 3]]);
    assert!(scene.lights.is_empty(), "an unlit material is no light");
    assert_eq!(scene.warnings, [r#"an unlit material is black and emits nothing: "sky""#]);
}

/// A dielectric has a highlight unless it is as rough as can be and says no more, or says that it has none.
#[test]
fn highlights_are_what_the_file_says_or_what_it_means() {
    let dielectric = |roughness: f32| json!({"metallicFactor": 0, "roughnessFactor": roughness});
    let specular = |value: Value| json!({"KHR_materials_specular": value});
    let cases = [
        (dielectric(1.0), json!({}), false, [0.04; 3]),
        (json!({"metallicFactor": 0}), json!({}), false, [0.04; 3]),
        (dielectric(0.5), json!({}), true, [0.04; 3]),
        (json!({}), json!({}), true, [0.04; 3]),
        (dielectric(1.0), specular(json!({})), true, [0.04; 3]),
        (dielectric(0.5), specular(json!({"specularFactor": 0})), false, [0.04; 3]),
        (dielectric(0.5), specular(json!({"specularColorFactor": [2, 0.5, 50]})), true, [0.08, 0.02, 1.0]),
    ];
    for (pbr, extensions, glossy, f_0) in cases {
        let mut file = File::new();
        let material = json!({"pbrMetallicRoughness": pbr, "extensions": extensions});
        let material = file.push("materials", material);
        let mesh = file.square(Some(material));
        file.node(json!({"mesh": mesh}));
        let scene = file.scene();
        let found = scene.appearance_at(0, [0.25, 0.25]);
        assert_eq!((found.is_glossy(), found.f_0), (glossy, f_0), "{pbr} {extensions}");
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    }
}

/// A mirror's f_r is no function, so it is taken a little rough, which is said.
#[test]
fn a_mirror_is_warned_of() {
    let mut file = File::new();
    let mirror = json!({"name": "mirror", "pbrMetallicRoughness": {"roughnessFactor": 0}});
    let mirror = file.push("materials", mirror);
    let mesh = file.square(Some(mirror));
    file.node(json!({"mesh": mesh}));
    assert_eq!(file.scene().warnings, [r#"a mirror has no f_r and is taken as rough as 1/32: "mirror""#]);
}

#[test]
fn what_is_not_read_is_said_once() {
    let mut file = File::new();
    file.json["textures"] = json!([{}]);
    let texture = json!({"index": 0});
    for name in ["a", "b"] {
        let pbr = json!({"metallicFactor": 0});
        let material =
            json!({"name": name, "alphaMode": "MASK", "normalTexture": texture, "pbrMetallicRoughness": pbr});
        let material = file.push("materials", material);
        let mesh = file.square(Some(material));
        file.node(json!({"name": name, "mesh": mesh}));
    }
    file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(0);
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{"POSITION": 0}]);
    file.json["animations"] = json!([{"channels": [], "samplers": []}]);
    file.json["skins"] = json!([{"joints": [0]}]);
    file.json["nodes"][1]["skin"] = json!(0);
    file.json["extensionsUsed"] =
        json!(["KHR_materials_sheen", "KHR_materials_volume", "ACME_dust", "KHR_texture_basisu"]);
    file.square(None);
    assert_eq!(
        file.scene().warnings,
        [
            r#"an extension is ignored, surfaces reflect by metal and roughness alone: "KHR_materials_sheen""#,
            r#"an extension is ignored, surfaces are opaque: "KHR_materials_volume""#,
            r#"an extension is ignored, it is not known here: "ACME_dust""#,
            r#"an extension is ignored, images other than PNG and JPEG are not read: "KHR_texture_basisu""#,
            "animations are ignored: nodes stand in their rest pose",
            r#"a mesh stands nowhere in the scene and is left out: "meshes[2]""#,
            r#"vertex colours are ignored: "a""#,
            r#"morph targets are ignored: "a""#,
            r#"a skinned mesh stands in its bind pose: "b""#,
            r#"normal textures are ignored, surfaces are flat: 2 ("a", "b")"#,
        ]
    );
}

#[test]
fn a_scene_without_emitters_loads_and_says_what_became_of_its_lights() {
    let mut file = File::new();
    let message = |file: &File| file.scene().require_emitters().expect_err("nothing emits").to_string();
    assert_eq!(
        message(&file),
        "test.gltf: no triangle emits light; give a mesh, such as a plane, a material with emissiveFactor above zero"
    );
    file.node(json!({"name": "Area"}));
    file.node(json!({"name": "Ground"}));
    assert!(message(&file).contains(r#"the node "Area" is empty and named like a light: did you export Blender area"#));
    file.node(json!({"name": "Area.001"}));
    assert!(message(&file).contains(r#"2 nodes are empty and named like lights ("Area", …)"#));
    file.json["extensionsRequired"] = json!(["KHR_lights_punctual"]);
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "point"}]}});
    file.node(json!({"name": "Lamp", "extensions": {"KHR_lights_punctual": {"light": 0}}}));
    assert!(message(&file).contains("its punctual light has no area"));
    let scene = file.scene();
    assert_eq!((scene.lost_lights, scene.punctual_lights), (vec!["Area".into(), "Area.001".into()], 1));
    assert_eq!(
        scene.warnings,
        [
            r#"a punctual light has no area and is ignored: "Lamp""#,
            r#"an empty node is named like a light and gives none: 2 ("Area", "Area.001")"#,
        ]
    );
}
