//! EXR and PNG, written and read back.

use std::fs;

use crate::support::{folder, image};
use exr::prelude::*;
use twoforms_report::exr::write_exr;
use twoforms_report::png::write_png;
use twoforms_report::{Channel, ReportError};

#[test]
fn an_exr_reads_back_to_the_same_bits() {
    let (path, image) = (folder("exr").join("a.exr"), image());
    write_exr(&path, &image).unwrap();
    let file = read().no_deep_data().largest_resolution_level().all_channels().all_layers().all_attributes();
    let read = file.from_file(&path).unwrap();
    assert_eq!(read.layer_data.len(), 1);
    let layer = &read.layer_data[0];
    assert_eq!(layer.size, Vec2(5, 3));
    assert_eq!(layer.channel_data.list.len(), image.channels.len());
    for channel in &layer.channel_data.list {
        let FlatSamples::F32(samples) = &channel.sample_data else { panic!("{} is not binary32", channel.name) };
        let bits = |samples: &[f32]| samples.iter().map(|sample| sample.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(samples), bits(image.channel(&channel.name.to_string()).unwrap()), "{}", channel.name);
    }
}

#[test]
fn an_exr_is_one_part_of_zip_scanlines_with_its_attributes() {
    let path = folder("exr_attributes").join("a.exr");
    write_exr(&path, &image()).unwrap();
    let meta = MetaData::read_from_file(&path, true).unwrap();
    let [header] = &meta.headers[..] else { panic!("more than one part") };
    assert!(!meta.requirements.has_multiple_layers);
    assert_eq!(header.compression, Compression::ZIP16);
    assert_eq!(header.blocks, exr::meta::BlockDescription::ScanLines);
    assert_eq!(header.line_order, LineOrder::Increasing);
    let attributes = &header.own_attributes;
    assert_eq!(attributes.software_name, Some(Text::from("twoforms 0.1.0")));
    assert_eq!(attributes.other[&Text::from("samplesPerPixel")], AttributeValue::I32(64));
    assert_eq!(attributes.other[&Text::from("renderTimeSeconds")], AttributeValue::F32(1.25));
    let AttributeValue::Text(text) = &attributes.other[&Text::from("twoforms:provenance")] else { panic!("no text") };
    assert!(text.as_slice().is_ascii());
    let provenance: serde_json::Value = serde_json::from_slice(text.as_slice()).unwrap();
    assert_eq!(provenance["scene"], "scènes/𝄞.gltf");
    assert_eq!(provenance["seed"], "18446744073709551615");
}

#[test]
fn equal_images_give_equal_bytes() {
    let folder = folder("exr_bytes");
    let bytes = |name: &str| {
        write_exr(&folder.join(name), &image()).unwrap();
        fs::read(folder.join(name)).unwrap()
    };
    let first = bytes("0.exr");
    assert!((1..20).all(|i| bytes(&format!("{i}.exr")) == first));
    let names: Vec<String> = attribute_names(&first);
    assert!(names.is_sorted() && names.iter().any(|name| name == "samplesPerPixel"), "{names:?}");
}

/// Names of the attributes in the header of a single-part file.
fn attribute_names(file: &[u8]) -> Vec<String> {
    let text =
        |at: usize| file[at..].iter().take_while(|byte| **byte != 0).map(|byte| char::from(*byte)).collect::<String>();
    let (mut names, mut at) = (Vec::new(), 8);
    while file[at] != 0 {
        names.push(text(at));
        at += text(at).len() + 1;
        at += text(at).len() + 1;
        at += 4 + u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
    }
    names
}

#[test]
fn a_png_is_the_srgb_preview() {
    let path = folder("png").join("a.png");
    write_png(&path, &image()).unwrap();
    let mut reader = png::Decoder::new(std::io::BufReader::new(fs::File::open(&path).unwrap())).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height), (5, 3));
    assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
    assert!(reader.info().srgb.is_some());
    // Pixel 7 is (1, ½, ¼), pixel 14 (2, 1, ½): linear ½ is byte 188, ¼ is 137.
    assert_eq!(pixels[..3], [0, 0, 0]);
    assert_eq!(pixels[7 * 3..][..3], [255, 188, 137]);
    assert_eq!(pixels[14 * 3..][..3], [255, 255, 188]);
}

/// Breaks an image.
type Spoil = fn(&mut twoforms_report::Image);

#[test]
fn an_image_that_does_not_fit_together_is_refused_and_leaves_no_file() {
    let folder = folder("refused");
    let spoil: [(Spoil, &str); 7] = [
        (|image| image.channels.retain(|channel| channel.name != "G"), "no channel G"),
        (|image| image.channels[3].samples.truncate(14), "area/uniform.Variance.R has 14 samples for 5 × 3 pixels"),
        (|image| image.channels[4].name = "R".into(), "two channels are named R"),
        (|image| image.channels[4].name = "größe".into(), "'größe' cannot be written"),
        (|image| image.channels[1].samples[7] = f32::NAN, "channel G at pixel 2,1 is NaN"),
        (|image| image.height = 0, "5 × 0 pixels"),
        (|image| image.width = usize::MAX, "has 15 samples"),
    ];
    for (spoil, message) in spoil {
        let mut image = image();
        spoil(&mut image);
        for error in [write_exr(&folder.join("a.exr"), &image), write_png(&folder.join("a.png"), &image)] {
            let error = error.unwrap_err();
            assert!(error.to_string().contains(message), "{error}");
        }
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}

#[test]
fn more_samples_per_pixel_than_the_attribute_holds_are_refused() {
    let mut image = image();
    image.samples_per_pixel = u32::MAX;
    let error = write_exr(&folder("spp").join("a.exr"), &image).unwrap_err();
    assert!(matches!(error, ReportError::Image { .. }), "{error}");
}

#[test]
fn without_a_time_there_is_no_attribute_for_it() {
    let (path, mut image) = (folder("no_time").join("a.exr"), image());
    image.render_seconds = None;
    image.channels.push(Channel {
        name: "mis/balance(area/solid-angle:2,hemisphere/brdf:1).Variance.R".into(),
        samples: vec![1.0; 15],
    });
    write_exr(&path, &image).unwrap();
    assert!(!attribute_names(&fs::read(&path).unwrap()).contains(&"renderTimeSeconds".to_owned()));
}
