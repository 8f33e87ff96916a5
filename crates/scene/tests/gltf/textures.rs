//! What surfaces and lights are at a point, by textures and vertex colours.

use serde_json::{Value, json};
use twoforms_geometry::target::Shape;
use twoforms_scene::{Alpha, Emission, Scene};

use crate::pictures::png;
use crate::support::{BYTE, File, SQUARE, UNSIGNED_BYTE, UNSIGNED_SHORT};

/// Four texels: black and red above, green and blue below; alpha 0, 102, 153 and 255.
const TEXELS: [[u8; 4]; 4] = [[0, 0, 0, 0], [255, 0, 0, 102], [0, 255, 0, 153], [0, 0, 255, 255]];

/// A square called "thing" of this material, in which texture 0 has the four texels, nearest.
fn thing(material: Value) -> File {
    let mut file = File::new();
    let mesh = file.textured_square(material);
    file.node(json!({"name": "thing", "mesh": mesh}));
    let view = file.view(&png(2, 2, &TEXELS));
    file.json["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
    file.json["samplers"] = json!([{"magFilter": 9728}]);
    file.json["textures"] = json!([{"source": 0, "sampler": 0}]);
    file
}

/// A point in each quarter of the square: upper left, upper right, lower left, lower right. The first triangle is its
/// lower left half, with (u, v) = (b2, b1 + b2), the second the upper right half, with (u, v) = (b1 + b2, b1).
const QUARTERS: [(u32, [f64; 2]); 4] = [(1, [0.2, 0.1]), (1, [0.25, 0.5]), (0, [0.5, 0.25]), (0, [0.1, 0.7])];

fn pbr(pbr: &Value) -> Value {
    json!({"pbrMetallicRoughness": pbr})
}

#[test]
fn base_colour_is_factor_times_texture() {
    let factor = json!({"baseColorFactor": [0.5, 0.25, 1, 0.5], "metallicFactor": 0, "baseColorTexture": {"index": 0}});
    let scene = thing(pbr(&factor)).scene();
    let found = QUARTERS.map(|(triangle, b)| scene.appearance_at(triangle, b));
    for point in found {
        assert_eq!((point.alpha, point.metallic, point.roughness, point.emission), (1.0, 0.0, 1.0, [0.0; 3]));
        assert_eq!(point.albedo(), point.base_color);
    }
    assert_eq!(scene.albedo(0), [0.5, 0.25, 1.0], "the factor alone");
    assert!(!scene.is_uniform(0));
    let expected = [[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.25, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(found.map(|point| point.base_color), expected);
}

#[test]
fn alpha_is_what_its_mode_says() {
    let mut file = thing(pbr(&json!({"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 1, 1, 0.5]})));
    let mut alphas = |mode: Value| {
        for (key, value) in mode.as_object().expect("an object") {
            file.json["materials"][0][key] = value.clone();
        }
        let scene = file.scene();
        (scene.materials[0].alpha, QUARTERS.map(|(t, b)| scene.appearance_at(t, b).alpha))
    };
    assert_eq!(alphas(json!({})), (Alpha::Opaque, [1.0; 4]));
    assert_eq!(alphas(json!({"alphaMode": "BLEND"})), (Alpha::Blend, [0.0, 0.2, 0.3, 0.5]));
    assert_eq!(alphas(json!({"alphaMode": "MASK"})), (Alpha::Mask(0.5), [0.0, 0.0, 0.0, 1.0]));
    assert_eq!(alphas(json!({"alphaCutoff": 0.25})), (Alpha::Mask(0.25), [0.0, 0.0, 1.0, 1.0]));
}

/// Factor, texture and vertex colours, each alone: where one of them may leave less than the mode asks, light passes.
#[test]
fn light_passes_where_alpha_may_be_small() {
    let veiled = |factor: f64, least: u8, corner: f32, mode: Value| {
        let mut file = thing(pbr(&json!({"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 1, 1, factor]})));
        for (key, value) in mode.as_object().expect("an object") {
            file.json["materials"][0][key] = value.clone();
        }
        let view = file.view(&png(2, 1, &[[9, 9, 9, 255], [9, 9, 9, least]]));
        file.json["images"][0]["bufferView"] = json!(view);
        let colors = file.vectors(&[[1.0, 1.0, 1.0, corner], [1.0; 4], [1.0; 4], [1.0; 4]]);
        file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
        file.scene().veil().is_some()
    };
    for (factor, least, corner) in [(0.75, 255, 1.0), (1.0, 191, 1.0), (1.0, 255, 0.75)] {
        let with = |mode| veiled(factor, least, corner, mode);
        assert!(!with(json!({})));
        assert!(with(json!({"alphaMode": "BLEND"})));
        assert!(with(json!({"alphaMode": "MASK", "alphaCutoff": 0.8})));
        assert!(!with(json!({"alphaMode": "MASK", "alphaCutoff": 0.7})), "{factor} {least} {corner}");
    }
    assert!(!veiled(1.0, 255, 1.0, json!({"alphaMode": "BLEND"})));
}

/// Beyond the right edge by `wrapS`, beyond the lower one by `wrapT`.
#[test]
fn each_axis_has_its_wrapping() {
    let found = |wrap: &str, offset: [f64; 2]| {
        let moved = json!({"index": 0, "extensions": {"KHR_texture_transform": {"offset": offset}}});
        let mut file = thing(pbr(&json!({"metallicFactor": 0, "baseColorTexture": moved})));
        file.json["samplers"][0][wrap] = json!(33071);
        let scene = file.scene();
        QUARTERS.map(|(t, b)| scene.appearance_at(t, b).base_color)
    };
    let [black, red, green, blue] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(found("wrapS", [1.0, 0.0]), [red, red, blue, blue]);
    assert_eq!(found("wrapS", [0.0, 1.0]), [black, red, green, blue]);
    assert_eq!(found("wrapT", [0.0, 1.0]), [green, blue, green, blue]);
    assert_eq!(found("wrapT", [1.0, 0.0]), [black, red, green, blue]);
}

#[test]
fn metallic_is_blue_and_roughness_green_and_both_are_linear() {
    let factors = json!({"metallicFactor": 0.5, "roughnessFactor": 0.25, "metallicRoughnessTexture": {"index": 0}});
    let mut file = thing(pbr(&factors));
    let view = file.view(&png(1, 1, &[[9, 128, 51, 9]]));
    file.json["images"][0]["bufferView"] = json!(view);
    let found = file.scene().appearance_at(0, [0.3, 0.3]);
    assert_eq!([found.metallic, found.roughness], [0.5 * 0.2, 0.25 * (128.0 / 255.0)]);
    assert_eq!(found.albedo(), [1.0 - 0.1; 3]);
}

#[test]
fn sets_of_coordinates_may_have_any_form_and_be_moved() {
    let bytes: Vec<u8> = [[0, 0], [0, 255], [255, 255], [255, 0]].as_flattened().to_vec();
    let shorts: Vec<u8> = bytes.iter().flat_map(|&c| [c, c]).collect();
    let mut file = thing(pbr(&json!({"metallicFactor": 0, "baseColorTexture": {"index": 0, "texCoord": 1}})));
    let forms = [(UNSIGNED_BYTE, bytes), (UNSIGNED_SHORT, shorts)];
    let forms = forms.map(|(component, bytes)| {
        let accessor = file.accessor("VEC2", component, 4, &bytes);
        file.json["accessors"][accessor]["normalized"] = json!(true);
        accessor
    });
    for accessor in forms {
        file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = json!(accessor);
        let found = QUARTERS.map(|(t, b)| file.scene().appearance_at(t, b).base_color);
        assert_eq!(found, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    }
    let use_of = &mut file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    use_of["extensions"] = json!({"KHR_texture_transform": {"offset": [0.5, 0], "texCoord": 0}});
    let found = QUARTERS.map(|(t, b)| file.scene().appearance_at(t, b).base_color);
    assert_eq!(found, [[1.0, 0.0, 0.0], [0.0; 3], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]], "half a texture farther right");
}

#[test]
fn vertex_colours_multiply_and_white_ones_cost_nothing() {
    let mut file = thing(pbr(&json!({"metallicFactor": 0, "baseColorFactor": [0.5, 1, 1, 1]})));
    file.json["materials"][0]["alphaMode"] = json!("BLEND");
    let colors: [[f32; 4]; 4] = [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.5], [0.0, 0.0, 1.0, 0.0], [1.0; 4]];
    let accessor = file.vectors(&colors);
    file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(accessor);
    let scene = file.scene();
    let found = scene.appearance_at(0, [0.5, 0.25]);
    assert_eq!((found.base_color, found.alpha), ([0.125, 0.5, 0.25], 0.5));
    assert!(scene.warnings.contains(&r#"vertex colours are ignored: "thing""#.to_string()));
    let three = file.accessor("VEC3", UNSIGNED_BYTE, 4, &[0, 51, 255, 0, 51, 255, 0, 51, 255, 0, 51, 255]);
    file.json["accessors"][three]["normalized"] = json!(true);
    file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(three);
    let found = file.scene().appearance_at(1, [0.1, 0.7]);
    assert_eq!((found.base_color, found.alpha), ([0.0, 0.2, 1.0], 1.0));
    let white = file.vectors(&[[1.0_f32; 3]; 4]);
    file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(white);
    assert!(file.scene().is_uniform(0));
}

#[test]
fn attributes_that_are_wrong_are_warned_of_on_walls_and_refused_on_lights() {
    let mut file = thing(pbr(&json!({"metallicFactor": 0, "baseColorTexture": {"index": 0, "texCoord": 1}})));
    let mut warning = |name: &str, accessor: usize| {
        file.json["meshes"][0]["primitives"][0]["attributes"][name] = json!(accessor);
        file.scene().warnings.into_iter().find(|line| line.contains("cannot be used")).expect("a warning")
    };
    assert!(warning("NOTHING", 0).contains(
        "texture coordinates cannot be used, factors alone count (meshes[0].primitives[0] has no TEXCOORD_1"
    ));
    assert!(warning("TEXCOORD_1", 0).contains("accessors[0] is not a VEC2"));
    let bright = file.vectors(&[[2.0_f32; 3]; 4]);
    let short = file.vectors(&[[0.5_f32; 2]; 3]);
    let signed = file.accessor("VEC2", BYTE, 4, &[0; 8]);
    let mut warnings = |name: &str, accessor: usize| {
        file.json["meshes"][0]["primitives"][0]["attributes"][name] = json!(accessor);
        file.scene().warnings.join("\n")
    };
    assert!(warnings("TEXCOORD_1", short).contains("has 3 elements for 4 positions"));
    assert!(warnings("TEXCOORD_1", signed).contains("normalized unsigned integers of 8 or 16 bits"));
    assert!(warnings("COLOR_0", bright).contains("vertex colours cannot be used (accessors["));
    let mut lamp = lamp([1.0; 3]);
    lamp.json["materials"][0]["emissiveTexture"]["texCoord"] = json!(4);
    assert!(lamp.refusal().contains("meshes[0].primitives[0] has no TEXCOORD_4, which a texture of its material asks"));
}

/// A square that emits by the four texels.
fn lamp(factor: [f64; 3]) -> File {
    thing(json!({"name": "neon", "emissiveFactor": factor, "emissiveTexture": {"index": 0}}))
}

fn close(found: [f64; 3], expected: [f64; 3]) {
    let near = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-6);
    assert!(near, "{found:?} for {expected:?}");
}

#[test]
fn a_textured_light_knows_its_radiance_and_its_power() {
    let mut file = lamp([1.0, 0.5, 0.25]);
    file.json["materials"][0]["extensions"] = json!({"KHR_materials_emissive_strength": {"emissiveStrength": 8}});
    let scene = file.scene();
    assert!(matches!(scene.targets[0].shape, Shape::Parallelogram { .. }), "uv is affine");
    let emission = scene.target_emission(0);
    assert!(matches!(emission, Emission::Textured(_)));
    close(emission.mean(), [2.0, 1.0, 0.5]);
    assert_eq!((scene.lights[0].is_textured(), scene.lights[0].radiance), (true, [2.0, 1.0, 0.5]));
    close(scene.lights[0].power(), [2.0, 1.0, 0.5].map(|mean| std::f64::consts::PI * mean));
    let corners = scene.targets[0].corners(&scene.mesh);
    let corners = corners.as_slice();
    for (s, t) in [(0.1, 0.2), (0.3, 0.9), (0.8, 0.1), (0.6, 0.7)] {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| corners[i].as_dvec3());
        let y = a + s * (b - a) + t * (d - a) + s * t * (a - b + c - d);
        let (right, down) = (y.x > 0.5, y.z > 0.5);
        let expected = match (right, down) {
            (false, false) => [0.0; 3],
            (true, false) => [8.0, 0.0, 0.0],
            (false, true) => [0.0, 4.0, 0.0],
            (true, true) => [0.0, 0.0, 2.0],
        };
        assert_eq!([emission.at([s, t]), emission.at_point(y)], [expected; 2], "{s}, {t}");
    }
}

#[test]
fn constant_lights_stay_so() {
    let mut file = lamp([1.0; 3]);
    file.json["materials"][0].as_object_mut().expect("an object").remove("emissiveTexture");
    let scene = file.scene();
    assert_eq!(scene.target_emission(0), Emission::Constant([1.0; 3]));
    assert!(scene.is_uniform(0) && !scene.lights[0].is_textured() && scene.textures.is_empty());
}

#[test]
fn triangles_that_disagree_about_the_texture_stay_apart() {
    let mut file = lamp([1.0; 3]);
    let bent = file.vectors(&[[0.0_f32, 0.0], [0.0, 1.0], [1.0, 1.0], [0.9, 0.0]]);
    file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(bent);
    let scene = file.scene();
    assert_eq!(scene.targets.iter().map(|target| target.shape).collect::<Vec<_>>(), [0, 1].map(Shape::Triangle));
    for (k, triangle) in [(0, scene.mesh.triangle(0)), (1, scene.mesh.triangle(1))] {
        let [a, b, c] = triangle.vertices();
        let emission = scene.target_emission(k);
        for [s, t] in [[0.3, 0.6], [0.9, 0.2], [0.7, 0.9]] {
            let y = a + s * (b - a) + s * t * (c - b);
            let found = scene.appearance_at(k, [s * (1.0 - t), s * t]).emission;
            assert_eq!([emission.at([s, t]), emission.at_point(y)], [found; 2]);
        }
    }
    let [a, b, c, d] = SQUARE;
    let positions = file.vectors(&[a, b, c, a, c, d]);
    let seam = file.vectors(&[[0.0_f32, 0.0], [0.0, 1.0], [1.0, 1.0], [0.5, 0.0], [1.5, 1.0], [1.5, 0.0]]);
    let indices = file.indices(&[0, 1, 2, 3, 4, 5]);
    file.json["meshes"][0]["primitives"][0]["attributes"] = json!({"POSITION": positions, "TEXCOORD_0": seam});
    file.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    assert_eq!(file.scene().targets.len(), 2, "a seam along the diagonal");
}

#[test]
fn black_pieces_of_a_textured_light_are_dropped() {
    let mut file = lamp([1.0; 3]);
    let dark = [[0.05_f32, 0.05], [0.05, 0.4], [0.4, 0.4], [0.9, 0.9]];
    let dark = file.vectors(&dark);
    file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(dark);
    let scene = file.scene();
    let warning = |scene: &Scene, text: &str| scene.warnings.iter().any(|line| line.contains(text));
    assert_eq!(scene.targets.iter().map(|target| target.shape).collect::<Vec<_>>(), [Shape::Triangle(1)]);
    assert!(
        warning(&scene, r#"on which the texture is black are dropped as emitters: "thing""#),
        "{:?}",
        scene.warnings
    );
    let black = file.view(&png(1, 1, &[[0, 0, 0, 255]]));
    file.json["images"][0]["bufferView"] = json!(black);
    let scene = file.scene();
    assert!(scene.lights.is_empty() && scene.surfaces[0].light.is_none());
    assert!(warning(&scene, r#"on which the texture is black are dropped as emitters: 2 ("thing")"#));
}

#[test]
fn a_mirrored_light_shows_the_same_texture() {
    let mut file = lamp([1.0; 3]);
    let plain = file.scene();
    file.json["nodes"][0]["scale"] = json!([-1, 1, 1]);
    let mirrored = file.scene();
    for x in [0.2, 0.8] {
        for z in [0.3, 0.6] {
            let at = |scene: &Scene, x| scene.target_emission(0).at_point(glam::DVec3::new(x, 0.0, z));
            assert_eq!(at(&plain, x), at(&mirrored, -x));
        }
    }
}

/// Patterns in binary64, by the grid and over parts of a target, say what emission says point by point.
#[test]
fn a_pattern_is_bilinear_between_the_lines_of_its_grid() {
    let scene = lamp([1.0, 2.0, 4.0]).scene();
    let emission = scene.target_emission(0);
    let Emission::Textured(pattern) = &emission else { panic!("it is textured") };
    let [a, b, d] = pattern.corners_in_grid();
    let corners = scene.targets[0].corners(&scene.mesh);
    let [corner, next, .., last] = corners.as_slice() else { panic!("a parallelogram") };
    let [corner, next, last] = [corner, next, last].map(|v| v.as_dvec3());
    for [s, t] in [[0.1, 0.2], [0.7, 0.3], [0.4, 0.9], [0.8, 0.85]] {
        let y = corner + s * (next - corner) + t * (last - corner);
        let [found_s, found_t] = pattern.coordinates(y);
        assert!((found_s - s).abs() + (found_t - t).abs() < 1e-6, "{found_s}, {found_t}");
        let by_grid = pattern.at_grid(a + s * (b - a) + t * (d - a));
        let by_point = emission.at_point(y);
        assert!((0..3).all(|c| (by_grid[c] - f64::from(by_point[c])).abs() < 1e-6), "{by_grid:?} {by_point:?}");
    }
    let halves =
        [[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]].map(|h| pattern.mean_over(h));
    for c in 0..3 {
        assert!((0.5 * (halves[0][c] + halves[1][c]) - emission.mean()[c]).abs() < 1e-12);
    }
}
