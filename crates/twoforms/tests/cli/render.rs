//! `render`: an EXR, a PNG beside it, and the same pixels again.

use std::fs;
use std::path::{Path, PathBuf};

use exr::image::read::read_all_flat_layers_from_file;
use exr::image::{AnyChannel, FlatImage, FlatSamples};
use exr::meta::attribute::{AttributeValue, Text};
use serde_json::Value;

use crate::support::{folder, has_all, names, program, scene, twoforms};

/// Renders the Cornell box to `name` in `folder` with these options.
fn rendered(folder: &Path, name: &str, options: &str) -> PathBuf {
    let path = folder.join(name);
    let run = twoforms(&format!("render @cornell-box --width 12 --spp 3 -o {} {options}", path.display()));
    assert_eq!((run.code, run.out.as_str()), (Some(0), ""), "{}", run.err);
    path
}

fn read(path: &Path) -> FlatImage {
    read_all_flat_layers_from_file(path).expect("an EXR file")
}

fn channels(image: &FlatImage) -> &[AnyChannel<FlatSamples>] {
    assert_eq!(image.layer_data.len(), 1, "one part");
    &image.layer_data[0].channel_data.list
}

fn attribute<'a>(image: &'a FlatImage, name: &str) -> Option<&'a AttributeValue> {
    image.layer_data[0].attributes.other.get(&Text::from(name))
}

#[test]
fn the_exr_holds_the_picture_its_layers_and_where_it_comes_from() {
    let folder = folder("render");
    let path = rendered(&folder, "box.exr", "--strategy hemisphere/toward-lights@power --height 10");
    assert_eq!(names(&folder), ["box.exr", "box.png"]);
    let image = read(&path);
    let size = image.layer_data[0].size;
    assert_eq!((size.0, size.1), (12, 10));
    let found: Vec<String> = channels(&image).iter().map(|channel| channel.name.to_string()).collect();
    let layer = "hemisphere/toward-lights@power";
    let layers = ["", "Albedo.", &format!("{layer}."), &format!("{layer}.Variance.")];
    let colours = layers.iter().flat_map(|layer| ["R", "G", "B"].map(|letter| format!("{layer}{letter}")));
    let vectors = ["P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z", "depth.Z"].map(String::from);
    for name in colours.chain(vectors) {
        assert!(found.contains(&name), "{name} is not among {found:?}");
    }
    assert!(channels(&image).iter().all(|channel| matches!(channel.sample_data, FlatSamples::F32(_))));
    assert_eq!(attribute(&image, "samplesPerPixel"), Some(&AttributeValue::I32(3)));
    assert!(matches!(attribute(&image, "renderTimeSeconds"), Some(AttributeValue::F32(seconds)) if *seconds > 0.0));
    let Some(AttributeValue::Text(provenance)) = attribute(&image, "twoforms:provenance") else { panic!("provenance") };
    let provenance: Value = serde_json::from_str(&provenance.to_string()).expect("JSON");
    assert_eq!([&provenance["seed"], &provenance["strategy"], &provenance["quantity"]], ["0", layer, "radiance"]);
    assert!(fs::read(folder.join("box.png")).expect("a file").starts_with(b"\x89PNG\r\n\x1a\n"));
}

#[test]
fn equal_seeds_give_equal_pixels_on_any_number_of_threads_and_other_seeds_others() {
    let folder = folder("same-pixels");
    let one = rendered(&folder, "one.exr", "-t 1");
    let two = rendered(&folder, "two.exr", "-t 2");
    let other = rendered(&folder, "other.exr", "--seed 1");
    assert_eq!(channels(&read(&one)), channels(&read(&two)));
    let png = |path: &Path| fs::read(path.with_extension("png")).expect("a file");
    assert_eq!(png(&one), png(&two));
    let [one, other] = [read(&one), read(&other)];
    let differ = channels(&one).iter().zip(channels(&other)).any(|(a, b)| a.sample_data != b.sample_data);
    assert!(differ);
}

/// A crop has the pixels that the whole image has there.
#[test]
fn a_crop_is_a_part_of_the_whole() {
    let folder = folder("crop");
    let whole = read(&rendered(&folder, "whole.exr", ""));
    let crop = read(&rendered(&folder, "crop.EXR", "--crop 0.25,0.75,0.5,1"));
    assert_eq!(crop.layer_data[0].size.0, 6);
    for (whole, crop) in channels(&whole).iter().zip(channels(&crop)) {
        let (whole, crop): (Vec<f32>, Vec<f32>) =
            (whole.sample_data.values_as_f32().collect(), crop.sample_data.values_as_f32().collect());
        let part: Vec<f32> = (6..12).flat_map(|row| whole[row * 12 + 3..row * 12 + 9].to_vec()).collect();
        assert_eq!(part, crop);
    }
}

#[test]
fn the_default_name_is_the_scenes_in_the_current_folder() {
    let folder = folder("default-name");
    let words = ["render", &scene("furnace"), "--width", "2", "--spp", "1", "--quiet", "--camera", "auto"];
    let output = program().args(words).current_dir(&folder).output().expect("the program starts");
    assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0));
    assert_eq!(names(&folder), ["furnace.exr", "furnace.png"]);
}

#[test]
fn what_was_done_is_told_and_so_is_a_black_picture() {
    let exr = folder("told").join("x.exr");
    let line = format!("render @cornell-box --width 2 --spp 1 -o {}", exr.display());
    let run = twoforms(&line);
    has_all(&run.err, &["x.exr and ", "x.png: ", " rays\n"]);
    let black = twoforms(&format!("{line} --view 9,9,9,10,10,10,40"));
    assert_eq!(black.code, Some(0));
    has_all(&black.err, &["the image is black", "inspect"]);
}
