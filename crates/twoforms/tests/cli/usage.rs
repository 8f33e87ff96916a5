//! Words that cannot be meant: exit code 2, before anything is read.

use crate::support::twoforms;

#[test]
fn a_command_is_needed_and_must_exist() {
    twoforms("frobnicate").misused(&["frobnicate"]);
    twoforms("comapre @cornell-box").misused(&["comapre", "compare"]);
    assert_eq!(twoforms("").code, Some(2));
}

#[test]
fn a_scene_is_needed() {
    for command in ["compare", "exact", "render", "inspect"] {
        twoforms(command).misused(&["<SCENE>"]);
    }
}

#[test]
fn an_unknown_strategy_suggests_the_nearest() {
    twoforms("compare @cornell-box --strategies area/unifrom")
        .misused(&["area/unifrom", "did you mean \"area/uniform\""]);
    twoforms("render @cornell-box --strategy hemisphere/cosin").misused(&["did you mean \"hemisphere/cosine\""]);
    twoforms("compare @cornell-box --strategies area/uniform,").misused(&["empty name"]);
}

#[test]
fn an_unknown_sampler_lists_those_there_are() {
    for command in ["compare", "render"] {
        twoforms(&format!("{command} @cornell-box --sampler indepndent")).misused(&["\"indepndent\"", "independent"]);
    }
}

#[test]
fn counts_are_whole_and_above_zero() {
    for (option, most) in [("--samples", "4294967295"), ("--replicates", "4294967295"), ("--threads", "1024")] {
        for value in ["0", "-1", "1.5", "many", "99999999999"] {
            let says = [option, value, &format!("a whole number from 1 to {most}")];
            twoforms(&format!("compare @cornell-box {option} {value}")).misused(&says);
        }
    }
    twoforms("compare @cornell-box --samples 1,0").misused(&["'0'"]);
    twoforms("compare @cornell-box --samples 1,,2").misused(&["--samples"]);
    twoforms("compare @cornell-box --seed -1").misused(&["--seed", "from 0 to 18446744073709551615"]);
    for option in ["--spp", "--light-samples", "--width", "--height"] {
        twoforms(&format!("render @cornell-box {option} 0")).misused(&[option, "a whole number from 1 to"]);
    }
}

#[test]
fn points_must_be_six_finite_numbers_with_a_normal() {
    for (at, says) in [
        ("1,2,3,4,5", "has 5 numbers where 6 are needed"),
        ("0,0,0,0,1,NaN", "\"NaN\" is not a finite number"),
        ("inf,0,0,0,1,0", "\"inf\" is not a finite number"),
        ("0,0,0,0,0,0", "no direction"),
        ("@@", "names no file"),
    ] {
        let line = format!("compare @cornell-box --at {at}").replace("@@", "@");
        crate::support::run(line.split(' ').map(|word| word.replace("@cornell-box", "x.gltf"))).misused(&[says]);
    }
}

#[test]
fn options_that_would_change_nothing_are_refused() {
    for command in ["compare", "exact"] {
        for (words, says) in [
            ("--albedo 0.5", "--albedo is for --quantity radiance"),
            ("--lambert", "--lambert is for --quantity radiance"),
            ("--width 64", "--pixel and --grid"),
            ("--receiver floor-lit --height 64", "--pixel and --grid"),
        ] {
            twoforms(&format!("{command} @cornell-box {words}")).misused(&[says, &format!("twoforms {command}")]);
        }
    }
}

#[test]
fn pixels_grids_views_crops_and_albedos_have_their_forms() {
    for (words, says) in [
        ("compare --pixel 1", "two whole numbers"),
        ("compare --pixel -1,0", "two whole numbers"),
        ("compare --grid 0,3", "a grid has 1 to"),
        ("compare --grid 65536,65536", "a grid has 1 to"),
        ("compare --view 0,0,0,0,0,1", "has 6 numbers where 7 are needed"),
        ("compare --view 0,0,0,0,0,0,40", "the same point"),
        ("compare --view 0,0,0,0,0,1,180", "between 0 and 180 degrees"),
        ("compare --view 0,0,0,0,0,1,40 --camera auto", "cannot be used with"),
        ("compare --albedo 2", "between 0 and 1"),
        ("compare --albedo -0.5", "between 0 and 1"),
        ("compare --level 0", "between 0 and 1"),
        ("compare --margin -1", "between 0 and 1"),
        ("compare --quantity flux", "irradiance, radiance"),
        ("compare --format xml", "table, json, csv"),
        ("compare --quiet --verbose", "cannot be used with"),
        ("render --crop 1,0,0,1", "x0 < x1"),
        ("render --crop -0.1,1,0,1", "0 <= x0"),
        ("render --crop 0,1,0", "has 3 numbers where 4 are needed"),
        ("render --pixel-filter gauss", "box, point"),
        ("render -o picture.png", "ends in .exr"),
        ("render -o picture", "ends in .exr"),
        ("completions tcsh", "zsh"),
    ] {
        twoforms(words).misused(&[says]);
    }
}
